// Whether the program is still as fast as its parts promise: ratios of two times measured in turn on one thread, so
// that neither the machine nor its load is in them. Times are CPU times of the thread; a ratio is the median over
// rounds.
//   hysteron_ratios [--rounds N]
// Prints a row a ratio. Exit status 1, with a line a failure, where one lies beyond its bound. Bounds are far from what
// a healthy build measures: a loaded machine does not reach them, a build that has lost what the line names does.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/peers/plain_twin.hpp"
#include "bench/program.hpp"
#include "core/robust.hpp"
#include "fit/driver.hpp"
#include "fit/objective.hpp"
#include "simulate/composite.hpp"

namespace hysteron::bench {
namespace {

constexpr std::size_t sample_count = 1000;
constexpr double sampling = 1e-3;     // s
constexpr double frequency = 2.0;     // Hz
constexpr double amplitude = 0.025;   // m
constexpr double noise_share = 0.01;  // of the peak force
constexpr double least_time = 0.01;   // s of CPU a measurement takes at least
constexpr std::size_t descent_budget = 20000;
constexpr std::uint64_t descent_seeds = 8;
// What the instruction set offers, whatever the packs make of it. AVX-512 was not measured and counts as AVX2.
#if defined(__AVX__)
constexpr double doubles_of_register = 4.0;
#else
constexpr double doubles_of_register = 2.0;
#endif

// CPU seconds of one call.
double time_of(const std::function<void()>& call) {
  const double begun = cpu_seconds();
  for (std::size_t calls = 1;; ++calls) {
    call();
    if (const double passed = cpu_seconds() - begun; passed >= least_time) return passed / static_cast<double>(calls);
  }
}

double sum = 0.0;  // keeps the compiler from leaving out what is measured

Recording make_recording() {
  Recording recording;
  recording.file = "ratios.csv";
  recording.velocity_measured = true;
  const double omega = 2.0 * std::numbers::pi * frequency;
  for (std::size_t n = 0; n < sample_count; ++n) {
    const double t = static_cast<double>(n) * sampling;
    recording.time.push_back(t);
    recording.displacement.push_back(-amplitude * std::cos(omega * t));  // from rest
    recording.velocity.push_back(amplitude * omega * std::sin(omega * t));
  }
  recording.force = simulate(make_model("modified-bouc-wen", {}),
                             make_motion(recording.time, recording.displacement, recording.velocity, {}), peers::truth);
  peers::add_noise(recording, noise_share, Stream(1).child("ratios"));
  return recording;
}

// One march of a law, at the default parameters, over the recording's motion.
template <class T>
class March {
 public:
  March(const char* model, const Recording& recording)
      : model_(make_model(model, {})),
        motion_(make_motion(recording.time, recording.displacement, recording.velocity, {})),
        state_(static_cast<std::size_t>(model_.states()) + 1),
        force_(recording.size()) {
    for (const Parameter& parameter : model_.parameters()) parameters_.emplace_back(parameter.initial);
  }
  void operator()() {
    std::ranges::fill(state_, T(0.0));
    model_.march<T>(motion_, parameters_.data(), 0, 0, force_.size(), state_.data(), force_.data());
    if constexpr (std::is_same_v<T, double>) {
      sum += force_.back();
    } else {
      sum += force_.back().lane(0);
    }
  }

 private:
  CompositeModel model_;
  Motion motion_;
  std::vector<T> parameters_;
  std::vector<T> state_;
  std::vector<T> force_;
};

struct Ratio {
  std::string what;
  std::string reason;  // why a ratio beyond the bound is a fault
  bool at_least;       // else at most
  double bound;
  std::function<double()> measure;
  std::vector<double> values = {};

  [[nodiscard]] double median() const { return median_of(values); }
  [[nodiscard]] bool holds() const { return at_least ? median() >= bound : median() <= bound; }
};

int run(int argc, char** argv) {
  CLI::App program("ratios of times that a healthy build keeps");
  std::size_t rounds = 7;
  program.add_option("--rounds", rounds, "each measures every ratio once")->check(CLI::Range(1, 1000));
  CLI11_PARSE(program, argc, argv);

  const Recording recording = make_recording();
  const Layout layout(make_model("modified-bouc-wen", {}), scale_of({recording}), {});
  ObjectiveOptions options;
  options.threads = 1;
  const Objective objective(layout, {recording}, options);
  const plain_problem plain = peers::plain_problem_of(recording, layout);
  const std::vector<double> at_truth = peers::truth_in(layout);
  std::vector<double> eight;
  for (int lane = 0; lane < lane_count; ++lane) eight.insert(eight.end(), at_truth.begin(), at_truth.end());
  const double target = 1.01 * objective.evaluate({at_truth, false}).cost[0];

  March<double> alone("modified-bouc-wen", recording);
  March<Lanes> pack("modified-bouc-wen", recording);
  March<Lanes> simple_pack("bouc-wen", recording);
  const auto plain_once = [&] { sum += plain_residuals(&plain, at_truth.data(), nullptr); };
  const auto costs = [&] { sum += objective.evaluate({eight, false}).cost[0]; };
  const auto derivatives = [&] { sum += objective.evaluate({eight, true}).cost[0]; };
  const auto descents = [&] {
    const SolverEntry& entry = *find_solver("multistart-lm");
    for (std::uint64_t seed = 1; seed <= descent_seeds; ++seed) {
      Problem problem;
      problem.dimension = layout.dimension();
      problem.budget = descent_budget;
      problem.stream = Stream(seed).child(entry.id);
      problem.linear = layout.linear();
      problem.screening = true;
      objective.describe_data(problem);
      const RunResult result = run_solver(
          entry, problem, [&](const Request& request) { return objective.evaluate(request); },
          [&](const RunResult& partial) { return partial.cost > target; });
      if (result.cost > target) throw std::runtime_error("multistart-lm does not come to its target");
      sum += result.cost;
    }
  };

  std::vector<Ratio> ratios;
  // What a healthy build measures stands in docs/development.md.
  ratios.push_back({"one candidate alone / one of eight in a pack, march",
                    "a pack marches eight candidates in one; without its vector instructions it takes as long as eight "
                    "marches",
                    true, 0.5 * doubles_of_register, [&] { return time_of(alone) * lane_count / time_of(pack); }});
  ratios.push_back(
      {"plain RK4 (peers/plain_rk4.h) / objective, a candidate of eight",
       "one step a sample with pow of the C library, candidate by candidate, is slower unless packs or the "
       "power law of the models are lost",
       true, 0.375 * doubles_of_register, [&] { return time_of(plain_once) * lane_count / time_of(costs); }});
  ratios.push_back(
      {"modified-bouc-wen / bouc-wen, march of a pack",
       "the same hysteresis with a second state: twice as long means that its code or its steps went wrong", false, 2.0,
       [&] { return time_of(pack) / time_of(simple_pack); }});
  ratios.push_back(
      {"costs with derivatives / costs, over the 1 + d evaluations charged",
       "derivatives that take longer than finite differences would are not worth their charge", false, 1.0,
       [&] { return time_of(derivatives) / time_of(costs) / (1.0 + static_cast<double>(layout.dimension())); }});
  ratios.push_back({"identification by multistart-lm to 1.01 x the noise / plain RK4",
                    "in evaluations of the plain objective; three times as many means more evaluations, a slower "
                    "objective or a solver that computes too much",
                    false, 260.0 / doubles_of_register,
                    [&] { return time_of(descents) / descent_seeds / time_of(plain_once); }});

  for (std::size_t round = 0; round < rounds; ++round) {
    for (Ratio& ratio : ratios) ratio.values.push_back(ratio.measure());
  }
  int status = 0;
  for (const Ratio& ratio : ratios) {
    fmt::print("{:8.3g}  {} {:.3g}  {}\n", ratio.median(), ratio.at_least ? "at least" : "at most ", ratio.bound,
               ratio.what);
  }
  for (const Ratio& ratio : ratios) {
    if (ratio.holds()) continue;
    status = 1;
    fmt::print(stderr, "error: {}: {:.3g}, expected {} {:.3g}: {}\n", ratio.what, ratio.median(),
               ratio.at_least ? "at least" : "at most", ratio.bound, ratio.reason);
  }
  return std::isfinite(sum) ? status : 1;
}

}  // namespace
}  // namespace hysteron::bench

int main(int argc, char** argv) { return hysteron::bench::guarded(&hysteron::bench::run, argc, argv); }
