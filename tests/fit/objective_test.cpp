// The objective and the layout against hand computation, finite differences and themselves.
#include "fit/objective.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/frequency.hpp"
#include "datasets/dataset.hpp"
#include "synthetic.hpp"

namespace hysteron {
namespace {

using testing::motion;
using testing::random_points;
using testing::set_drive;
using testing::set_force;

constexpr std::uint64_t seed = 8040;

LayoutOptions laws(const std::map<std::string, int>& by_current, const std::map<std::string, int>& by_frequency = {},
                   const std::map<std::string, double>& fix = {},
                   const std::map<std::string, std::pair<double, double>>& bounds = {}) {
  return {by_current, by_frequency, {}, fix, bounds};
}

Layout layout_of(const std::string& model, const std::vector<Recording>& recordings, const LayoutOptions& options = {},
                 const std::vector<std::string>& effects = {}) {
  return {make_model(model, effects), scale_of(recordings), options};
}

// Two recordings whose residual against c0 = k0 = 0, f0 = 1 N is known: F - 1 = (1, 1, 1, -3) and (4, 4).
std::vector<Recording> hand_made() {
  Recording a;
  a.file = "a.csv";
  a.time = {0.0, 0.1, 0.2, 0.3};
  a.displacement = {0.0, 0.01, 0.0, -0.01};
  a.velocity = {0.1, 0.0, -0.1, 0.0};
  a.force = {2.0, 2.0, 2.0, -2.0};
  Recording b = a;
  b.file = "b.csv";
  b.time = {0.0, 0.1};
  b.displacement = {0.0, 0.01};
  b.velocity = {0.1, 0.0};
  b.force = {5.0, 4.0};
  return {a, b};
}

double cost_by_hand(Normalisation normalisation, Weighting weighting) {
  LayoutOptions options;
  options.fix = {{"c0", 0.0}, {"k0", 0.0}};
  options.bounds = {{"f0", {0.0, 4.0}}};
  const auto recordings = hand_made();
  ObjectiveOptions objective;
  objective.normalisation = normalisation;
  objective.weighting = weighting;
  const Objective of(layout_of("viscous", recordings, options), recordings, objective);
  return of.evaluate({{0.25}, false}).cost.at(0);
}

TEST(Objective, CostOfAKnownResidualInEveryNormalisation) {
  // Residuals 1 - F: (-1, -1, -1, 3), mean square 12 / 4 = 3; (-4, -3), mean square 25 / 2 = 12.5.
  const auto expected = [](double a, double b) { return std::sqrt(0.5 * (3.0 / (a * a) + 12.5 / (b * b))); };
  const Weighting each = Weighting::per_recording;
  EXPECT_NEAR(cost_by_hand(Normalisation::max_abs, each), expected(2.0, 5.0), 1e-12);
  EXPECT_NEAR(cost_by_hand(Normalisation::range, each), expected(4.0, 1.0), 1e-12);
  EXPECT_NEAR(cost_by_hand(Normalisation::standard_deviation, each), expected(std::sqrt(3.0), 0.5), 1e-12);
  EXPECT_NEAR(cost_by_hand(Normalisation::mean_abs, each), expected(2.0, 4.5), 1e-12);
}

TEST(Objective, PooledWeightingCountsSamplesAndDividesByTheLargestNormaliser) {
  const double rmse = std::sqrt((12.0 + 25.0) / 6.0);
  EXPECT_NEAR(cost_by_hand(Normalisation::max_abs, Weighting::pooled), rmse / 5.0, 1e-12);
  EXPECT_NEAR(cost_by_hand(Normalisation::range, Weighting::pooled), rmse / 4.0, 1e-12);
  EXPECT_NEAR(cost_by_hand(Normalisation::standard_deviation, Weighting::pooled), rmse / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(cost_by_hand(Normalisation::mean_abs, Weighting::pooled), rmse / 4.5, 1e-12);
}

TEST(Objective, ViscousCostIsThatOfTheFormula) {
  const auto recordings = hand_made();
  LayoutOptions options;
  options.bounds = {{"c0", {0.0, 100.0}}, {"k0", {0.0, 1000.0}}, {"f0", {-1.0, 1.0}}};
  const Objective objective(layout_of("viscous", recordings, options), recordings, {});
  const double c0 = 30.0;
  const double k0 = 100.0;
  const double f0 = 0.5;
  double square = 0.0;
  for (const Recording& recording : recordings) {
    double sum = 0.0;
    double peak = 0.0;
    for (std::size_t n = 0; n < recording.size(); ++n) {
      const double r = c0 * recording.velocity[n] + k0 * recording.displacement[n] + f0 - recording.force[n];
      sum += r * r;
      peak = std::max(peak, std::fabs(recording.force[n]));
    }
    square += sum / static_cast<double>(recording.size()) / (peak * peak) / 2.0;
  }
  EXPECT_NEAR(objective.evaluate({{0.3, 0.1, 0.75}, false}).cost.at(0), std::sqrt(square), 1e-12);
  EXPECT_EQ(objective.samples(), 6U);
}

TEST(Score, AgreesWithHandComputationAndWithTheObjective) {
  const auto recordings = hand_made();
  const Score first = score({1.0, 1.0, 1.0, 1.0}, recordings[0], Normalisation::max_abs);
  EXPECT_NEAR(first.rmse, std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(first.nrmse, std::sqrt(3.0) / 2.0, 1e-14);
  EXPECT_NEAR(first.fit_percent, 0.0, 1e-12);  // as good as the mean
  const std::vector<Score> scores{first, score({1.0, 1.0}, recordings[1], Normalisation::max_abs)};
  for (const Weighting weighting : {Weighting::per_recording, Weighting::pooled}) {
    EXPECT_NEAR(overall(scores, refer_to(recordings), Normalisation::max_abs, weighting),
                cost_by_hand(Normalisation::max_abs, weighting), 1e-12);
  }
}

TEST(Normaliser, RefusesASignalWithNothingInIt) {
  auto recording = hand_made()[0];
  recording.force.assign(recording.size(), 0.0);
  EXPECT_THROW(normaliser(recording, Normalisation::max_abs), InputError);
  EXPECT_THROW(normaliser(recording, Normalisation::mean_abs), InputError);
  recording.force.assign(recording.size(), 3.0);
  EXPECT_EQ(normaliser(recording, Normalisation::max_abs), 3.0);
  EXPECT_THROW(normaliser(recording, Normalisation::range), InputError);
  EXPECT_THROW(normaliser(recording, Normalisation::standard_deviation), InputError);
  EXPECT_THROW(normalisation_of("peak"), InputError);
  for (const char* word : {"max-abs", "range", "std", "mean-abs"}) EXPECT_EQ(word_of(normalisation_of(word)), word);
}

// bouc-wen with alpha and c0 linear in the current, on two recordings of the twin.
class TwinObjective : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const Campaign campaign = find_entry()->generate(Stream(seed));
    for (const Recording& recording : campaign.recordings) {
      if (recording.file == "2.0Hz_0.1A.csv" || recording.file == "1.2Hz_0.9A.csv") pair().push_back(recording);
    }
    ASSERT_EQ(pair().size(), 2U);
  }
  static void TearDownTestSuite() { pair().clear(); }

  static const DatasetEntry* find_entry() {
    for (const DatasetEntry* entry : dataset_catalogue()) {
      if (entry->id == "rd8040-twin") return entry;
    }
    return nullptr;
  }
  static std::vector<Recording>& pair() {
    static std::vector<Recording> recordings;
    return recordings;
  }
  static Layout layout() {
    LayoutOptions options;
    options.by_current = {{"alpha", 1}, {"c0", 1}};
    return layout_of("bouc-wen", pair(), options);
  }
  static Objective objective(int threads = 2, double tolerance = 1e-4) {
    ObjectiveOptions options;
    options.threads = threads;
    options.tolerance = tolerance;
    return {layout(), pair(), options};
  }
};

TEST_F(TwinObjective, GradientIsThatOfHalfTheSquaredCost) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  const Objective of = objective(2, 1e-8);
  const std::size_t d = of.layout().dimension();
  ASSERT_EQ(d, 9U);
  const std::size_t count = 5;
  const std::vector<double> points = random_points(Stream(seed), count, d, 0.2);
  const Response response = of.evaluate({points, true});
  const double h = 1e-5;
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<double> numeric(d);
    double size = 0.0;
    for (std::size_t c = 0; c < d; ++c) {
      std::vector<double> two;
      for (const double step : {-h, h}) {
        std::vector<double> u(points.begin() + static_cast<std::ptrdiff_t>(k * d),
                              points.begin() + static_cast<std::ptrdiff_t>((k + 1) * d));
        u[c] += step;
        two.insert(two.end(), u.begin(), u.end());
      }
      const Response around = of.evaluate({two, false});
      numeric[c] = 0.5 * (around.cost[1] * around.cost[1] - around.cost[0] * around.cost[0]) / (2.0 * h);
      size = std::max(size, std::fabs(numeric[c]));
    }
    ASSERT_GT(size, 1e-6);
    for (std::size_t c = 0; c < d; ++c) {
      EXPECT_NEAR(response.gradient[k * d + c], numeric[c], 2e-4 * size) << "point " << k << ", coordinate " << c;
    }
  }
}

TEST_F(TwinObjective, GradientAndGaussNewtonMatrixAreProductsOfThePredictionsJacobian) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  ObjectiveOptions options;
  options.tolerance = 1e-9;
  const Objective of(layout(), pair(), options);
  const std::size_t d = of.layout().dimension();
  const std::vector<double> u = random_points(Stream(seed).child("jacobian"), 1, d, 0.25);
  const Response response = of.evaluate({u, true});
  std::vector<double> gradient(d, 0.0);
  std::vector<double> matrix(d * d, 0.0);
  const double h = 1e-5;
  for (const Recording& recording : pair()) {
    const Target target = make_target(recording, options);
    const auto force = [&](const std::vector<double>& at) {
      return predict(of.layout().model(), of.layout().held(), of.layout().terms(at), target);
    };
    const double peak = normaliser(recording, Normalisation::max_abs);
    const double weight = 1.0 / (peak * peak * static_cast<double>(recording.size()) * 2.0);
    const std::vector<double> base = force(u);
    std::vector<std::vector<double>> jacobian;
    for (std::size_t c = 0; c < d; ++c) {
      std::vector<double> low = u;
      std::vector<double> high = u;
      low[c] -= h;
      high[c] += h;
      const auto below = force(low);
      auto column = force(high);
      for (std::size_t n = 0; n < column.size(); ++n) column[n] = (column[n] - below[n]) / (2.0 * h);
      jacobian.push_back(column);
    }
    for (std::size_t n = 0; n < base.size(); ++n) {
      for (std::size_t a = 0; a < d; ++a) {
        gradient[a] += weight * jacobian[a][n] * (base[n] - recording.force[n]);
        for (std::size_t b = 0; b < d; ++b) matrix[a * d + b] += weight * jacobian[a][n] * jacobian[b][n];
      }
    }
  }
  for (std::size_t a = 0; a < d; ++a) {
    const double scale = std::sqrt(matrix[a * d + a]) * response.cost[0];
    EXPECT_NEAR(response.gradient[a], gradient[a], 1e-4 * scale) << "coordinate " << a;
    for (std::size_t b = 0; b < d; ++b) {
      const double size = std::sqrt(matrix[a * d + a] * matrix[b * d + b]);
      EXPECT_NEAR(response.gauss_newton[a * d + b], matrix[a * d + b], 1e-3 * size) << a << ", " << b;
      EXPECT_EQ(response.gauss_newton[a * d + b], response.gauss_newton[b * d + a]);
    }
  }
}

// A drive that steps late is differentiated by every node, a constant one by the parameter.
TEST_F(TwinObjective, DerivativesByNodesAreThoseByTheParameterOfAConstantDrive) {
  LayoutOptions options;
  options.by_current = {{"alpha", 1}, {"x_y", 2}};
  const Layout laws = layout_of("bouc-wen", pair(), options);
  Recording constant = pair()[0];
  constant.drive.assign(constant.size(), 0.4);
  Recording stepped = constant;
  const std::size_t step = constant.size() * 9 / 10;
  std::fill(stepped.drive.begin() + static_cast<std::ptrdiff_t>(step), stepped.drive.end(), 0.9);
  const std::vector<double> u = random_points(Stream(seed).child("nodes"), 1, laws.dimension(), 0.25);
  const Objective by_parameter(laws, {constant}, {});
  const Objective by_node(laws, {stepped}, {});
  ASSERT_FALSE(by_parameter.targets()[0].inputs_vary);
  ASSERT_TRUE(by_node.targets()[0].inputs_vary);
  const Linearised one = by_parameter.linearised(u)[0];
  const Linearised other = by_node.linearised(u)[0];
  const std::size_t d = laws.dimension();
  for (std::size_t c = 0; c < d; ++c) {
    double size = 0.0;
    for (std::size_t n = 0; n + 1 < step; ++n) size = std::max(size, std::fabs(other.jacobian[n * d + c]));
    ASSERT_GT(size, 0.0) << "coordinate " << c;
    for (std::size_t n = 0; n + 1 < step; ++n) {
      ASSERT_NEAR(one.jacobian[n * d + c], other.jacobian[n * d + c], 1e-8 * size) << "coordinate " << c << " at " << n;
    }
  }
}

// The products that a pack sums up are those of the columns of one candidate.
TEST_F(TwinObjective, SumsOfDerivativesAreProductsOfTheLinearisedColumns) {
  const Objective of = objective();
  const std::size_t d = of.layout().dimension();
  const std::vector<double> u = random_points(Stream(seed).child("products"), 1, d, 0.25);
  const Response response = of.evaluate({u, true});
  std::vector<double> gradient(d, 0.0);
  std::vector<double> matrix(d * d, 0.0);
  for (const Linearised& part : of.linearised(u)) {
    for (std::size_t n = 0; n < part.residual.size(); ++n) {
      for (std::size_t a = 0; a < d; ++a) {
        gradient[a] += part.jacobian[n * d + a] * part.residual[n];
        for (std::size_t b = 0; b < d; ++b) matrix[a * d + b] += part.jacobian[n * d + a] * part.jacobian[n * d + b];
      }
    }
  }
  for (std::size_t a = 0; a < d; ++a) {
    EXPECT_NEAR(response.gradient[a], gradient[a], 1e-11 * std::sqrt(matrix[a * d + a]) * response.cost[0]) << a;
    for (std::size_t b = 0; b < d; ++b) {
      const double size = std::sqrt(matrix[a * d + a] * matrix[b * d + b]);
      EXPECT_NEAR(response.gauss_newton[a * d + b], matrix[a * d + b], 1e-11 * size) << a << ", " << b;
    }
  }
}

TEST_F(TwinObjective, CostWithDerivativesIsTheCostWithout) {
  const Objective of = objective();
  const std::vector<double> points = random_points(Stream(seed).child("same"), 5, of.layout().dimension());
  EXPECT_EQ(of.evaluate({points, true}).cost, of.evaluate({points, false}).cost);
}

TEST_F(TwinObjective, CostIsThatOfThePrediction) {
  const Objective of = objective();
  const std::size_t d = of.layout().dimension();
  const std::vector<double> points = random_points(Stream(seed).child("prediction"), 3, d);
  const Response response = of.evaluate({points, false});
  for (std::size_t k = 0; k < 3; ++k) {
    const std::vector<double> u(points.begin() + static_cast<std::ptrdiff_t>(k * d),
                                points.begin() + static_cast<std::ptrdiff_t>((k + 1) * d));
    std::vector<Score> scores;
    for (const Recording& recording : pair()) {
      const auto force =
          predict(of.layout().model(), of.layout().held(), of.layout().terms(u), make_target(recording, {}));
      scores.push_back(score(force, recording, Normalisation::max_abs));
    }
    const std::vector<Recording> both = pair();
    EXPECT_NEAR(overall(scores, refer_to(both), Normalisation::max_abs, Weighting::per_recording), response.cost[k],
                1e-8 * response.cost[k]);
  }
}

TEST_F(TwinObjective, ACandidateAloneGetsTheBitsItGetsInABatch) {
  const Objective of = objective();
  const std::size_t d = of.layout().dimension();
  const std::size_t count = 17;
  const std::vector<double> points = random_points(Stream(seed).child("batch"), count, d);
  for (const bool derivatives : {false, true}) {
    const Response batch = of.evaluate({points, derivatives});
    ASSERT_EQ(batch.cost.size(), count);
    for (std::size_t k = 0; k < count; ++k) {
      const auto begin = static_cast<std::ptrdiff_t>(k * d);
      const Response alone =
          of.evaluate({{points.begin() + begin, points.begin() + begin + static_cast<std::ptrdiff_t>(d)}, derivatives});
      ASSERT_EQ(alone.cost.at(0), batch.cost[k]) << "candidate " << k;
      for (std::size_t c = 0; derivatives && c < d; ++c) {
        ASSERT_EQ(alone.gradient[c], batch.gradient[k * d + c]);
        for (std::size_t e = 0; e < d; ++e) {
          ASSERT_EQ(alone.gauss_newton[c * d + e], batch.gauss_newton[(k * d + c) * d + e]);
        }
      }
    }
  }
}

TEST_F(TwinObjective, ThreadsDoNotChangeABit) {
  const std::vector<double> points = random_points(Stream(seed).child("threads"), 37, layout().dimension());
  for (const bool derivatives : {false, true}) {
    const Response one = objective(1).evaluate({points, derivatives});
    for (const int threads : {2, 7}) {
      const Response many = objective(threads).evaluate({points, derivatives});
      EXPECT_EQ(one.cost, many.cost) << threads << " threads";
      EXPECT_EQ(one.gradient, many.gradient) << threads << " threads";
      EXPECT_EQ(one.gauss_newton, many.gauss_newton) << threads << " threads";
    }
  }
}

TEST_F(TwinObjective, DivergedCandidatesHaveAFiniteOrderedCost) {
  LayoutOptions options;
  options.bounds = {{"k0", {-1e7, -1e6}}, {"c1", {500.0, 600.0}}, {"c0", {0.0, 500.0}}};
  const Layout runaway = layout_of("modified-bouc-wen", pair(), options);
  const Objective of(runaway, pair(), {});
  const std::size_t d = runaway.dimension();
  const std::vector<double> points = random_points(Stream(seed).child("diverged"), 20, d);
  for (const bool derivatives : {false, true}) {
    const Response response = of.evaluate({points, derivatives});
    for (const double cost : response.cost) {
      EXPECT_GE(cost, diverged_cost);
      EXPECT_LE(cost, 2.0 * diverged_cost);
    }
    for (const double value : response.gradient) ASSERT_TRUE(std::isfinite(value));
    for (const double value : response.gauss_newton) ASSERT_TRUE(std::isfinite(value));
  }
}

TEST_F(TwinObjective, TheLaterARunawayTheLowerItsCost) {
  LayoutOptions options;
  options.bounds = {{"k0", {-5e4, -2e4}}};
  options.fix = {{"c0", 500.0}, {"c1", 500.0}, {"alpha", 10.0}};
  // From rest, so that no period is marched beforehand and the time of the runaway shows.
  std::vector<Recording> at_rest{motion("rest.csv", {{0.02, 1.0}}, 3.0, 300, 1.0)};
  at_rest[0].force.assign(300, 1000.0);
  const Layout runaway = layout_of("modified-bouc-wen", at_rest, options);
  const Objective of(runaway, at_rest, {});
  ASSERT_EQ(of.targets()[0].preroll, 0U);
  const std::size_t d = runaway.dimension();
  std::size_t k0 = 0;
  while (runaway.names()[runaway.coordinates()[k0].parameter] != "k0") ++k0;
  std::vector<double> ladder;
  for (int step = 0; step <= 8; ++step) {
    std::vector<double> u(d, 0.5);
    u[k0] = 0.125 * step;
    ladder.insert(ladder.end(), u.begin(), u.end());
  }
  const Response response = of.evaluate({ladder, false});
  EXPECT_TRUE(std::ranges::is_sorted(response.cost, std::ranges::greater{}));
  EXPECT_GT(response.cost[0], response.cost[8]);
  EXPECT_GE(response.cost[8], diverged_cost);
}

TEST_F(TwinObjective, RunawaysInThePeriodMarchedBeforehandAreOrderedToo) {
  LayoutOptions options;
  options.bounds = {{"k0", {-5e5, -1e5}}};
  options.fix = {{"c0", 500.0}, {"c1", 500.0}, {"alpha", 10.0}};
  std::vector<Recording> moving{motion("moving.csv", {{0.02, 1.0}}, 3.0, 300, 0.0)};
  moving[0].force.assign(300, 1000.0);
  const Layout runaway = layout_of("modified-bouc-wen", moving, options);
  const Objective of(runaway, moving, {});
  ASSERT_GT(of.targets()[0].preroll, 0U);
  std::size_t k0 = 0;
  while (runaway.names()[runaway.coordinates()[k0].parameter] != "k0") ++k0;
  std::vector<double> ladder;
  for (int step = 0; step <= 4; ++step) {
    std::vector<double> u(runaway.dimension(), 0.5);
    u[k0] = 0.25 * step;
    ladder.insert(ladder.end(), u.begin(), u.end());
  }
  const Response response = of.evaluate({ladder, false});
  for (std::size_t step = 1; step <= 4; ++step) {
    EXPECT_LE(response.cost[step], response.cost[step - 1]) << step;
    EXPECT_GE(response.cost[step], diverged_cost);
  }
  EXPECT_LT(response.cost[4], response.cost[0]);
  // All of them within the period marched beforehand: otherwise this would be the test above.
  const double share = static_cast<double>(of.targets()[0].preroll) /
                       static_cast<double>(of.targets()[0].preroll + of.targets()[0].force.size());
  EXPECT_GT(response.cost[4], diverged_cost * (2.0 - share));
}

TEST_F(TwinObjective, FewCandidatesGetTheDerivativesTheyGetInAPack) {
  const std::size_t d = layout().dimension();
  const std::vector<double> points = random_points(Stream(seed).child("few"), 8, d, 0.1);
  for (const bool screening : {false, true}) {
    const Response pack = objective(1).evaluate({points, true, screening});
    for (const std::size_t count : {1, 3, 5}) {
      const std::vector<double> few(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(count * d));
      const Response response = objective(1).evaluate({few, true, screening});
      for (std::size_t k = 0; k < count; ++k) EXPECT_EQ(response.cost[k], pack.cost[k]);
      for (std::size_t k = 0; k < count * d; ++k) EXPECT_EQ(response.gradient[k], pack.gradient[k]);
      for (std::size_t k = 0; k < count * d * d; ++k) EXPECT_EQ(response.gauss_newton[k], pack.gauss_newton[k]);
    }
  }
}

TEST_F(TwinObjective, OneRunawayDoesNotSpoilItsNeighbours) {
  LayoutOptions options;
  options.bounds = {{"k0", {-1e7, 1e4}}, {"c1", {500.0, 1e5}}};
  const Layout mixed = layout_of("modified-bouc-wen", pair(), options);
  const Objective of(mixed, pair(), {});
  const std::size_t d = mixed.dimension();
  std::size_t k0 = 0;
  while (mixed.names()[mixed.coordinates()[k0].parameter] != "k0") ++k0;
  std::vector<double> good(d, 0.5);
  good[k0] = 1.0;
  std::vector<double> bad(d, 0.1);
  bad[k0] = 0.0;
  std::vector<double> both = good;
  both.insert(both.end(), bad.begin(), bad.end());
  const Response response = of.evaluate({both, true});
  const Response alone = of.evaluate({good, true});
  EXPECT_LT(response.cost[0], diverged_cost);
  EXPECT_GE(response.cost[1], diverged_cost);
  EXPECT_EQ(response.cost[0], alone.cost[0]);
  for (std::size_t c = 0; c < d; ++c) EXPECT_EQ(response.gradient[c], alone.gradient[c]);
}

std::vector<Recording> three_levels() {
  std::vector<Recording> recordings;
  double level = 0.2;
  for (const double frequency : {0.8, 1.4, 2.3}) {
    Recording recording = motion("m.csv", {{0.02, frequency}}, 2.0, 160, 0.4);
    set_drive(recording, level);
    level += 0.6;
    recording.force.assign(recording.size(), 900.0);
    recordings.push_back(recording);
  }
  return recordings;
}

TEST(MidMotion, FiltersOfTheMotionAreSettledByThePeriodBeforehand) {
  // A sine that is under way at the first sample: the branch, which the law tells by its own acceleration filter, and
  // with it the force, is that of the next period from the first sample on.
  const std::vector<Recording> moving{motion("moving.csv", {{0.01, 2.0}}, 2.0, 1001, 0.0)};
  const Target target = make_target(moving[0], {});
  ASSERT_GT(target.preroll, 0U);
  const CompositeModel model = make_model("guo-hu", {});
  std::vector<double> values;
  for (const Parameter& card : model.parameters()) {
    values.push_back(card.initial);
  }
  const std::vector<double> force = predict(model, values, {}, target);
  const double peak = *std::ranges::max_element(force);
  ASSERT_GT(peak, 0.0);
  for (std::size_t n = 0; n < 250; ++n) {
    EXPECT_NEAR(force[n], force[n + 250], 1e-3 * peak) << n;
  }
}

TEST(Layout, TermsReproduceNodeValuesAndNodeInterpolation) {
  const auto recordings = three_levels();
  LayoutOptions options;
  options.by_current = {{"alpha", 2}, {"c0", 1}};
  options.by_frequency = {{"c0", 2}, {"k0", 1}};
  options.fix = {{"n", 2.0}};
  const Layout layout = layout_of("bouc-wen", recordings, options);
  ASSERT_EQ(layout.dimension(), 3U + 6U + 2U + 1U + 1U + 1U);
  const std::vector<double> u = random_points(Stream(seed).child("terms"), 1, layout.dimension());
  const std::vector<Term> terms = layout.terms(u);
  ASSERT_EQ(terms.size(), layout.dimension());
  for (const ParameterLaw& law : layout.laws()) {
    for (std::size_t b = 0; b < law.frequency_nodes.size(); ++b) {
      for (std::size_t a = 0; a < law.drive_nodes.size(); ++a) {
        const auto at = parameters_at(layout.held(), terms, law.drive_nodes[a], law.frequency_nodes[b], {});
        const std::size_t c = law.first + b * law.drive_nodes.size() + a;
        EXPECT_EQ(layout.coordinates()[c].parameter, law.parameter);
        EXPECT_NEAR(at[law.parameter], layout.physical(c, u[c]), 1e-9 * (1.0 + std::fabs(layout.physical(c, u[c]))));
      }
    }
    // Between nodes: weights of the nodes and the polynomial agree, and the weights sum to one.
    const double drive = 0.53;
    const double frequency = 1.71;
    const std::vector<double> weights = Layout::weights(law, drive, frequency, {});
    double value = 0.0;
    double sum = 0.0;
    double size = 1.0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      value += weights[k] * layout.physical(law.first + k, u[law.first + k]);
      size += std::fabs(layout.physical(law.first + k, u[law.first + k]));
      sum += weights[k];
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
    EXPECT_NEAR(parameters_at(layout.held(), terms, drive, frequency, {})[law.parameter], value, 1e-10 * size);
  }
  EXPECT_EQ(parameters_at(layout.held(), terms, 0.5, 1.0, {})[6], 2.0);
}

TEST(Layout, TermMatrixIsTheSlopeOfTheTerms) {
  const auto recordings = three_levels();
  LayoutOptions options;
  options.by_current = {{"alpha", 2}};
  options.by_frequency = {{"alpha", 1}, {"c0", 2}};
  const Layout layout = layout_of("bouc-wen", recordings, options);
  const std::size_t d = layout.dimension();
  const std::vector<double> matrix = layout.term_matrix();
  std::vector<double> u(d, 0.4);
  const std::vector<Term> before = layout.terms(u);
  for (std::size_t c = 0; c < d; ++c) {
    std::vector<double> moved = u;
    moved[c] = 0.7;
    const double step = layout.physical(c, 0.7) - layout.physical(c, 0.4);
    const std::vector<Term> after = layout.terms(moved);
    for (std::size_t t = 0; t < d; ++t) {
      const double expected = matrix[t * d + c];
      EXPECT_NEAR((after[t].value - before[t].value) / step, expected, 1e-7 * (1.0 + std::fabs(expected)));
    }
  }
}

TEST(Layout, UnitAndPhysicalCoordinatesAreInverse) {
  const auto recordings = three_levels();
  for (const char* model : {"bouc-wen", "modified-bouc-wen", "lugre"}) {
    const Layout layout = layout_of(model, recordings);
    for (std::size_t c = 0; c < layout.dimension(); ++c) {
      for (const double u : {0.0, 1e-3, 0.3, 0.5, 0.99, 1.0}) {
        EXPECT_NEAR(layout.unit(c, layout.physical(c, u)), u, 1e-12) << model << ", coordinate " << c;
        const double h = 1e-6;
        EXPECT_NEAR((layout.physical(c, u + h) - layout.physical(c, u - h)) / (2.0 * h), layout.slope(c, u),
                    1e-6 * layout.slope(c, 1.0));
      }
      const Coordinate& coordinate = layout.coordinates()[c];
      EXPECT_NEAR(layout.physical(c, 0.0), coordinate.lower, 1e-12 * std::fabs(coordinate.upper));
      EXPECT_NEAR(layout.physical(c, 1.0), coordinate.upper, 1e-12 * std::fabs(coordinate.upper));
      EXPECT_EQ(layout.unit(c, coordinate.upper + std::fabs(coordinate.upper) + 1.0), 1.0);
      EXPECT_EQ(layout.unit(c, -1e9), 0.0);
    }
  }
}

TEST(Layout, BoxGrowsWithTheDevice) {
  const CompositeModel model = make_model("viscous", {});
  const DataScale reference;
  DataScale large = reference;
  large.force *= 10.0;
  large.velocity *= 2.0;
  large.length *= 4.0;
  const Layout small_box(model, reference, {});
  const Layout large_box(model, large, {});
  EXPECT_NEAR(large_box.coordinates()[0].upper, small_box.coordinates()[0].upper * 10.0 / 2.0, 1e-6);
  EXPECT_NEAR(large_box.coordinates()[1].upper, small_box.coordinates()[1].upper * 10.0 / 4.0, 1e-6);
  EXPECT_NEAR(large_box.coordinates()[2].upper, small_box.coordinates()[2].upper * 10.0, 1e-6);
}

TEST(Layout, RefusesWhatDoesNotFit) {
  const auto recordings = three_levels();
  const std::vector<Recording> one{recordings[0]};
  const auto made = [&](const LayoutOptions& options) { return layout_of("bouc-wen", recordings, options); };
  EXPECT_THROW(made(laws({{"alfa", 1}})), InputError);
  EXPECT_THROW(made(laws({}, {{"alfa", 1}})), InputError);
  EXPECT_THROW(made(laws({}, {}, {{"alfa", 1.0}})), InputError);
  EXPECT_THROW(made(laws({}, {}, {}, {{"alfa", {0.0, 1.0}}})), InputError);
  EXPECT_THROW(made(laws({{"alpha", 1}}, {}, {{"alpha", 1.0}})), InputError);
  EXPECT_THROW(layout_of("bouc-wen", one, laws({{"alpha", 1}})), InputError);
  EXPECT_THROW(layout_of("bouc-wen", one, laws({}, {{"alpha", 1}})), InputError);
  EXPECT_NO_THROW(made(laws({{"alpha", 1}}, {{"alpha", 1}})));
}

TEST(Layout, FrequencyAndScaleOfARecording) {
  const Recording recording = three_levels()[1];
  EXPECT_NEAR(dominant_frequency(recording), 1.4, 0.03);
  const DataScale scale = scale_of(three_levels());
  EXPECT_EQ(scale.force, 900.0);
  EXPECT_NEAR(scale.length, 0.02, 5e-4);
  EXPECT_NEAR(scale.velocity, 2.0 * std::numbers::pi * 2.3 * 0.02, 0.02);
  EXPECT_DOUBLE_EQ(scale.drive_low, 0.2);
  EXPECT_DOUBLE_EQ(scale.drive_high, 1.4);
}

// An absolute reading: the force at its zero is that of a spring over the way there, and the box holds it.
TEST(Layout, AnOffsetForceMakesUpForAMotionOffItsZero) {
  auto recordings = three_levels();
  const Layout centred = layout_of("viscous", recordings, {});
  for (Recording& recording : recordings) {
    for (double& x : recording.displacement) {
      x += 0.5;
    }
  }
  const Layout off = layout_of("viscous", recordings, {});
  const auto& stiffness = off.coordinates()[1];
  EXPECT_GE(off.coordinates()[2].upper, 0.5 * stiffness.upper);
  EXPECT_LE(off.coordinates()[2].lower, -0.5 * stiffness.upper);
  EXPECT_NEAR(stiffness.upper, centred.coordinates()[1].upper, 1e-9 * stiffness.upper);
  EXPECT_NEAR(centred.coordinates()[2].upper, 1.5 * 900.0, 1e-9) << "the recordings' peak force times that of the card";
}

TEST(Layout, TermNames) {
  EXPECT_EQ(term_name("alpha", Term{0, 0, 0, 1.0}, {}), "alpha");
  EXPECT_EQ(term_name("alpha", Term{0, 1, 0, 1.0}, {}), "alpha*i");
  EXPECT_EQ(term_name("alpha", Term{0, 2, 1, 1.0}, {}), "alpha*i^2*f");
}

// A drive that steps in mid-recording acts as the constant drives it is made of.
TEST(Drive, PiecesOfATimeVaryingDriveActAsConstantDrives) {
  const auto base = three_levels();
  LayoutOptions options;
  options.by_current = {{"alpha", 1}, {"c0", 2}};
  const Layout layout = layout_of("bouc-wen", base, options);
  std::vector<double> u(layout.dimension(), 0.6);
  u[0] = 0.2;
  u[1] = 0.8;
  const std::vector<Term> terms = layout.terms(u);
  Recording low = base[0];
  Recording stepped = base[0];
  set_drive(low, 0.3);
  set_drive(stepped, 0.3);
  const std::size_t at = 90;
  for (std::size_t n = at; n < stepped.size(); ++n) stepped.drive[n] = 1.1;
  const Target of_low = make_target(low, {});
  const Target of_step = make_target(stepped, {});
  ASSERT_TRUE(of_step.inputs_vary);
  ASSERT_FALSE(of_low.inputs_vary);
  const auto force_low = predict(layout.model(), layout.held(), terms, of_low);
  const auto force_step = predict(layout.model(), layout.held(), terms, of_step);
  for (std::size_t n = 0; n < at; ++n) ASSERT_NEAR(force_step[n], force_low[n], 1e-9 * 900.0) << "sample " << n;
  double moved = 0.0;
  for (std::size_t n = at; n < low.size(); ++n) moved = std::max(moved, std::fabs(force_step[n] - force_low[n]));
  EXPECT_GT(moved, 10.0);

  // The viscous law has no memory: both pieces are those of their constant drives.
  const Layout plain = layout_of("viscous", base, laws({{"c0", 1}}));
  const std::vector<Term> plain_terms = plain.terms({0.2, 0.8, 0.5, 0.5});
  Recording high = base[0];
  set_drive(high, 1.1);
  const auto pieces = predict(plain.model(), plain.held(), plain_terms, make_target(stepped, {}));
  const auto first = predict(plain.model(), plain.held(), plain_terms, of_low);
  const auto second = predict(plain.model(), plain.held(), plain_terms, make_target(high, {}));
  for (std::size_t n = 0; n < pieces.size(); ++n) {
    ASSERT_NEAR(pieces[n], n < at ? first[n] : second[n], 1e-9) << "sample " << n;
  }

  // And the objective sees the same as the prediction.
  stepped.force = force_step;
  const Objective objective(layout, {stepped}, {});
  EXPECT_LT(objective.evaluate({u, false}).cost[0], 1e-10);
}

}  // namespace
}  // namespace hysteron
