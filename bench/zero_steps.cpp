// Whether a zero of the force that steps is told, and told only where it does (diagnose/residual/zero_step.hpp):
//
//   hysteron_zero_steps [FOLDER...] [--campaigns 60] [--seed 20270302] [--page results/zero-steps.md]
//
// FOLDER is a measured campaign. Beside these, campaigns of the challenge are made from the seed, with causes of all
// levels. What the base law leaves of each is looked at as it is, where a step that is told is a false one as far as is
// known; with a slow course put in, which is none; and with a step in every recording, at a time drawn between a tenth
// and nine tenths of it. What is put in makes a given share of the squares of what is then left.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
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
#include "diagnose/residual/zero_step.hpp"

namespace {

using namespace hysteron;

constexpr std::array<double, 3> shares = {0.5, 0.8, 0.95};

struct Examined {
  std::string name;
  bool measured = false;
  bench::BaseLeft left;
};

// What is put in over the part of the recording that has passed; `u` is drawn.
struct Course {
  const char* name;
  std::function<double(double passed, double u)> value;
};
const std::array<Course, 4> courses = {{
    {"a step", [](double passed, double u) { return passed < 0.1 + 0.8 * u ? 0.0 : 1.0; }},
    {"a ramp", [](double passed, double) { return passed; }},
    {"a force that settles", [](double passed, double u) { return std::exp(-passed / (0.05 + 0.45 * u)); }},
    {"a slow sine", [](double passed, double u) { return std::sin(2.0 * std::numbers::pi * (1.5 * passed + u)); }},
}};

bool told(const bench::BaseLeft& left) {
  const auto steps = zero_steps_of(left.recordings, left.residuals);
  return steps && shape_the_search(*steps);
}

bench::BaseLeft with(bench::BaseLeft left, const Course& course, double share, const Stream& stream) {
  for (std::size_t k = 0; k < left.residuals.size(); ++k) {
    Residual& residual = left.residuals[k];
    const auto count = static_cast<double>(residual.force.size() - residual.from);
    std::vector<double> values;
    double mean = 0.0;
    for (std::size_t n = residual.from; n < residual.force.size(); ++n) {
      values.push_back(course.value(static_cast<double>(n - residual.from) / count, stream.uniform(k)));
      mean += values.back() / count;
    }
    double squares = 0.0;
    for (const double value : values) squares += (value - mean) * (value - mean) / count;
    const double size = std::sqrt(share / (1.0 - share) * residual.mean_square() / squares);
    for (std::size_t n = 0; n < values.size(); ++n) residual.force[residual.from + n] -= size * values[n];
  }
  return left;
}

std::string page_of(const std::vector<Examined>& all, std::uint64_t seed, const std::string& command) {
  std::string text = fmt::format(
      "# A zero of the force that steps\n\nMade by\n\n    {}\n\n"
      "Campaigns of `hysteron challenge` from a seed that nothing was chosen on, with causes of all levels, and the "
      "measured dampers that\nship. Told: most recordings have a step (`src/diagnose/residual/zero_step.hpp`), and "
      "`diagnose` gives no name. Only a step should be\ntold. Bounds: Clopper and Pearson, 95 %.\n\n"
      "| put into what the base law leaves | share of the squares | told in campaigns of a challenge | in measured "
      "dampers |\n|---|--:|--:|--:|\n",
      command);
  const auto row = [&](const std::string& what, const std::string& share, const auto& is_told) {
    std::array<int, 2> hits = {0, 0};
    std::array<int, 2> trials = {0, 0};
    for (const Examined& one : all) {
      ++trials[one.measured ? 1 : 0];
      hits[one.measured ? 1 : 0] += is_told(one) ? 1 : 0;
    }
    text += fmt::format("| {} | {} | {} | {} |\n", what, share, bench::rate(hits[0], trials[0]),
                        bench::rate(hits[1], trials[1]));
  };
  row("nothing", "-", [](const Examined& one) { return told(one.left); });
  for (const Course& course : courses) {
    for (const double share : shares) {
      row(course.name, fmt::format("{:.0f} %", 100.0 * share), [&](const Examined& one) {
        return told(with(one.left, course, share, Stream(seed).child("zero step").child(one.name)));
      });
    }
  }
  return text;
}

int run(int argc, char** argv) {
  CLI::App program("whether a zero of the force that steps is told, and only where it does");
  std::vector<std::string> folders;
  std::string page;
  int campaigns = 60;
  std::uint64_t seed = 20270302;
  int threads = 1;
  program.add_option("FOLDER", folders, "measured campaigns")->check(CLI::ExistingDirectory);
  program.add_option("--campaigns", campaigns, "made here")->check(CLI::Range(0, 9999))->capture_default_str();
  program.add_option("--seed", seed, "of these, and of what is put in")->capture_default_str();
  program.add_option("--threads", threads, "worker threads")->check(CLI::Range(1, 1024));
  program.add_option("--page", page, "page to write; else printed");
  CLI11_PARSE(program, argc, argv);

  std::vector<Examined> all;
  std::string command = "build/release/bench/hysteron_zero_steps";
  for (const std::string& folder : folders) {
    command += " " + folder;
    all.push_back({std::filesystem::path(folder).filename().string(), true, bench::base_left(folder, threads)});
  }
  command += fmt::format(" --campaigns {} --seed {} --page results/zero-steps.md", campaigns, seed);
  const std::filesystem::path made =
      std::filesystem::temp_directory_path() / fmt::format("hysteron-zero-steps-{}-{}", seed, campaigns);
  for (const challenge::Task& task : challenge::plan(campaigns, {}, {}, seed)) {
    const challenge::Concealed concealed = challenge::make_concealed(task, seed);
    const std::filesystem::path folder = made / concealed.name;
    challenge::write_recordings(concealed, folder.string(), seed);
    all.push_back({fmt::format("{} ({})", concealed.name, challenge::name_of(task.level)), false,
                   bench::base_left(folder, threads)});
    std::filesystem::remove_all(folder);
    if (told(all.back().left)) fmt::print(stderr, "told: {}\n", all.back().name);
  }
  std::filesystem::remove_all(made);
  bench::write_page(page, page_of(all, seed, command));
  return 0;
}

}  // namespace

int main(int argc, char** argv) { return hysteron::bench::guarded(run, argc, argv); }
