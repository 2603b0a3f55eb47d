// Whether a load cell that saturates or is not connected is told, and told only where it is so (diagnose/doubts.hpp):
//
//   hysteron_clipped_ends [FOLDER...] [--campaigns 200] [--cavitation 60] [--friction 60]
//     [--seed 20270501] [--page results/clipped-ends.md]
//
// FOLDER is a measured campaign. Beside these, campaigns of the challenge are made from the seed, with causes of all
// levels, such as hide a cavitation, whose force ends at a level too, and dampers of friction and viscous damping as a
// simulation writes them, coarse or fine, with noise and without any: their force turns at two levels. Each is looked
// at as it is, where what is told is false as far as is known; with its force cut off at a share of the largest one,
// under noise that is added behind; and with one recording that holds the noise of its force alone.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "bench/page.hpp"
#include "bench/program.hpp"
#include "bench/rate.hpp"
#include "challenge/concealed.hpp"
#include "challenge/levels.hpp"
#include "core/extent.hpp"
#include "core/random.hpp"
#include "diagnose/doubts.hpp"
#include "io/campaign.hpp"
#include "io/velocity.hpp"

namespace {

using namespace hysteron;

enum Source : std::size_t { of_all_levels, with_cavitation, friction, measured, sources };
constexpr std::array<const char*, sources> names = {"all levels", "a cavitation", "simulated friction", "measured"};

struct Examined {
  std::string name;
  Source source = measured;
  std::vector<Recording> recordings;
};

bool told(const std::vector<Recording>& recordings) { return !doubt_of_channels(recordings).empty(); }

// F = c v + f_y tanh(v / v_y) on sines, of velocities that were known or are derived, to six digits; of three such
// campaigns one has no noise.
std::vector<Recording> simulated_friction(const Stream& stream) {
  const auto between = [&](const char* what, double low, double high) {
    return low * std::pow(high / low, stream.child(what).uniform(0));
  };
  const double yield = between("yield force", 50.0, 2000.0);
  const double per_period = between("samples a period", 12.0, 300.0);
  const double frequency = between("frequency", 0.2, 5.0);
  const double rate = 2.0 * std::numbers::pi * frequency;
  const double largest = between("amplitude", 2e-3, 3e-2);
  const double damping = yield / (rate * largest) * between("viscous share", 0.05, 2.0);
  const double width = rate * largest * between("width of the yield", 1e-4, 0.1);
  const bool derived = stream.child("derived").uniform(0) < 0.5;
  const double noise = stream.child("noisy").uniform(0) < 1.0 / 3.0 ? 0.0 : yield * between("noise", 1e-5, 2e-2);
  const auto six_digits = [](double value) {
    const double step = std::pow(10.0, std::floor(std::log10(std::max(std::fabs(value), 1e-12))) - 5.0);
    return step * std::round(value / step);
  };
  std::vector<Recording> result;
  for (const double share : {1.0, 0.6, 0.3}) {
    const Stream own = stream.child(result.size());
    Recording one;
    one.file = fmt::format("sine {:.0f} mm", 1e3 * share * largest);
    const auto count = static_cast<std::size_t>(8.0 * per_period);
    for (std::size_t n = 0; n < count; ++n) {
      const double time = static_cast<double>(n) / (frequency * per_period);
      one.time.push_back(time);
      one.displacement.push_back(six_digits(share * largest * std::sin(rate * time)));
      one.velocity.push_back(share * largest * rate * std::cos(rate * time));
    }
    if (derived) one.velocity = derive_velocity(one.time, one.displacement);
    for (std::size_t n = 0; n < count; ++n) {
      const double velocity = one.velocity[n];
      one.force.push_back(six_digits(damping * velocity + yield * std::tanh(velocity / width) + noise * own.normal(n)));
    }
    result.push_back(std::move(one));
  }
  return result;
}

// Of the largest force, beyond which it is cut off; of the noise of the force, what is added behind.
struct Cut {
  double end;
  bool both;
  double noise;
};
constexpr std::array<Cut, 6> cuts = {
    {{0.9, true, 0.1}, {0.7, true, 0.1}, {0.7, true, 0.5}, {0.5, true, 0.1}, {0.7, false, 0.1}, {0.5, false, 0.1}}};

std::vector<Recording> cut_off(const Examined& one, const Cut& cut, const Stream& stream) {
  std::vector<Recording> result = one.recordings;
  double largest = 0.0;
  for (const Recording& recording : result) largest = std::max(largest, peak_of(recording.force));
  for (std::size_t k = 0; k < result.size(); ++k) {
    const double noise = cut.noise * channel_noise(result[k].time, result[k].force);
    const double low = cut.both ? -cut.end * largest : -largest;
    const Stream own = stream.child(k);
    for (std::size_t n = 0; n < result[k].force.size(); ++n) {
      result[k].force[n] = std::clamp(result[k].force[n], low, cut.end * largest) + noise * own.normal(n);
    }
  }
  return result;
}

std::vector<Recording> with_dead_cell(const Examined& one, const Stream& stream) {
  std::vector<Recording> result = one.recordings;
  Recording& dead = result[static_cast<std::size_t>(stream.uniform(0) * static_cast<double>(result.size()))];
  const double noise = channel_noise(dead.time, dead.force);
  const Stream own = stream.child("noise");
  for (std::size_t n = 0; n < dead.force.size(); ++n) dead.force[n] = noise * own.normal(n);
  return result;
}

std::string page_of(const std::vector<Examined>& all, std::uint64_t seed, const std::string& command) {
  std::string text = fmt::format(
      "# Load cells that saturate, or are not connected\n\nMade by\n\n    {}\n\n"
      "Campaigns of `hysteron challenge` from a seed that nothing was chosen on, with causes of all levels and with a "
      "cavitation, dampers of\nfriction and viscous damping simulated from 12 to 300 samples a period, a third of them "
      "without noise, and the measured dampers\nthat ship. Told: `diagnose` says that the recordings have a fault and "
      "gives no name. A force that is cut off at\na share of the largest one may reach that in a single recording, "
      "which is not told. Bounds: Clopper and Pearson, 95 %.\n\n"
      "| | told, {} |\n|---|{}\n",
      command, fmt::join(names, " | told, "), "--:|--:|--:|--:|");
  const auto row = [&](const std::string& what, const auto& is_told) {
    std::array<int, sources> hits{};
    std::array<int, sources> trials{};
    for (const Examined& one : all) {
      ++trials[one.source];
      hits[one.source] += is_told(one) ? 1 : 0;
    }
    text += "| " + what + " |";
    for (std::size_t s = 0; s < sources; ++s)
      text += " " + (trials[s] > 0 ? bench::rate(hits[s], trials[s]) : "-") + " |";
    text += "\n";
  };
  row("as it is", [](const Examined& one) { return told(one.recordings); });
  for (const Cut& cut : cuts) {
    row(fmt::format("cut off at {:.0f} % of the largest force {}, {:.0f} % of the noise behind", 100.0 * cut.end,
                    cut.both ? "either way" : "one way", 100.0 * cut.noise),
        [&](const Examined& one) { return told(cut_off(one, cut, Stream(seed).child("cut").child(one.name))); });
  }
  row("one load cell not connected",
      [&](const Examined& one) { return told(with_dead_cell(one, Stream(seed).child("dead").child(one.name))); });
  return text;
}

int run(int argc, char** argv) {
  CLI::App program("whether a load cell that saturates or is not connected is told, and only where it is so");
  std::vector<std::string> folders;
  std::string page;
  int campaigns = 200;
  int cavitation = 60;
  int frictions = 60;
  std::uint64_t seed = 20270501;
  program.add_option("FOLDER", folders, "measured campaigns")->check(CLI::ExistingDirectory);
  program.add_option("--campaigns", campaigns, "made here")->check(CLI::Range(0, 9999))->capture_default_str();
  program.add_option("--cavitation", cavitation, "of them with a cavitation, besides")
      ->check(CLI::Range(0, 9999))
      ->capture_default_str();
  program.add_option("--friction", frictions, "of them simulated with friction, besides")
      ->check(CLI::Range(0, 9999))
      ->capture_default_str();
  program.add_option("--seed", seed, "of these, and of what is put in")->capture_default_str();
  program.add_option("--page", page, "page to write; else printed");
  CLI11_PARSE(program, argc, argv);

  std::vector<Examined> all;
  std::string command = "build/release/bench/hysteron_clipped_ends";
  const auto add = [&](const std::string& name, Source source, std::vector<Recording> recordings) {
    all.push_back({name, source, std::move(recordings)});
    if (const std::string doubt = doubt_of_channels(all.back().recordings); !doubt.empty()) {
      fmt::print(stderr, "told: {}: {}\n", name, doubt);
    }
  };
  for (const std::string& folder : folders) {
    command += " " + folder;
    add(std::filesystem::path(folder).filename().string(), measured, load_campaign({folder}).recordings);
  }
  command += fmt::format(" --campaigns {} --cavitation {} --friction {} --seed {} --page results/clipped-ends.md",
                         campaigns, cavitation, frictions, seed);
  const std::filesystem::path made =
      std::filesystem::temp_directory_path() / fmt::format("hysteron-clipped-ends-{}-{}", seed, campaigns);
  const auto make = [&](const std::vector<challenge::Task>& tasks, Source source) {
    for (const challenge::Task& task : tasks) {
      const challenge::Concealed concealed = challenge::make_concealed(task, seed);
      const std::filesystem::path folder = made / concealed.name;
      challenge::write_recordings(concealed, folder.string(), seed);
      add(fmt::format("{} ({}, {})", concealed.name, challenge::name_of(task.level), names[source]), source,
          load_campaign({folder.string()}).recordings);
      std::filesystem::remove_all(folder);
    }
  };
  make(challenge::plan(campaigns, {}, {}, seed), of_all_levels);
  make(challenge::plan(cavitation, {}, {"cavitation"}, seed), with_cavitation);
  std::filesystem::remove_all(made);
  for (int k = 0; k < frictions; ++k) {
    const std::string name = fmt::format("friction {}", k);
    add(name, friction, simulated_friction(Stream(seed).child(name)));
  }
  bench::write_page(page, page_of(all, seed, command));
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return hysteron::bench::guarded(run, argc, argv); }
