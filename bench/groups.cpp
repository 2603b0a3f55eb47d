// Whether recordings that do not belong together are told, and only these; behind a fit of the damper law alone, the
// search for effects left out.
//
//   hysteron_groups FOLDER...     campaigns, each a folder, or a folder of campaign folders
//   hysteron_groups --study 5     mixtures of two and three dampers made here, over five seeds
#include "diagnose/groups.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/program.hpp"
#include "core/drive.hpp"
#include "core/random.hpp"
#include "diagnose/diagnose.hpp"
#include "diagnose/signal/thin.hpp"
#include "io/campaign.hpp"
#include "io/outliers.hpp"
#include "io/velocity.hpp"

namespace {

using namespace hysteron;

struct Examined {
  std::optional<Belonging> belonging;
  double fit_seconds = 0.0;
  double seconds = 0.0;
};

Examined examine(const Campaign& campaign, const std::string& model, const LayoutOptions& layout) {
  const DataScale scale = scale_of(campaign.recordings);
  ObjectiveOptions options;
  options.skip_run_in = true;
  options.comparing = true;
  options.threads = 1;
  const auto never = [] { return false; };
  std::vector<Recording> recordings = campaign.recordings;
  for (Recording& recording : recordings) {
    replace_outliers(recording);
    recording.drive = quiet_drive(recording.drive);
  }
  const Workbench quick(scale, {thinned(spread(recordings, 8), 3000), {}, {}, false}, layout, options, 1, never);
  const Workbench all(scale, {thinned(recordings, 8000), {}, {}, false}, layout, options, 1, never);
  Examined result;
  const std::clock_t begin = std::clock();
  const Fit base = all.polished(quick.from_anywhere({model, {}, {}}, 20000), 10);
  const std::clock_t middle = std::clock();
  result.belonging = belonging_of(all, by_recording(all, base), base);
  result.fit_seconds = static_cast<double>(middle - begin) / CLOCKS_PER_SEC;
  result.seconds = static_cast<double>(std::clock() - middle) / CLOCKS_PER_SEC;
  return result;
}

std::string said(const Examined& of) {
  if (!of.belonging) {
    return "one";
  }
  return std::string(of.belonging->explained ? "explained: " : "PARTED: ") + sentence_of(*of.belonging) +
         fmt::format(" (chance {:.4f})", of.belonging->chance);
}

void run_campaign(const std::string& folder) {
  const Campaign campaign = load_campaign({folder});
  LayoutOptions layout;
  layout.by_current = campaign.by_current;
  layout.by_frequency = campaign.by_frequency;
  const std::string model = campaign.model.empty() ? "bouc-wen" : campaign.model;
  if (layout.by_current.empty()) {
    layout.by_current = base_laws(model, campaign.recordings);
  }
  const Examined result = examine(campaign, model, layout);
  fmt::print("{} [{} recordings, {}; fit {:.1f} s, groups {:.1f} s]: {}\n", folder, campaign.recordings.size(), model,
             result.fit_seconds, result.seconds, said(result));
  std::fflush(stdout);
}

// One of the parameters of the damper that is another in some recordings.
struct Setting {
  const char* name;
  std::size_t parameter;
  double base;  // value, of which a setting takes a multiple; of the offset, the damping force at full speed
};
constexpr std::array<Setting, 3> settings = {{{"yield force", 0, 0.0}, {"damping", 1, 0.0}, {"preload", 3, 100.0}}};

// Sines from rest, and which state each recording is of. Either the same motions for each state or others.
Campaign mixture(const Setting& setting, const std::vector<double>& factors, double noise, bool same_motions,
                 std::size_t each, std::uint64_t seed, std::vector<std::size_t>& states) {
  const CompositeModel model = make_model("bouc-wen", {});
  const Stream stream = Stream(seed).child("mixture").child(setting.name);
  Campaign campaign;
  states.clear();
  for (std::size_t k = 0; k < each * factors.size(); ++k) {
    // Interleaved, so that the order of recording tells nothing.
    const std::size_t state = k % factors.size();
    const std::size_t motion = same_motions ? k / factors.size() : k;
    const double frequency = 0.5 * std::pow(8.0, stream.uniform(motion, 1));
    const double amplitude = 0.004 * std::pow(4.0, stream.uniform(motion, 2));
    // The same levels for every state.
    const double level = static_cast<double>((k / factors.size() + seed) % 3) / 2.0;
    Recording recording;
    recording.file = fmt::format("r{:02}.csv", k + 1);
    recording.velocity_measured = true;
    recording.drive_kind = DriveKind::current;
    const double omega = 6.283185307179586 * frequency;
    const std::size_t samples = 800;
    for (std::size_t n = 0; n < samples; ++n) {
      const double t = 4.0 / frequency * static_cast<double>(n) / static_cast<double>(samples);
      const double s = std::min(4.0 * t * frequency, 1.0);
      const double fade = s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
      const double slope = s < 1.0 ? 30.0 * s * s * (1.0 - s) * (1.0 - s) * 4.0 * frequency : 0.0;
      recording.time.push_back(t);
      recording.displacement.push_back(amplitude * fade * std::sin(omega * t));
      recording.velocity.push_back(amplitude * (fade * omega * std::cos(omega * t) + slope * std::sin(omega * t)));
      recording.drive.push_back(level);
    }
    std::vector<double> p = {150.0 + 450.0 * level, 500.0 + 700.0 * level, 1000.0, 10.0, 6e-4, 0.5, 1.6};
    p[setting.parameter] += setting.base * (factors[state] - 1.0);
    p[setting.parameter] *= setting.base > 0.0 ? 1.0 : factors[state];
    recording.force = simulate(
        model, make_motion(recording.time, recording.displacement, recording.velocity, recording.drive, 1e-6), p);
    double peak = 0.0;
    for (const double force : recording.force) {
      peak = std::max(peak, std::fabs(force));
    }
    for (std::size_t n = 0; n < samples; ++n) {
      recording.force[n] += noise * peak * stream.normal(n, static_cast<std::uint32_t>(k), 7);
    }
    recording.derived_acceleration =
        derive_acceleration(recording.time, recording.displacement, recording.velocity, true);
    campaign.recordings.push_back(std::move(recording));
    campaign.roles.push_back(Role::unassigned);
    states.push_back(state);
  }
  return campaign;
}

bool right(const Belonging& belonging, const Campaign& campaign, const std::vector<std::size_t>& states) {
  for (const std::vector<std::string>& group : belonging.groups) {
    std::vector<std::size_t> of;
    for (std::size_t k = 0; k < states.size(); ++k) {
      if (std::ranges::find(group, campaign.recordings[k].file) != group.end()) {
        of.push_back(states[k]);
      }
    }
    if (std::ranges::adjacent_find(of, std::not_equal_to{}) != of.end()) {
      return false;
    }
  }
  return true;
}

void study(std::size_t seeds, const std::string& only, double factor) {
  LayoutOptions layout;
  layout.by_current = {{"alpha", 1}, {"c0", 1}};
  fmt::print("{:<12}{:<16}{:>7}{:>9}{:>8}{:>8}{:>10}{:>7}\n", "setting", "factors", "noise", "motions", "each", "told",
             "explained", "wrong");
  const std::vector<std::vector<double>> all = {{1.0, 1.0}, {1.0, 1.15}, {1.0, 1.3}, {1.0, 2.0}, {1.0, 1.4, 2.0}};
  for (const Setting& setting : settings) {
    if (!only.empty() && only != setting.name) {
      continue;
    }
    for (const std::vector<double>& factors : all) {
      if (factor > 0.0 && factors.back() != factor) {
        continue;
      }
      for (const double noise : {0.0, 0.02}) {
        for (const bool same : {true, false}) {
          for (const std::size_t each : {3U, 5U}) {
            std::array<std::size_t, 3> count{};
            for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
              std::vector<std::size_t> states;
              const Campaign campaign = mixture(setting, factors, noise, same, each, seed, states);
              const Examined found = examine(campaign, "bouc-wen", layout);
              if (found.belonging) {
                const bool true_groups = right(*found.belonging, campaign, states);
                const bool told = !found.belonging->explained;
                ++count[told ? (true_groups && factors.back() > 1.0 ? 0U : 2U) : 1U];
              }
            }
            fmt::print("{:<12}{:<16}{:>7}{:>9}{:>8}{:>8}{:>10}{:>7}\n", setting.name,
                       fmt::format("{}", fmt::join(factors, " ")), noise, same ? "same" : "other", each, count[0],
                       count[1], count[2]);
            std::fflush(stdout);
          }
        }
      }
    }
  }
}

int run(int argc, char** argv) {
  CLI::App program("recordings that do not belong together");
  std::vector<std::string> data;
  std::size_t seeds = 0;
  program.add_option("FOLDER", data, "campaigns, or folders of them");
  program.add_option("--study", seeds, "instead: mixtures made here, this many of each kind");
  std::string only;
  double factor = 0.0;
  program.add_option("--setting", only, "of these, the one that is changed: yield force, damping or preload");
  program.add_option("--factor", factor, "of these, the largest by which it is changed");
  CLI11_PARSE(program, argc, argv);
  if (seeds > 0) {
    study(seeds, only, factor);
  }
  for (const std::string& folder : data) {
    std::vector<std::string> inside;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.is_directory()) {
        inside.push_back(entry.path().string());
      }
    }
    std::ranges::sort(inside);
    if (inside.empty()) {
      inside.push_back(folder);
    }
    for (const std::string& one : inside) {
      try {
        run_campaign(one);
      } catch (const std::exception& error) {
        fmt::print("{}: {}\n", one, error.what());
      }
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return hysteron::bench::guarded(run, argc, argv); }
