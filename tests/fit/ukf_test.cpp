// The unscented Kalman filter against recursive least squares, simulated truths, and its own bands.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "fit/identify.hpp"
#include "synthetic.hpp"

namespace hysteron {
namespace {

using testing::motion;
using testing::set_drive;
using testing::set_force;

constexpr std::uint64_t seed = 5;
constexpr double noise = 0.02;

Problem problem_of(const Objective& objective, std::vector<double> start, std::map<std::string, double> settings) {
  Problem problem;
  problem.dimension = objective.layout().dimension();
  problem.budget = 20000;
  problem.stream = Stream(seed);
  problem.start = std::move(start);
  problem.settings = std::move(settings);
  objective.describe_data(problem);
  return problem;
}

RunResult filter(const Objective& objective, std::vector<double> start, std::map<std::string, double> settings) {
  return run_solver(*find_solver("ukf"), problem_of(objective, std::move(start), std::move(settings)),
                    [&](const Request& request) { return objective.evaluate(request); });
}

std::vector<Recording> two_motions() {
  return {motion("a.csv", {{0.02, 1.0}, {0.003, 3.3}}, 3.0, 301, 0.4), motion("b.csv", {{0.012, 2.0}}, 2.0, 203, 0.3)};
}

// Force of a Kelvin-Voigt element of this layout at a point, with noise of an exactly known standard deviation.
void set_linear_force(std::vector<Recording>& recordings, const Layout& layout, const std::vector<double>& point,
                      double deviation, const Stream& stream) {
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    set_force(recordings[r], layout, layout.terms(point), {});
    for (std::size_t n = 0; n < recordings[r].size(); ++n) {
      recordings[r].force[n] += deviation * stream.child("noise").normal(r * 100000 + n);
    }
  }
}

const DataScale kilonewton{1000.0, 0.025, 0.3, 0.0, 0.0, 0.0, 0.0};

// On a model that is linear in its parameters the filter is recursive least squares: same mean, same variance, at every
// update.
TEST(Ukf, IsRecursiveLeastSquaresOnALinearModel) {
  auto recordings = two_motions();
  const Layout layout(make_model("viscous", {}), kilonewton, {});
  set_linear_force(recordings, layout, {0.43, 0.55, 0.48}, 20.0, Stream(seed));
  const Objective objective(layout, recordings, {});
  const std::vector<double> start{0.45, 0.5, 0.5};
  constexpr double spread = 0.03;
  const RunResult run =
      filter(objective, start, {{"spread", spread}, {"noise", noise}, {"passes", 1.0}, {"block", 7.0}});
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity() / (spread * spread);
  Eigen::Vector3d right = information * Eigen::Vector3d(start[0], start[1], start[2]);
  const double variance = noise * noise / static_cast<double>(objective.samples());
  std::size_t at = 0;
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    const double scale = std::sqrt(objective.targets()[r].weight);
    for (std::size_t n = 0; n < recordings[r].size(); ++n) {
      const Eigen::Vector3d row =
          scale * Eigen::Vector3d(recordings[r].velocity[n] * layout.slope(0, 0.5),
                                  recordings[r].displacement[n] * layout.slope(1, 0.5), layout.slope(2, 0.5));
      const double constant =
          scale * (recordings[r].velocity[n] * layout.physical(0, 0.0) +
                   recordings[r].displacement[n] * layout.physical(1, 0.0) + layout.physical(2, 0.0));
      information += row * row.transpose() / variance;
      right += row * (scale * recordings[r].force[n] - constant) / variance;
      if ((n + 1) % 7 != 0 && n + 1 != recordings[r].size()) continue;
      ASSERT_LT(at, run.track.size());
      const Tracked& tracked = run.track[at++];
      EXPECT_EQ(tracked.recording, r);
      EXPECT_EQ(tracked.sample, n + 1);
      const Eigen::Vector3d mean = information.ldlt().solve(right);
      const Eigen::Matrix3d covariance = information.inverse();
      for (int k = 0; k < 3; ++k) {
        const auto c = static_cast<std::size_t>(k);
        ASSERT_NEAR(tracked.mean[c], mean[k], 1e-7) << "recording " << r << ", sample " << n << ", parameter " << k;
        ASSERT_NEAR(tracked.deviation[c], std::sqrt(covariance(k, k)), 1e-6 * std::sqrt(covariance(k, k)));
      }
    }
  }
  EXPECT_EQ(at, run.track.size());
}

// Normalised squared errors over many draws of truth and noise, truths drawn from the belief the filter starts with:
// chi-square of one degree of freedom each, so their mean over m draws has the standard deviation sqrt(2 / m).
TEST(Ukf, BandsAreAsWideAsTheErrors) {
  constexpr std::size_t draws = 100;
  constexpr double spread = 0.03;
  auto recordings = two_motions();
  const Layout layout(make_model("viscous", {}), kilonewton, {});
  const std::vector<double> start{0.45, 0.5, 0.5};
  std::vector<double> squares(3, 0.0);
  for (std::size_t draw = 0; draw < draws; ++draw) {
    const Stream stream = Stream(seed).child("draw" + std::to_string(draw));
    std::vector<double> truth = start;
    for (std::size_t k = 0; k < 3; ++k) truth[k] += spread * stream.child("truth").normal(k);
    set_linear_force(recordings, layout, truth, 0.0, stream);
    ObjectiveOptions options;
    options.weighting = Weighting::pooled;
    double peak = 0.0;
    for (const Recording& recording : recordings) peak = std::max(peak, normaliser(recording, options.normalisation));
    set_linear_force(recordings, layout, truth, noise * peak, stream);
    double noisy_peak = 0.0;
    for (const Recording& recording : recordings) {
      noisy_peak = std::max(noisy_peak, normaliser(recording, options.normalisation));
    }
    const RunResult run = filter(Objective(layout, recordings, options), start,
                                 {{"spread", spread}, {"noise", noise * peak / noisy_peak}, {"passes", 1.0}});
    ASSERT_FALSE(run.track.empty());
    for (std::size_t k = 0; k < 3; ++k) {
      squares[k] += std::pow((run.track.back().mean[k] - truth[k]) / run.track.back().deviation[k], 2);
    }
  }
  const double allowed = 3.0 * std::sqrt(2.0 / draws);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(squares[k] / draws, 1.0, allowed) << "parameter " << k;
}

// Without a noise level given, repeated passes find it.
TEST(Ukf, FindsParametersAndNoiseOfABoucWenElement) {
  std::vector<Recording> recordings{motion("a.csv", {{0.02, 1.0}, {0.004, 2.7}}, 4.0, 801, 0.4)};
  const Layout layout(make_model("bouc-wen", {}), kilonewton, {});
  std::vector<double> truth = layout.initial();
  for (std::size_t k = 0; k < truth.size(); ++k) truth[k] += k % 2 == 0 ? 0.06 : -0.05;
  for (double& u : truth) u = std::clamp(u, 0.05, 0.95);
  set_force(recordings[0], layout, layout.terms(truth), {}, noise, Stream(seed));
  const Objective objective(layout, recordings, {});
  const RunResult run = filter(objective, layout.initial(), {});
  const double at_truth = objective.evaluate({truth, false}).cost[0];
  EXPECT_LE(run.cost, 1.002 * at_truth);
  ASSERT_FALSE(run.track.empty());
  for (std::size_t k = 0; k < truth.size(); ++k) {
    EXPECT_LE(std::fabs(run.best[k] - truth[k]), 4.0 * run.track.back().deviation[k]) << layout.names()[k];
    EXPECT_LT(run.track.back().deviation[k], 0.1) << layout.names()[k];
  }
}

TEST(Ukf, FollowsAParameterThatSteps) {
  std::vector<Recording> recordings{motion("a.csv", {{0.02, 1.0}, {0.004, 2.7}}, 8.0, 1601, 0.4)};
  const Layout layout(make_model("bingham", {}), kilonewton, {});
  const auto coordinate = [&](const std::string& name) {
    for (std::size_t c = 0; c < layout.dimension(); ++c) {
      if (layout.names()[layout.coordinates()[c].parameter] == name) return c;
    }
    return layout.dimension();
  };
  const std::size_t c0 = coordinate("c0");
  ASSERT_LT(c0, layout.dimension());
  std::vector<double> before = layout.initial();
  std::vector<double> after = before;
  before[c0] = 0.10;
  after[c0] = 0.16;
  set_force(recordings[0], layout, layout.terms(before), {}, 0.01, Stream(seed));
  std::vector<Recording> second = recordings;
  set_force(second[0], layout, layout.terms(after), {}, 0.01, Stream(seed));
  constexpr std::size_t step = 800;
  std::copy(second[0].force.begin() + step, second[0].force.end(), recordings[0].force.begin() + step);
  const Objective objective(layout, recordings, {});
  const RunResult run = filter(objective, layout.initial(), {{"walk", 0.15}, {"noise", 0.01}, {"passes", 1.0}});
  ASSERT_FALSE(run.track.empty());
  const auto at = [&](std::size_t sample) {
    return *std::ranges::find_if(run.track, [&](const Tracked& tracked) { return tracked.sample >= sample; });
  };
  EXPECT_NEAR(at(step - 8).mean[c0], before[c0], 0.01);
  EXPECT_NEAR(at(1600).mean[c0], after[c0], 0.01);
  // A belief that parameters do not move ends between the two values.
  const RunResult still = filter(objective, layout.initial(), {{"noise", 0.01}, {"passes", 1.0}});
  EXPECT_GT(after[c0] - still.track.back().mean[c0], 0.015);
}

// Windows in time order, states carried from one to the next, give the cost of the whole: also where the recording
// begins in mid-motion, and where an effect on the drive remembers.
TEST(Windows, AddUpToTheCost) {
  auto recordings = two_motions();
  recordings.push_back(motion("c.csv", {{0.02, 1.0}}, 3.0, 301, 0.0));
  for (Recording& recording : recordings) {
    set_drive(recording, 0.5);
    for (std::size_t n = 0; n < recording.size(); ++n) recording.drive[n] = 0.5 + 0.4 * std::sin(0.05 * double(n));
  }
  LayoutOptions options;
  options.by_current = {{"alpha", 1}};
  for (Recording& recording : recordings) recording.force.assign(recording.size(), 100.0);
  const Layout layout(make_model("bouc-wen", {"magnetic-remanence"}), scale_of(recordings), options);
  const Objective objective(layout, recordings, {});
  ASSERT_GT(objective.targets()[2].preroll, 0U);
  constexpr std::size_t points = 11;  // more than a pack
  Problem problem;
  objective.describe_data(problem);
  const std::vector<double> at = testing::random_points(Stream(seed), points, layout.dimension(), 0.1);
  std::vector<double> squares(points, 0.0);
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    std::vector<double> states(points * problem.states, 0.0);
    for (std::size_t begin = 0; begin < problem.recordings[r]; begin += 37) {
      Request request{at};
      request.window = Window{r, begin, std::min(begin + 37, problem.recordings[r])};
      request.states = states;
      const Response response = objective.evaluate(request);
      states = response.states;
      for (std::size_t k = 0; k < points; ++k) squares[k] += response.cost[k] * response.cost[k];
    }
  }
  const Response whole = objective.evaluate({at});
  for (std::size_t k = 0; k < points; ++k) EXPECT_NEAR(std::sqrt(squares[k]), whole.cost[k], 1e-12 * whole.cost[k]);
}

// Every sigma point's march counts, sample by sample, and the budget holds.
TEST(Windows, CountBySamples) {
  auto recordings = two_motions();
  const Layout layout(make_model("viscous", {}), kilonewton, {});
  set_linear_force(recordings, layout, {0.43, 0.55, 0.48}, 20.0, Stream(seed));
  const Objective objective(layout, recordings, {});
  for (const std::size_t budget : {1, 5, 20, 300}) {
    Problem problem = problem_of(objective, {0.45, 0.5, 0.5}, {});
    problem.budget = budget;
    std::size_t marched = 0;
    const RunResult run = run_solver(*find_solver("ukf"), problem, [&](const Request& request) {
      const std::size_t samples = request.window ? request.window->end - request.window->begin : objective.samples();
      marched += request.points.size() / layout.dimension() * samples;
      return objective.evaluate(request);
    });
    EXPECT_EQ(run.evaluations, (marched + objective.samples() - 1) / objective.samples());
    EXPECT_LE(run.evaluations, budget);
    EXPECT_FALSE(run.best.empty());
  }
}

}  // namespace
}  // namespace hysteron
