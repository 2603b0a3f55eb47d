// Whether a tone in what a damper law leaves is told, and told only where there is one (diagnose/residual/tone.hpp):
//
//   hysteron_tones [FOLDER...] [--campaigns 20] [--seed 20261125] [--page results/tones.md]
//
// FOLDER is a measured campaign. Beside these, campaigns of the challenge are made from the seed, with causes of all
// levels. Each is prepared as `hysteron diagnose` does and its base law fitted. What that leaves is looked at as it is,
// where every tone told is a false one as far as is known, and then with one tone put into all its recordings: at a
// frequency drawn between what is looked at in each of them, at a phase drawn for each, of one amplitude, which makes
// it a given share of the squares of what is then left.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "bench/base_left.hpp"
#include "bench/page.hpp"
#include "bench/program.hpp"
#include "bench/rate.hpp"
#include "challenge/concealed.hpp"
#include "challenge/levels.hpp"
#include "core/random.hpp"
#include "diagnose/residual/leftover.hpp"
#include "diagnose/residual/tone.hpp"

namespace {

using namespace hysteron;

constexpr std::array<double, 3> shares = {0.1, 0.2, 0.4};
// Of a recording: below so many cycles nothing is looked at, and above so much of its sampling frequency either.
constexpr double lowest_cycles = 16.0;
constexpr double highest_part = 0.45;
constexpr double most_samples = 4096.0;  // of a recording, which are what is looked at

// What the base law leaves of a campaign.
struct Examined {
  std::string name;
  bool measured = false;
  std::vector<Leftover> left;
};

Examined examine(const std::string& name, const std::filesystem::path& folder, bool measured, int threads) {
  const bench::BaseLeft left = bench::base_left(folder, threads);
  return {name, measured,
          leftovers_of(left.recordings, left.residuals, std::vector<double>(left.recordings.size(), 1.0))};
}

// The frequencies that are looked at in every recording, Hz.
struct Band {
  double low = 0.0;
  double high = 1e300;
};
Band band_of(const std::vector<Leftover>& left) {
  Band band;
  for (const Leftover& one : left) {
    const double duration = one.time.back() - one.time.front();
    const auto samples = static_cast<double>(one.time.size());
    band.low = std::max(band.low, lowest_cycles / duration);
    band.high = std::min(band.high, highest_part * std::min(samples, most_samples) / duration);
  }
  return band;
}

// With a tone in it that is `share` of the squares then.
std::vector<Leftover> with_tone(std::vector<Leftover> left, double frequency, double share, const Stream& stream) {
  double squares = 0.0;
  double samples = 0.0;
  for (const Leftover& one : left) {
    for (const double value : one.residual) squares += value * value;
    samples += static_cast<double>(one.residual.size());
  }
  const double amplitude = std::sqrt(2.0 * share / (1.0 - share) * squares / samples);
  for (std::size_t k = 0; k < left.size(); ++k) {
    const double phase = 2.0 * std::numbers::pi * stream.uniform(k, 1);
    for (std::size_t n = 0; n < left[k].time.size(); ++n) {
      left[k].residual[n] += amplitude * std::sin(2.0 * std::numbers::pi * frequency * left[k].time[n] + phase);
    }
  }
  return left;
}

struct Told {
  int right = 0;
  int wrong = 0;
  int silent = 0;
  [[nodiscard]] int all() const { return right + wrong + silent; }
};

std::string said(const Tone& tone) {
  return fmt::format("{:.3g} Hz, {:.0f} % of the squares, in {} of {} recordings", tone.frequency, 100.0 * tone.share,
                     tone.recordings, tone.of);
}

std::string page_of(const std::vector<Examined>& all, std::size_t draws, std::uint64_t seed,
                    const std::string& command) {
  std::string text = fmt::format(
      "# Tones in what a damper law leaves\n\nMade by\n\n    {}\n\n"
      "Campaigns of `hysteron challenge` from a seed that no table was learned on, with causes of all levels, and the "
      "measured dampers that ship.\nThe base law is fitted to each, and what it leaves is asked for a tone "
      "(`src/diagnose/residual/tone.hpp`). Bounds: Clopper\nand Pearson, 95 %, as if trials in one campaign were "
      "independent.\n\n"
      "## Nothing put in\n\nA tone told here is false as far as is known; a measured damper may have one.\n\n",
      command);
  text += "| | a tone is told |\n|---|--:|\n";
  std::string which;
  for (const bool measured : {false, true}) {
    int trials = 0;
    int told = 0;
    for (const Examined& one : all) {
      if (one.measured != measured) continue;
      ++trials;
      if (const auto tone = tone_of(one.left)) {
        ++told;
        which += fmt::format("- {}: {}\n", one.name, said(*tone));
      }
    }
    if (trials > 0) {
      text += fmt::format("| {} | {} |\n", measured ? "measured dampers" : "campaigns of a challenge",
                          bench::rate(told, trials));
    }
  }
  text += which.empty() ? "" : "\n" + which;
  text += fmt::format(
      "\n## One tone put into all recordings\n\n{} frequencies a campaign, uniform in the logarithm over what is "
      "looked "
      "at in each of its recordings; a phase of its own in each. Right: within the reciprocal of the shortest "
      "recording's duration.\n\n",
      draws);
  text += "| | share of the squares | right | a wrong frequency | silent |\n|---|--:|--:|--:|--:|\n";
  std::string by_name;
  for (const bool measured : {false, true}) {
    for (std::size_t s = 0; s < shares.size(); ++s) {
      Told sum;
      for (const Examined& one : all) {
        if (one.measured != measured) continue;
        Told here;
        const Band band = band_of(one.left);
        double shortest = 1e300;
        for (const Leftover& left : one.left) shortest = std::min(shortest, left.time.back() - left.time.front());
        for (std::size_t draw = 0; draw < draws && band.low < band.high; ++draw) {
          const Stream stream = Stream(seed).child("tone").child(one.name).child(draw);
          const double frequency = band.low * std::pow(band.high / band.low, stream.uniform(0));
          const auto tone = tone_of(with_tone(one.left, frequency, shares[s], stream));
          const bool right = tone && std::fabs(tone->frequency - frequency) < 1.0 / shortest;
          ++(right ? here.right : tone ? here.wrong : here.silent);
        }
        by_name += fmt::format("{:<28} {:3.0f} %  band {:.3g}-{:.3g} Hz  right {} wrong {} silent {}\n", one.name,
                               100.0 * shares[s], band.low, band.high, here.right, here.wrong, here.silent);
        sum.right += here.right;
        sum.wrong += here.wrong;
        sum.silent += here.silent;
      }
      if (sum.all() > 0) {
        text += fmt::format("| {} | {:.0f} % | {} | {} | {} |\n",
                            measured ? "measured dampers" : "campaigns of a challenge", 100.0 * shares[s],
                            bench::rate(sum.right, sum.all()), bench::rate(sum.wrong, sum.all()),
                            bench::rate(sum.silent, sum.all()));
      }
    }
  }
  fmt::print(stderr, "{}", by_name);
  return text;
}

int run(int argc, char** argv) {
  CLI::App program("whether a tone in what a damper law leaves is told, and only where there is one");
  std::vector<std::string> folders;
  std::string page;
  int campaigns = 20;
  std::uint64_t seed = 20261125;
  std::size_t draws = 4;
  int threads = 1;
  program.add_option("FOLDER", folders, "measured campaigns")->check(CLI::ExistingDirectory);
  program.add_option("--campaigns", campaigns, "made here")->check(CLI::Range(0, 9999))->capture_default_str();
  program.add_option("--seed", seed, "of these, and of the tones")->capture_default_str();
  program.add_option("--draws", draws, "tones of each share put into each campaign")->capture_default_str();
  program.add_option("--threads", threads, "worker threads")->check(CLI::Range(1, 1024));
  program.add_option("--page", page, "page to write; else printed");
  CLI11_PARSE(program, argc, argv);

  std::vector<Examined> all;
  std::string command = "build/release/bench/hysteron_tones";
  for (const std::string& folder : folders) {
    command += " " + folder;
    all.push_back(examine(std::filesystem::path(folder).filename().string(), folder, true, threads));
  }
  command += fmt::format(" --campaigns {} --seed {} --draws {} --page results/tones.md", campaigns, seed, draws);
  const std::filesystem::path made =
      std::filesystem::temp_directory_path() / fmt::format("hysteron-tones-{}-{}", seed, campaigns);
  for (const challenge::Task& task : challenge::plan(campaigns, {}, {}, seed)) {
    const challenge::Concealed concealed = challenge::make_concealed(task, seed);
    const std::filesystem::path folder = made / concealed.name;
    challenge::write_recordings(concealed, folder.string(), seed);
    all.push_back(
        examine(fmt::format("{} ({})", concealed.name, challenge::name_of(task.level)), folder, false, threads));
    std::filesystem::remove_all(folder);
    fmt::print(stderr, "{}\n", all.back().name);
  }
  std::filesystem::remove_all(made);
  const std::string text = page_of(all, draws, seed, command);
  bench::write_page(page, text);
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return hysteron::bench::guarded(run, argc, argv); }
