// Identification end to end: models find themselves again, linear fits are the closed form, runs resume, flags are
// true.
#include "fit/identify.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "fit/bounds_met.hpp"
#include "fit/estimate_blocks.hpp"
#include "fit/predict.hpp"
#include "fit/score.hpp"
#include "fit/target.hpp"
#include "synthetic.hpp"

namespace hysteron {
namespace {

using testing::motion;
using testing::random_points;
using testing::set_drive;
using testing::set_force;

constexpr std::uint64_t seed = 4711;

std::vector<Recording> motions() {
  return {motion("slow.csv", {{0.022, 0.7}}, 3.0, 150, 0.3),
          motion("fast.csv", {{0.009, 2.6}, {0.006, 4.1}}, 1.5, 150, 0.2),
          motion("mixed.csv", {{0.015, 1.3}, {0.005, 3.3}}, 2.0, 150, 0.3)};
}

Campaign campaign_of(std::vector<Recording> recordings) {
  Campaign campaign;
  campaign.recordings = std::move(recordings);
  campaign.roles.assign(campaign.recordings.size(), Role::unassigned);
  return campaign;
}

// Forces of a viscous device with noise.
Campaign viscous_campaign(double noise, double c0 = 3000.0, double k0 = 12000.0, double f0 = 40.0) {
  auto recordings = motions();
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    Recording& recording = recordings[r];
    const Stream stream = Stream(seed).child("viscous").child(r);
    for (std::size_t n = 0; n < recording.size(); ++n) {
      recording.force.push_back(c0 * recording.velocity[n] + k0 * recording.displacement[n] + f0 +
                                noise * stream.normal(n));
    }
  }
  return campaign_of(recordings);
}

const Estimate& estimate_of(const Identification& result, const std::string& name) {
  for (const Estimate& estimate : result.estimates) {
    if (estimate.name == name) return estimate;
  }
  throw std::runtime_error("no estimate of " + name);
}

// Recordings that are missed by as many newtons, two of large forces and one of small ones.
TEST(Estimates, PooledErrorsOfFittedAndHeldOutRecordingsHaveOneNormaliser) {
  Campaign campaign = viscous_campaign(15.0);
  for (double& force : campaign.recordings[1].force) force *= 0.1;
  for (double& velocity : campaign.recordings[1].velocity) velocity *= 0.1;
  for (double& displacement : campaign.recordings[1].displacement) displacement *= 0.1;
  campaign.roles = {Role::fit, Role::validate, Role::fit};
  IdentifyOptions options;
  options.solvers = {"lm"};
  options.budget = 200;
  options.objective.weighting = Weighting::pooled;
  const Identification result = identify(campaign, "viscous", options, {});
  ASSERT_TRUE(result.nrmse_heldout.has_value());
  // A tenth of the noise, beside what scaling did to the offset of 40 N.
  const double largest = std::max(normaliser(campaign.recordings[0], Normalisation::max_abs),
                                  normaliser(campaign.recordings[2], Normalisation::max_abs));
  const std::vector<double> force =
      predict(result.layout.model(), result.layout.held(), result.terms, make_target(campaign.recordings[1], {}));
  EXPECT_NEAR(*result.nrmse_heldout, score(force, campaign.recordings[1], Normalisation::max_abs).rmse / largest, 1e-9);
}

// Of derivatives that are not finite, as beside a jump of the force, nothing follows for the data.
TEST(Estimates, WithoutADerivativeNothingIsFoundOpen) {
  const Layout layout(make_model("viscous", {}), DataScale{800.0, 0.02, 0.25}, {});
  const std::vector<double> point(layout.dimension(), 0.5);
  const std::size_t squares = layout.dimension() * layout.dimension();
  for (const bool one_known : {false, true}) {
    Response derivatives;
    derivatives.cost = {0.1};
    derivatives.gradient.assign(layout.dimension(), 0.0);
    derivatives.gauss_newton.assign(squares, std::nan(""));
    if (one_known) derivatives.gauss_newton.front() = 1.0;
    Identification result{layout, layout.terms(point), {}, {}, 0, 0.0, {}, {}, {}};
    estimate(result, derivatives, 100.0, point, DriveKind::none);
    ASSERT_EQ(result.estimates.size(), layout.dimension());
    EXPECT_FALSE(result.estimates.back().std_error);
    EXPECT_EQ(result.estimates.back().identifiable, !one_known);
    EXPECT_EQ(result.warnings.size(), one_known ? 0U : 1U);
  }
}

class EveryModel : public ::testing::TestWithParam<const Part*> {};

TEST_P(EveryModel, FindsItselfAgain) {
  const Part& part = *GetParam();
  // A random point in the middle of the reference box, which is then the box of the search too.
  IdentifyOptions options;
  options.budget = 30000;
  options.seed = seed;
  options.objective.threads = 2;
  std::size_t free = 0;
  for (const Parameter& card : part.parameters) {
    if (!card.fixed) {
      options.layout.bounds[std::string(card.name)] = {card.box.lower, card.box.upper};
      ++free;
    }
  }
  if (free > 12) GTEST_SKIP() << free << " free parameters";
  const Layout layout(make_model(part.id, {}), DataScale{}, options.layout);
  const std::vector<double> truth = random_points(Stream(seed).child(part.id), 1, layout.dimension(), 0.25);
  auto recordings = motions();
  for (Recording& recording : recordings) set_force(recording, layout, layout.terms(truth), options.objective);
  // Found when the cost is the rounding of the truth; the rest of the budget would only polish it.
  const Identification result = identify(campaign_of(recordings), std::string(part.id), options,
                                         [](const std::string&, const RunResult& run) { return run.cost > 1e-8; });
  SCOPED_TRACE("seed " + std::to_string(seed));
  EXPECT_LT(result.cost, 1e-4) << result.solvers[0].run.stopped();
  ASSERT_EQ(result.estimates.size(), layout.dimension());
  std::size_t compared = 0;
  for (std::size_t c = 0; c < layout.dimension(); ++c) {
    const Estimate& estimate = result.estimates[c];
    if (!estimate.identifiable || !estimate.std_error) continue;
    ++compared;
    const double u = layout.unit(c, estimate.term.value);
    const double sigma = *estimate.std_error / layout.slope(c, u);
    EXPECT_NEAR(u, truth[c], 2e-3 + 6.0 * sigma) << estimate.name << ", true " << layout.physical(c, truth[c]);
  }
  EXPECT_GT(compared, 0U);
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryModel, ::testing::ValuesIn(model_catalogue().begin(), model_catalogue().end()),
                         [](const auto& instance) {
                           std::string name(instance.param->id);
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST(Identify, ViscousFitIsTheClosedFormLeastSquares) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  const Campaign campaign = viscous_campaign(25.0);
  Eigen::MatrixXd rows(450, 3);
  Eigen::VectorXd force(450);
  Eigen::Index at = 0;
  for (const Recording& recording : campaign.recordings) {
    const double weight =
        1.0 / (normaliser(recording, Normalisation::max_abs) * std::sqrt(static_cast<double>(recording.size())));
    for (std::size_t n = 0; n < recording.size(); ++n, ++at) {
      rows.row(at) << weight * recording.velocity[n], weight * recording.displacement[n], weight;
      force[at] = weight * recording.force[n];
    }
  }
  ASSERT_EQ(at, rows.rows());
  const Eigen::VectorXd exact = rows.colPivHouseholderQr().solve(force);
  const double cost = (rows * exact - force).norm() / std::sqrt(3.0);
  for (const char* solver : {"multistart-lm", "lm"}) {
    IdentifyOptions options;
    options.solvers = {solver};
    options.budget = 2000;
    const Identification result = identify(campaign, "viscous", options, {});
    EXPECT_NEAR(result.cost, cost, 1e-12) << solver;
    EXPECT_NEAR(estimate_of(result, "c0").term.value, exact[0], 1e-8 * std::fabs(exact[0])) << solver;
    EXPECT_NEAR(estimate_of(result, "k0").term.value, exact[1], 1e-8 * std::fabs(exact[1])) << solver;
    EXPECT_NEAR(estimate_of(result, "f0").term.value, exact[2], 1e-8 * 1000.0) << solver;
    // White residuals: the textbook covariance, up to its estimate of their correlation.
    const Eigen::MatrixXd inverse = (rows.transpose() * rows).inverse();
    const double expected = cost * std::sqrt(3.0 / 450.0 * inverse(0, 0));
    const Estimate& c0 = estimate_of(result, "c0");
    ASSERT_TRUE(c0.std_error.has_value());
    EXPECT_NEAR(*c0.std_error, expected, 0.3 * expected) << solver;
  }
}

// Many samples are screened by every k-th one: the optimum of these is not that of all.
TEST(Identify, AScreenedLinearFitIsThatOfAllSamples) {
  for (std::uint64_t draw = 1; draw <= 4; ++draw) {
    auto recordings = std::vector<Recording>{motion("long.csv", {{0.01, 1.0}}, 3.0, 15001, 0.0)};
    Recording& recording = recordings[0];
    const Stream stream(draw);
    Eigen::MatrixXd rows(15001, 3);
    Eigen::VectorXd force(15001);
    for (std::size_t n = 0; n < recording.size(); ++n) {
      const auto row = static_cast<Eigen::Index>(n);
      rows.row(row) << recording.velocity[n], recording.displacement[n], 1.0;
      force[row] = 2000.0 * recording.velocity[n] + 5000.0 * recording.displacement[n] + 20.0 + 5.0 * stream.normal(n);
      recording.force.push_back(force[row]);
    }
    const Eigen::VectorXd exact = rows.colPivHouseholderQr().solve(force);
    const Identification result = identify(campaign_of(recordings), "viscous", {}, {});
    EXPECT_NEAR(estimate_of(result, "c0").term.value, exact[0], 1e-6 * exact[0]) << draw;
    EXPECT_NEAR(estimate_of(result, "k0").term.value, exact[1], 1e-6 * exact[1]) << draw;
  }
}

// A run cut anywhere and told again what it was told goes on as if it had not been cut.
class Resume : public ::testing::TestWithParam<const char*> {};

TEST_P(Resume, ReplayedAnswersGiveTheUninterruptedRun) {
  const SolverEntry* entry = find_solver(GetParam());
  ASSERT_NE(entry, nullptr);
  LayoutOptions layout_options;
  auto recordings = std::vector<Recording>{motion("m.csv", {{0.02, 1.1}}, 2.0, 90, 0.3)};
  const Layout layout(make_model("bouc-wen", {}), DataScale{}, layout_options);
  const std::vector<double> truth(layout.dimension(), 0.4);
  set_force(recordings[0], layout, layout.terms(truth), {}, 0.01, Stream(seed));
  const Objective objective(layout, recordings, {});
  Problem problem;
  problem.dimension = layout.dimension();
  problem.budget = 900;
  problem.stream = Stream(seed).child(entry->id);
  problem.linear = layout.linear();
  problem.start = layout.initial();
  std::vector<Request> asked;
  std::vector<Response> answers;
  std::size_t counted = 0;
  const RunResult whole = run_solver(*entry, problem, [&](const Request& request) {
    counted += request.points.size() / layout.dimension() * (request.derivatives ? 1 + layout.dimension() : 1);
    asked.push_back(request);
    answers.push_back(objective.evaluate(request));
    return answers.back();
  });
  EXPECT_EQ(counted, whole.evaluations);
  EXPECT_LE(whole.evaluations, problem.budget);
  if (whole.ended_by == EndedBy::budget) {
    const std::size_t price = asked.back().derivatives ? 1 + layout.dimension() : 1;
    EXPECT_GT(whole.evaluations + price, problem.budget);
  }
  ASSERT_GT(asked.size(), 1U);
  for (const std::size_t cut : {asked.size() / 3, asked.size() - 1}) {
    std::size_t call = 0;
    const RunResult resumed = run_solver(*entry, problem, [&](const Request& request) {
      const std::size_t k = call++;
      EXPECT_EQ(request.points, asked.at(k).points) << "request " << k;
      EXPECT_EQ(request.derivatives, asked.at(k).derivatives) << "request " << k;
      return k < cut ? answers[k] : objective.evaluate(request);
    });
    EXPECT_EQ(resumed.best, whole.best);
    EXPECT_EQ(resumed.cost, whole.cost);
    EXPECT_EQ(resumed.evaluations, whole.evaluations);
    EXPECT_EQ(resumed.stopped(), whole.stopped());
  }
  // The cost reported is that of the point reported.
  EXPECT_EQ(objective.evaluate({whole.best, asked.back().derivatives}).cost[0], whole.cost);
}

INSTANTIATE_TEST_SUITE_P(Solvers, Resume,
                         ::testing::Values("pso", "ga", "cma-es", "de", "nelder-mead", "lm", "multistart-lm"),
                         [](const auto& instance) {
                           std::string name(instance.param);
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST(Budget, IsSpentToTheLastEvaluationAndNotPassed) {
  const Campaign campaign = viscous_campaign(10.0);
  for (const std::size_t budget : {1, 7, 41, 100}) {
    IdentifyOptions options;
    options.solvers = {"pso"};
    options.budget = budget;
    std::size_t last = 0;
    const Identification result =
        identify(campaign, "viscous", options, [&](const std::string& stage, const RunResult& run) {
          last = stage.starts_with("pso") ? run.evaluations : last;
          return true;
        });
    EXPECT_EQ(result.solvers.at(0).run.evaluations, budget);
    EXPECT_EQ(result.solvers.at(0).run.ended_by, EndedBy::budget);
    EXPECT_EQ(last, budget);
  }
}

TEST(Identify, StopsWhenTheObserverSaysSoAndKeepsTheBest) {
  IdentifyOptions options;
  options.solvers = {"pso"};
  options.budget = 1000000;
  std::size_t calls = 0;
  const Identification result = identify(viscous_campaign(10.0), "viscous", options,
                                         [&](const std::string&, const RunResult&) { return ++calls < 5; });
  EXPECT_EQ(calls, 5U);
  EXPECT_EQ(result.solvers.at(0).run.ended_by, EndedBy::interruption);
  EXPECT_LT(result.cost, 1.0);
}

// Within an evaluation, which a stiff candidate can make longer than anybody waits.
TEST(Identify, StopsWithinAnEvaluationAndKeepsTheBest) {
  for (const int asked_until : {0, 3, 300, 3000}) {
    IdentifyOptions options;
    options.solvers = {"pso"};
    options.budget = 1000000;
    options.objective.threads = 1;
    int asked = 0;
    options.objective.stopped = [&] { return ++asked > asked_until; };
    const Identification result = identify(viscous_campaign(10.0), "viscous", options, {});
    EXPECT_EQ(result.solvers.at(0).run.ended_by, EndedBy::interruption);
    EXPECT_LT(result.cost, asked_until > 100 ? 1.0 : 10.0);
    EXPECT_FALSE(result.estimates.empty());
    EXPECT_FALSE(result.estimates.front().std_error);
    EXPECT_TRUE(result.estimates.front().identifiable) << "nothing was looked at";
    EXPECT_FALSE(result.warnings.empty());
  }
}

TEST(Identify, AFinalFitThatIsInterruptedIsNoWorseThanWhatItStartedFrom) {
  std::vector<Recording> recordings;
  for (const Campaign& campaign : {viscous_campaign(10.0), viscous_campaign(11.0)}) {
    recordings.insert(recordings.end(), campaign.recordings.begin(), campaign.recordings.end());
  }
  IdentifyOptions options;
  options.budget = 600;
  for (const int calls_allowed : {0, 1}) {
    int calls = 0;
    const Identification result = identify(
        campaign_of(recordings), "modified-bouc-wen", options, [&](const std::string& stage, const RunResult&) {
          return stage.find("final fit") == std::string::npos || calls++ < calls_allowed;
        });
    ASSERT_TRUE(result.final_run);
    EXPECT_EQ(result.final_run->ended_by, EndedBy::interruption);
    EXPECT_LT(result.cost, 1.1 * result.solvers.at(result.chosen).run.cost);
    EXPECT_DOUBLE_EQ(result.cost, predicted_nrmse(result.layout, result.terms, refer_to(recordings), {}));
  }
}

TEST(Identify, SameSeedSameBitsOtherSeedOtherRun) {
  const Campaign campaign = viscous_campaign(10.0);
  const auto cost = [&](std::uint64_t of_seed, int threads) {
    IdentifyOptions options;
    options.solvers = {"pso"};
    options.budget = 200;
    options.seed = of_seed;
    options.objective.threads = threads;
    return identify(campaign, "viscous", options, {}).solvers.at(0).run.best;
  };
  EXPECT_EQ(cost(1, 1), cost(1, 7));
  EXPECT_NE(cost(1, 1), cost(2, 1));
}

std::vector<Recording> eleven() {
  std::vector<Recording> recordings;
  for (int k = 0; k < 11; ++k) {
    Recording recording = motion("r" + std::to_string(k) + ".csv", {{0.01 + 0.001 * (k % 4), 1.0}}, 1.0, 40, 0.0);
    set_drive(recording, 0.1 * (k / 4));
    for (std::size_t n = 0; n < recording.size(); ++n) recording.force.push_back(1000.0 * recording.velocity[n] + 1.0);
    recordings.push_back(recording);
  }
  return recordings;
}

TEST(HeldOut, ChoiceIsAFifthSpreadOverTheDriveAndIndependentOfOrder) {
  const auto recordings = eleven();
  const auto chosen = choose_heldout(recordings);
  EXPECT_EQ(chosen, choose_heldout(recordings));
  ASSERT_EQ(chosen.size(), 2U);
  EXPECT_NE(recordings[chosen[0]].drive[0], recordings[chosen[1]].drive[0]);
  auto reversed = recordings;
  std::ranges::reverse(reversed);
  std::vector<std::string> names;
  std::vector<std::string> reversed_names;
  for (const std::size_t k : chosen) names.push_back(recordings[k].file);
  for (const std::size_t k : choose_heldout(reversed)) reversed_names.push_back(reversed[k].file);
  std::ranges::sort(names);
  std::ranges::sort(reversed_names);
  EXPECT_EQ(names, reversed_names);
  EXPECT_TRUE(choose_heldout({recordings[0], recordings[1], recordings[2]}).empty());
  EXPECT_EQ(choose_heldout({recordings[0], recordings[1], recordings[2], recordings[3]}).size(), 1U);
}

TEST(HeldOut, RolesAreFollowed) {
  Campaign campaign = campaign_of(eleven());
  campaign.roles.assign(11, Role::fit);
  campaign.roles[4] = Role::validate;
  for (double& force : campaign.recordings[4].force) force *= 2.0;  // would spoil the fit
  IdentifyOptions options;
  options.budget = 500;
  const Identification result = identify(campaign, "viscous", options, {});
  EXPECT_TRUE(result.roles_given);
  EXPECT_EQ(result.heldout, std::vector<std::size_t>{4});
  EXPECT_EQ(result.fitted.size(), 10U);
  EXPECT_LT(result.cost, 1e-9);
  ASSERT_TRUE(result.nrmse_heldout.has_value());
  // A force twice that of the model leaves half of itself.
  const Recording& held = campaign.recordings[4];
  double square = 0.0;
  for (const double force : held.force) square += 0.25 * force * force / static_cast<double>(held.size());
  EXPECT_NEAR(*result.nrmse_heldout, std::sqrt(square) / normaliser(held, Normalisation::max_abs), 1e-6);
  campaign.roles.assign(11, Role::validate);
  EXPECT_THROW(identify(campaign, "viscous", options, {}), InputError);
}

TEST(HeldOut, WithoutRolesTheFinalFitIsOfAllRecordings) {
  IdentifyOptions options;
  options.budget = 500;
  const Identification result = identify(campaign_of(eleven()), "viscous", options, {});
  EXPECT_FALSE(result.roles_given);
  EXPECT_EQ(result.heldout, choose_heldout(eleven()));
  EXPECT_EQ(result.fitted.size(), 11U);
  EXPECT_TRUE(result.nrmse_heldout.has_value());
}

// A yield displacement is looked for on a logarithm: its interval is as far up as down in factors. A damping below zero
// is none. What may be anything in the search range has no interval.
TEST(Interval, StaysWhereTheParameterCanBe) {
  IdentifyOptions options;
  options.budget = 4000;
  const Layout layout(make_model("bouc-wen", {}), DataScale{}, options.layout);
  const std::vector<double> truth = random_points(Stream(seed).child("interval"), 1, layout.dimension(), 0.4);
  auto recordings = motions();
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    set_force(recordings[r], layout, layout.terms(truth), options.objective, 0.05, Stream(seed).child(r));
  }
  const Identification result = identify(campaign_of(recordings), "bouc-wen", options, {});
  const Estimate& x_y = estimate_of(result, "x_y");
  ASSERT_TRUE(x_y.ci95);
  EXPECT_GT(x_y.ci95->upper / x_y.term.value, 1.01);
  EXPECT_NEAR(x_y.ci95->lower * x_y.ci95->upper, std::pow(x_y.term.value, 2), 1e-9 * std::pow(x_y.term.value, 2));

  const Identification little = identify(viscous_campaign(2000.0, 30.0), "viscous", options, {});
  const Estimate& c0 = estimate_of(little, "c0");
  ASSERT_TRUE(c0.ci95);
  ASSERT_GT(*c0.half_width, c0.term.value) << "the cut matters";
  EXPECT_EQ(c0.ci95->lower, 0.0);
  EXPECT_EQ(c0.ci95->upper, c0.term.value + *c0.half_width);

  options.layout.bounds["c0"] = {c0.term.value * 0.99, c0.term.value * 1.01};
  EXPECT_FALSE(estimate_of(identify(viscous_campaign(2000.0, 30.0), "viscous", options, {}), "c0").ci95)
      << "it holds the whole search range";
}

// What is told of progress is counted at the blocks that standard errors pass.
TEST(Estimates, PassAsManyBlocksAsAreCountedOn) {
  auto recordings = motions();
  for (const char* model : {"viscous", "modified-bouc-wen"}) {
    const Layout layout(make_model(model, {}), DataScale{}, {});
    const std::vector<double> point = random_points(Stream(seed).child("blocks"), 1, layout.dimension(), 0.4);
    ObjectiveOptions options;
    for (std::size_t r = 0; r < recordings.size(); ++r) {
      set_force(recordings[r], layout, layout.terms(point), options, 0.05, Stream(seed).child(r));
    }
    std::atomic<std::size_t> blocks{0};
    options.stopped = [&] {
      ++blocks;
      return false;
    };
    const Objective objective(layout, recordings, options);
    Identification result{layout, layout.terms(point), {}, {}, 0, 0.0, {}, {}, {}, false, {}};
    estimate(result, objective, point, DriveKind::none);
    EXPECT_EQ(blocks, blocks_of_estimate(objective)) << model;
  }
}

// Closed form: where two parameters are linear, a force that is not modelled moves each by its projection on what the
// other one leaves of the shape, and one that is that very shape by all that per_misfit says.
TEST(Estimates, MoveByAnUnmodelledForceOfTheirShapeAsTheySay) {
  IdentifyOptions options;
  options.budget = 4000;
  options.layout.fix = {{"f0", 0.0}};
  Campaign campaign = viscous_campaign(20.0, 3000.0, 12000.0, 0.0);
  campaign.recordings.resize(1);
  campaign.roles.resize(1);
  Recording& recording = campaign.recordings.front();
  const std::vector<double>& x = recording.displacement;
  const std::vector<double>& v = recording.velocity;
  const double mixed = std::inner_product(x.begin(), x.end(), v.begin(), 0.0);
  const double of_x = std::inner_product(x.begin(), x.end(), x.begin(), 0.0);
  double squares = 0.0;
  for (std::size_t n = 0; n < recording.size(); ++n) squares += std::pow(v[n] - mixed / of_x * x[n], 2);
  const double before = estimate_of(identify(campaign, "viscous", options, {}), "c0").term.value;
  constexpr double moved = 40.0;  // N s/m
  for (std::size_t n = 0; n < recording.size(); ++n) recording.force[n] += moved * (v[n] - mixed / of_x * x[n]);
  const Estimate after = estimate_of(identify(campaign, "viscous", options, {}), "c0");
  EXPECT_NEAR(after.term.value - before, moved, 1e-6 * moved);
  const auto size = [](double force) { return std::fabs(force); };
  const double normaliser = size(*std::ranges::max_element(recording.force, {}, size));
  const double nrmse = moved * std::sqrt(squares / static_cast<double>(recording.size())) / normaliser;
  EXPECT_NEAR(nrmse * *after.per_misfit, moved, 1e-6 * moved);
}

// A spring may push the other way, a stop pulls at nothing.
TEST(Interval, OfAStopEndsWhereItDoesNothing) {
  IdentifyOptions options;
  options.budget = 4000;
  options.effects = {"end-stop"};
  options.layout.fix = {
      {"k0", 12e3}, {"f0", 40.0}, {"end-stop.x_up", 6e-3}, {"end-stop.x_low", 6e-3}, {"end-stop.p", 1.0}};
  Campaign campaign = viscous_campaign(500.0);
  for (Recording& recording : campaign.recordings) {
    for (std::size_t n = 0; n < recording.size(); ++n) {
      const double x = recording.displacement[n];
      recording.force[n] += 1e4 * (std::max(x - 6e-3, 0.0) - std::max(-x - 6e-3, 0.0));
    }
  }
  const Identification result = identify(campaign, "viscous", options, {});
  const Estimate& k_b = estimate_of(result, "end-stop.k_b");
  ASSERT_TRUE(k_b.ci95) << k_b.term.value << " of up to " << k_b.upper;
  ASSERT_GT(k_b.term.value, 0.0);
  ASSERT_GT(*k_b.half_width, k_b.term.value) << "the cut matters";
  EXPECT_EQ(k_b.ci95->lower, 0.0);
}

TEST(AtBound, IsRaisedWhenTheTruthIsOutsideAndOnlyThen) {
  IdentifyOptions options;
  options.budget = 1000;
  options.layout.bounds = {{"c0", {0.0, 1000.0}}, {"k0", {20000.0, 30000.0}}};
  const Identification result = identify(viscous_campaign(5.0), "viscous", options, {});
  EXPECT_EQ(estimate_of(result, "c0").at_bound, BoxEnd::upper);
  EXPECT_EQ(estimate_of(result, "k0").at_bound, BoxEnd::lower);
  EXPECT_FALSE(estimate_of(result, "f0").at_bound.has_value());
  EXPECT_FALSE(estimate_of(result, "c0").std_error.has_value());
  EXPECT_FALSE(estimate_of(result, "c0").at_limit);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_NE(
      result.bounds_met.plain().find("c0 (1e+03 N s/m) and k0 (2e+04 N/m) are at the ends of their search ranges"),
      std::string::npos)
      << result.bounds_met.plain();
  EXPECT_NE(result.bounds_met.plain().find("bounds c0=0:1e+04 bounds k0=2e+03:3e+04"), std::string::npos)
      << result.bounds_met.plain();
  options.layout.bounds.clear();
  const Identification inside = identify(viscous_campaign(5.0), "viscous", options, {});
  EXPECT_TRUE(inside.bounds_met.empty()) << inside.bounds_met.plain();
  for (const Estimate& estimate : inside.estimates) {
    EXPECT_FALSE(estimate.at_bound.has_value()) << estimate.name;
    EXPECT_TRUE(estimate.identifiable) << estimate.name;
    EXPECT_TRUE(estimate.std_error.has_value()) << estimate.name;
  }
}

// The step from the bound is exact where the force is affine in the parameters.
TEST(AtBound, WhatTheRangeCostsIsWhatTheWiderFitGains) {
  const Campaign campaign = viscous_campaign(5.0);
  IdentifyOptions options;
  options.budget = 1000;
  const Identification wide = identify(campaign, "viscous", options, {});
  options.layout.bounds = {{"c0", {0.0, 2900.0}}, {"k0", {12500.0, 30000.0}}};
  const Identification narrow = identify(campaign, "viscous", options, {});
  std::vector<double> point;
  for (std::size_t c = 0; c < narrow.layout.dimension(); ++c) {
    point.push_back(narrow.layout.unit(c, narrow.estimates[c].term.value));
  }
  const Objective objective(narrow.layout, campaign.recordings, options.objective);
  const std::optional<double> beyond = cost_beyond_bounds(narrow.layout, objective.evaluate({point, true}), point);
  ASSERT_TRUE(beyond.has_value());
  EXPECT_GT(narrow.cost, 1.5 * wide.cost);
  EXPECT_NEAR(*beyond, wide.cost, 1e-9);
}

TEST(AtBound, TheEndOfWhatAParameterCanBeIsNoMatterOfTheRange) {
  IdentifyOptions options;
  options.budget = 1000;
  const Identification result = identify(viscous_campaign(5.0, -100.0), "viscous", options, {});
  EXPECT_EQ(estimate_of(result, "c0").at_bound, BoxEnd::lower);
  EXPECT_TRUE(estimate_of(result, "c0").at_limit);
  EXPECT_NE(result.bounds_met.plain().find("c0 is 0 N s/m, the least it can be"), std::string::npos)
      << result.bounds_met.plain();
  EXPECT_EQ(result.bounds_met.plain().find(" bounds "), std::string::npos) << result.bounds_met.plain();
}

TEST(Identifiable, TwoOffsetsInOneModelAreFlaggedAndTheRestIsNot) {
  IdentifyOptions options;
  options.budget = 1000;
  options.effects = {"offset-force"};
  const Identification result = identify(viscous_campaign(5.0), "viscous", options, {});
  ASSERT_EQ(result.estimates.size(), 4U);
  EXPECT_TRUE(estimate_of(result, "c0").identifiable);
  EXPECT_TRUE(estimate_of(result, "k0").identifiable);
  EXPECT_FALSE(estimate_of(result, "f0").identifiable);
  EXPECT_FALSE(result.estimates[3].identifiable) << result.estimates[3].name;
  EXPECT_FALSE(result.estimates[3].std_error.has_value());
}

TEST(Identifiable, AccumulatorDeflectionBesideAnOffsetForceIsFlagged) {
  IdentifyOptions options;
  options.budget = 6000;
  options.effects = {"offset-force"};
  options.layout.bounds = {{"x0", {-0.05, 0.05}}, {"k1", {500.0, 20000.0}}};
  options.layout.fix = {{"n", 1.5}, {"share", 0.5}};
  const Layout layout(make_model("modified-bouc-wen", options.effects), DataScale{}, options.layout);
  const std::vector<double> truth(layout.dimension(), 0.4);
  auto recordings = motions();
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    set_force(recordings[r], layout, layout.terms(truth), {}, 0.01, Stream(seed).child(r));
  }
  const Identification result = identify(campaign_of(recordings), "modified-bouc-wen", options, {});
  for (const Estimate* estimate : {&estimate_of(result, "x0"), &result.estimates.back()}) {
    EXPECT_FALSE(estimate->identifiable && !estimate->at_bound)
        << estimate->name << " = " << estimate->term.value << " is called identified; x0 is at the "
        << (estimate_of(result, "x0").at_bound ? "bound" : "inside") << ", f0 at the "
        << (result.estimates.back().at_bound ? "bound" : "inside");
  }
  EXPECT_TRUE(estimate_of(result, "alpha").identifiable);
  EXPECT_TRUE(estimate_of(result, "k1").identifiable);
}

TEST(Identifiable, ARedundantPairWithOneMemberOnABoundIsFlagged) {
  IdentifyOptions options;
  options.budget = 1000;
  options.effects = {"offset-force"};
  // f0 is 40 N: the sum of both, of which the law's part is kept at or below 10 N.
  options.layout.bounds = {{"f0", {-10.0, 10.0}}, {"offset-force.f0", {30.0, 60.0}}};
  const Identification result = identify(viscous_campaign(5.0), "viscous", options, {});
  EXPECT_FALSE(estimate_of(result, "f0").identifiable);
  EXPECT_FALSE(result.estimates.back().identifiable) << result.estimates.back().name;
  EXPECT_TRUE(estimate_of(result, "c0").identifiable);
  EXPECT_TRUE(estimate_of(result, "k0").identifiable);
}

TEST(Final, ASolverWithoutDescentIsFollowedByOneWhichIsReported) {
  IdentifyOptions options;
  options.solvers = {"pso"};
  options.budget = 120;
  const Identification result = identify(viscous_campaign(10.0), "viscous", options, {});
  ASSERT_TRUE(result.final_run.has_value());
  EXPECT_EQ(result.final_run->solver, "lm");
  EXPECT_EQ(result.final_stage, "final descent on the same recordings");
  EXPECT_GT(result.final_run->evaluations, 0U);
  EXPECT_LT(result.cost, result.solvers.at(0).run.cost);
  EXPECT_EQ(result.cost, result.final_run->cost);
  EXPECT_EQ(result.solvers.at(0).run.evaluations, 120U);
  options.solvers = {"multistart-lm"};
  EXPECT_FALSE(identify(viscous_campaign(10.0), "viscous", options, {}).final_run.has_value());
}

TEST(Screening, IsCountedAndNeverReported) {
  std::vector<Recording> recordings{motion("m.csv", {{0.02, 1.1}}, 2.0, 1200, 0.3)};
  const Layout layout(make_model("bouc-wen", {}), DataScale{}, {});
  set_force(recordings[0], layout, layout.terms(std::vector<double>(layout.dimension(), 0.4)), {}, 0.01, Stream(seed));
  const Objective objective(layout, recordings, {});
  EXPECT_LT(objective.screening_targets()[0].force.size(), objective.targets()[0].force.size());
  const SolverEntry* entry = find_solver("multistart-lm");
  std::size_t screened = 0;
  std::size_t counted = 0;
  const auto run = [&](std::size_t budget, const Observer& observer) {
    screened = counted = 0;
    Problem problem;
    problem.dimension = layout.dimension();
    problem.budget = budget;
    problem.stream = Stream(seed);
    problem.linear = layout.linear();
    problem.screening = true;
    return run_solver(
        *entry, problem,
        [&](const Request& request) {
          const std::size_t points = request.points.size() / layout.dimension();
          screened += request.screening ? points : 0;
          counted += points * (request.derivatives ? 1 + layout.dimension() : 1);
          return objective.evaluate(request);
        },
        observer);
  };
  const RunResult whole = run(20000, {});
  EXPECT_GT(screened, 0U);
  EXPECT_EQ(whole.evaluations, counted);
  EXPECT_EQ(whole.cost, objective.evaluate({whole.best, false}).cost[0]);
  // One that is cut while it screens still reports a cost of the full objective.
  const RunResult cut = run(20000, [](const RunResult&) { return false; });
  EXPECT_GT(screened, 0U);
  EXPECT_EQ(cut.evaluations, counted);
  EXPECT_EQ(cut.cost, objective.evaluate({cut.best, false}).cost[0]);
  // Too small a budget is not spent on screening.
  const RunResult small = run(300, {});
  EXPECT_EQ(screened, 0U);
  EXPECT_EQ(small.cost, objective.evaluate({small.best, false}).cost[0]);
}

TEST(Identify, RefusesWhatItCannotDo) {
  const Campaign campaign = viscous_campaign(5.0);
  IdentifyOptions options;
  options.budget = 100;
  EXPECT_THROW(identify(campaign, "viscus", options, {}), InputError);
  options.solvers = {"psoo"};
  EXPECT_THROW(identify(campaign, "viscous", options, {}), InputError);
  options.solvers = {"pso"};
  options.settings = {{"no-such-setting", 1.0}};
  EXPECT_THROW(identify(campaign, "viscous", options, {}), InputError);
  options.settings.clear();
  options.layout.fix = {{"c0", 1.0}, {"k0", 1.0}, {"f0", 1.0}};
  EXPECT_THROW(identify(campaign, "viscous", options, {}), InputError);
}

}  // namespace
}  // namespace hysteron
