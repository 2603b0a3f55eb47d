// Signature contrasts of a base model that is fitted first, on recordings or on campaigns made here with one effect
// each.
//
//   hysteron_contrasts DATA... --model bouc-wen --by-current alpha:1,c0:1   the contrasts of one campaign
//   hysteron_contrasts --study 10                                           effects against contrasts, over ten seeds
//
// The campaigns of the study: a Bouc-Wen damper at three drives, sines that start and end at rest, one with a pause in
// it, two with steps of the drive, noise of one per cent, half of its power coloured. A line lists the contrasts that
// speak (|z| above 3, beyond 95 % of the placebos), with their median value; a star marks those that should;
// in brackets stand those that should and do not.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "bench/program.hpp"
#include "core/random.hpp"
#include "diagnose/residual/contrast.hpp"
#include "diagnose/search/relatives.hpp"
#include "diagnose/signal/thin.hpp"
#include "fit/driver.hpp"
#include "fit/identify.hpp"
#include "io/campaign.hpp"
#include "io/outliers.hpp"
#include "io/velocity.hpp"

namespace {

using namespace hysteron;

bool speaks_for(ContrastKind kind, std::string_view effect) {
  const std::vector<Voice> voices = voices_of(kind);
  return std::ranges::find(voices, effect, &Voice::effect) != voices.end();
}

struct Base {
  std::string model;
  LayoutOptions layout;
  std::size_t budget = 20000;
};

std::vector<Residual> residuals_of(const Base& base, const std::vector<Recording>& recordings, double* cost) {
  const Layout layout(make_model(base.model, {}), scale_of(recordings), base.layout);
  ObjectiveOptions options;
  options.skip_run_in = true;
  options.comparing = true;
  const Objective objective(layout, thinned(recordings, 12000), options);
  Problem problem;
  problem.dimension = layout.dimension();
  problem.budget = base.budget;
  problem.stream = Stream(1).child("base");
  problem.linear = layout.linear();
  problem.start = layout.initial();
  problem.screening = true;
  const RunResult run = run_solver(*find_solver("multistart-lm"), problem,
                                   [&](const Request& request) { return objective.evaluate(request); });
  *cost = run.cost;
  options.comparing = false;
  std::vector<Residual> result;
  for (const Recording& recording : recordings) {
    const Target target = make_target(recording, options);
    Residual residual{predict(layout.model(), layout.held(), layout.terms(run.best), target), target.run_in};
    for (std::size_t n = 0; n < residual.force.size(); ++n) {
      residual.force[n] = n < residual.from ? 0.0 : residual.force[n] - recording.force[n];
    }
    result.push_back(std::move(residual));
  }
  return result;
}

void print(const std::vector<Contrast>& found) {
  fmt::print("{:<18}{:>12}{:>12} {:<20}{:>9}{:>12}{:>9}{:>10}\n", "contrast", "value", "std_error", "unit", "z",
             "recordings", "agree", "placebos");
  for (const Contrast& one : found) {
    fmt::print("{:<18}{:>12.4g}{:>12.2g} {:<20}{:>9.1f}{:>12}{:>8.0f}%{:>10.3f}\n", card_of(one.kind).id, one.value,
               one.std_error, one.unit, one.z, one.recordings, 100.0 * one.consistency, one.placebo_quantile);
  }
}

// The truths of the study: an effect and those of its parameters that are not at their initial values.
struct Truth {
  std::string effect;  // empty: none
  std::map<std::string, double> parameters;
};
const std::vector<Truth>& truths() {
  static const std::vector<Truth> result = {
      {"", {}},
      {"offset-force", {{"f0", 60.0}}},
      {"linear-stiffness", {{"k", 8e3}}},
      {"cubic-stiffness", {{"k3", 4e7}}},
      {"gas-spring", {{"f_g", 300.0}, {"g", 18.0}, {"kappa", 1.3}}},
      {"end-stop", {{"k_b", 8e4}, {"x_up", 0.012}, {"x_low", 0.012}}},
      {"pinching", {{"p", 0.2}, {"w", 4e-3}}},
      {"asymmetry", {{"e", 0.08}}},
      {"cavitation", {{"kappa", 2.5e-3}}},
      {"coulomb-friction", {{"fc", 60.0}}},
      {"seal-friction", {{"fc", 20.0}, {"fb", 80.0}}},
      {"pre-yield-hysteresis", {{"f_h", 120.0}, {"x_y", 4e-3}}},
      {"viscous-damping", {{"c", 300.0}}},
      {"quadratic-damping", {{"d2", 1.5e3}}},
      {"shear-thinning", {{"c_t", 1500.0}, {"v_c", 0.05}, {"m", 0.4}}},
      {"inertia", {{"m", 15.0}}},
      {"sensor-delay", {{"lag", 3e-3}}},
      {"velocity-lag", {{"lag", 3e-3}}},
      {"clearance", {{"gap", 4e-4}}},
      {"compliance", {{"C", 1e-6}}},
      {"entrapped-gas", {{"d_a", 3e-4}, {"f_a", 150.0}}},
      {"series-dashpot", {{"e", 2e-5}}},
      {"self-heating", {{"b", 1.5e-3}, {"tau", 30.0}}},
      {"degradation", {{"d", 1e-3}}},
      {"stiction", {{"a", 0.3}}},
      {"force-drift", {{"r", 6.0}}},
      {"coil-lag", {{"tau", 0.03}}},
      {"magnetic-saturation", {{"sigma", 1.0}}},
      {"magnetic-remanence", {{"rho", 0.3}, {"w", 0.3}}},
  };
  return result;
}

double smooth(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
}

// x = A sin(w t), faded in and out over a quarter of a cycle, before a rest of 0.7 s; twice, with a rest of `pause` s
// in between, unless that is zero.
Recording motion(double amplitude, double frequency, double pause) {
  constexpr double rate = 250.0;
  const double moving = std::max(4.0, std::floor(3.0 * frequency)) / frequency;
  const double total = moving + (pause > 0.0 ? pause + moving : 0.0) + 0.7;
  const auto place = [&](double t) {
    const double since = pause > 0.0 && t > moving + pause ? t - moving - pause : t;
    const double fade = smooth(4.0 * since * frequency) * smooth(4.0 * (moving - since) * frequency);
    return since < moving ? amplitude * fade * std::sin(2.0 * std::numbers::pi * frequency * since) : 0.0;
  };
  Recording result;
  for (std::size_t n = 0; n < static_cast<std::size_t>(total * rate); ++n) {
    const double t = static_cast<double>(n) / rate;
    result.time.push_back(t);
    result.displacement.push_back(place(t));
    result.velocity.push_back((place(t + 1e-5) - place(t - 1e-5)) / 2e-5);
  }
  result.velocity_measured = true;
  result.derived_acceleration = derive_acceleration(result.time, result.displacement, result.velocity, true);
  result.drive_kind = DriveKind::current;
  return result;
}

std::vector<Recording> campaign(const Truth& truth, double noise, std::uint64_t seed) {
  std::vector<Recording> result;
  for (const double level : {0.0, 0.5, 1.0}) {
    result.push_back(motion(0.015, 0.5, 0.0));
    result.push_back(motion(0.008, 1.5, 0.0));
    result.push_back(motion(0.003, 4.0, 0.0));
    for (std::size_t k = result.size() - 3; k < result.size(); ++k) {
      result[k].drive.assign(result[k].size(), level);
    }
  }
  result.push_back(motion(0.012, 1.2, 3.0));
  result.back().drive.assign(result.back().size(), 1.0);
  for (const double frequency : {0.7, 2.3}) {
    Recording steps = motion(0.01, frequency, 0.0);
    for (const double t : steps.time) {
      constexpr std::array<double, 6> levels = {0.0, 1.0, 0.4, 0.7, 0.2, 0.5};
      steps.drive.push_back(levels[static_cast<std::size_t>(t / 0.37) % levels.size()]);
    }
    result.push_back(std::move(steps));
  }
  const CompositeModel model =
      make_model("bouc-wen", truth.effect.empty() || truth.effect == "velocity-lag" ? std::vector<std::string>{}
                                                                                    : std::vector{truth.effect});
  std::vector<double> held = {150.0, 500.0, 1000.0, 10.0, 6e-4, 0.5, 1.6};
  const std::vector<Parameter> cards = model.parameters();
  for (std::size_t k = held.size(); k < cards.size(); ++k) {
    const std::string name = model.parameter_names()[k];
    const auto given = truth.parameters.find(name.substr(name.find('.') + 1));
    held.push_back(given == truth.parameters.end() ? cards[k].initial : given->second);
  }
  const std::vector<Term> terms = {{0, 0, 0, 150.0}, {0, 1, 0, 450.0}, {1, 0, 0, 500.0}, {1, 1, 0, 700.0}};
  const Stream stream = Stream(seed).child("study").child(truth.effect);
  for (std::size_t k = 0; k < result.size(); ++k) {
    Recording& recording = result[k];
    recording.file = fmt::format("{}.csv", k);
    recording.force.assign(recording.size(), 1.0);
    recording.force = predict(model, held, terms, make_target(recording, {}));
    double peak = 0.0;
    for (const double force : recording.force) {
      peak = std::max(peak, std::fabs(force));
    }
    // The channel lags, not the damper.
    for (std::size_t n = 0; truth.effect == "velocity-lag" && n < recording.size(); ++n) {
      recording.velocity[n] -= truth.parameters.at("lag") * recording.derived_acceleration[n];
    }
    double coloured = 0.0;
    for (std::size_t n = 0; n < recording.size(); ++n) {
      const auto of = static_cast<std::uint32_t>(k);
      coloured = 0.95 * coloured + std::sqrt(1.0 - 0.95 * 0.95) * stream.normal(n, of, 0);
      recording.force[n] += noise * peak * std::sqrt(0.5) * (coloured + stream.normal(n, of, 1));
    }
  }
  return result;
}

// |z| and share of placebos from which on a contrast counts as speaking in the table.
constexpr double loud = 3.0;
constexpr double beyond = 0.95;

void study(std::size_t seeds, double noise, std::size_t budget, const std::vector<std::string>& only) {
  for (const Truth& truth : truths()) {
    if (!only.empty() && std::ranges::find(only, truth.effect) == only.end()) {
      continue;
    }
    std::map<ContrastKind, std::size_t> loud_ones;
    std::map<ContrastKind, std::vector<double>> values;
    std::string quiet;  // those that should speak and do not
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const std::vector<Recording> recordings = campaign(truth, noise, seed);
      Base base{"bouc-wen", {}, budget};
      base.layout.by_current = {{"alpha", 1}, {"c0", 1}};
      if (truth.effect == "offset-force" || truth.effect == "linear-stiffness") {
        base.layout.fix = {{"k0", 1000.0}, {"f0", 10.0}};
      }
      if (truth.effect == "viscous-damping") {
        base.layout.fix = {{"c0", 500.0}};
        base.layout.by_current.erase("c0");
      }
      double cost = 0.0;
      const std::vector<Residual> residuals = residuals_of(base, recordings, &cost);
      for (const Contrast& one : contrasts(recordings, residuals)) {
        if (std::fabs(one.z) > loud && one.placebo_quantile > beyond) {
          ++loud_ones[one.kind];
        } else if (speaks_for(one.kind, truth.effect)) {
          quiet += fmt::format(" [{} {:.2g} z {:.1f} placebos {:.3f}]", card_of(one.kind).id, one.value, one.z,
                               one.placebo_quantile);
        }
        values[one.kind].push_back(one.value);
      }
    }
    fmt::print("{}:", truth.effect.empty() ? "(nothing)" : truth.effect);
    for (const auto& [kind, count] : loud_ones) {
      const bool right = speaks_for(kind, truth.effect);
      std::vector<double>& of = values[kind];
      std::ranges::nth_element(of, of.begin() + static_cast<std::ptrdiff_t>(of.size() / 2));
      fmt::print(" {}{} {}/{} ({:.2g})", right ? "*" : "", card_of(kind).id, count, seeds, of[of.size() / 2]);
    }
    fmt::print("{}\n", quiet);
    std::fflush(stdout);
  }
}

std::map<std::string, int> orders_of(const std::string& text) {
  std::map<std::string, int> result;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find(',', from), text.size());
    const std::string word = text.substr(from, end - from);
    const std::size_t colon = word.find(':');
    if (colon == std::string::npos) {
      throw CLI::ValidationError("--by-current", "'" + word + "' is not PARAMETER:ORDER");
    }
    result[word.substr(0, colon)] = std::stoi(word.substr(colon + 1));
    from = end + 1;
  }
  return result;
}

int run(int argc, char** argv) {
  CLI::App program("signature contrasts of a base model that is fitted first");
  std::vector<std::string> data;
  Base base{"bouc-wen", {}, 20000};
  std::string by_current;
  std::size_t seeds = 0;
  double noise = 0.01;
  std::vector<std::string> only;
  program.add_option("DATA", data, "recordings or folders of them");
  program.add_option("--model", base.model, "damper law")->capture_default_str();
  program.add_option("--by-current", by_current, "PARAMETER:ORDER,... of the drive");
  program.add_option("--budget", base.budget, "evaluations of the fit")->capture_default_str();
  program.add_option("--study", seeds, "instead of data: campaigns made here, this many for each effect");
  program.add_option("--noise", noise, "of these, share of the peak force")->capture_default_str();
  program.add_option("--only", only, "of these, the effects to make");
  CLI11_PARSE(program, argc, argv);
  if (seeds > 0) {
    study(seeds, noise, base.budget, only);
    return 0;
  }
  base.layout.by_current = orders_of(by_current);
  Campaign campaign = load_campaign(data);
  for (Recording& recording : campaign.recordings) {
    replace_outliers(recording);
  }
  double cost = 0.0;
  const std::vector<Residual> residuals = residuals_of(base, campaign.recordings, &cost);
  const std::clock_t begin = std::clock();
  const std::vector<Contrast> found = contrasts(campaign.recordings, residuals);
  fmt::print(stderr, "NRMSE {:.4f}; the contrasts took {:.3f} s of one core\n", cost,
             static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  print(found);
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return hysteron::bench::guarded(run, argc, argv); }
