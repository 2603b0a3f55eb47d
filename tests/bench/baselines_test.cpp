// Simpler methods on cases with known answers.
#include <gtest/gtest.h>

#include "baselines/sparse.hpp"
#include "baselines/stepwise.hpp"
#include "fit/synthetic.hpp"

namespace hysteron::baselines {
namespace {

// Two parameters more, ten degrees of freedom.
Step step_with(const std::string& effect, double f) { return {effect, 1.0 + 2.0 * f / 10.0, 1.0, 2.0, 3.0}; }
constexpr double values = 15.0;

TEST(FTest, ProbabilityIsThatOfTheTables) {
  EXPECT_NEAR(p_of(step_with("a", 4.103), values), 0.05, 1e-4);
  EXPECT_NEAR(p_of(step_with("a", 7.559), values), 0.01, 1e-4);
  EXPECT_EQ(p_of(step_with("a", -0.1), values), 1.0);
}

TEST(FTest, HolmAsksLessOfEachFurtherOneAndStopsAtTheFirstThatFails) {
  // p = 0.01, 0.02 and 0.04 against 5 % over 3, 2 and 1.
  const Step first = step_with("first", 7.559);
  const Step second = step_with("second", 5.93);
  const Step third = step_with("third", 4.53);
  ASSERT_NEAR(p_of(second, values), 0.02, 1e-3);
  ASSERT_NEAR(p_of(third, values), 0.04, 1e-3);
  EXPECT_EQ(significant({third, first, second}, values, 0.05), (std::vector<std::string>{"first", "second", "third"}));
  // Of four the second fails at 5 % over 3, and the others with it.
  const Step fourth = step_with("fourth", 0.1);
  EXPECT_EQ(significant({third, first, second, fourth}, values, 0.05), (std::vector<std::string>{"first"}));
}

TEST(Sparse, ThresholdingKeepsTheTermsThatAreThere) {
  const Stream stream(7);
  Eigen::MatrixXd terms(400, 6);
  for (Eigen::Index k = 0; k < terms.size(); ++k) {
    terms.data()[k] = stream.normal(static_cast<std::uint64_t>(k));
  }
  // Nearly a double of another one.
  terms.col(5) = terms.col(1) + 0.3 * terms.col(5);
  const Eigen::VectorXd target = 2.0 * terms.col(1) - 0.7 * terms.col(4);
  const Eigen::VectorXd found = thresholded(terms, target, 0.1 * target.norm());
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(6);
  expected[1] = 2.0;
  expected[4] = -0.7;
  EXPECT_LT((found - expected).norm(), 1e-10);
  EXPECT_EQ(thresholded(terms, target, 2.0 * target.norm()), Eigen::VectorXd::Zero(6).eval());
}

// Five sines of a viscous damper with an effect.
Workbench bench_with(const std::vector<std::string>& effects, const std::map<std::string, double>& fixed) {
  LayoutOptions made;
  made.fix = {{"c0", 1500.0}, {"k0", 4000.0}, {"f0", 10.0}};
  made.fix.insert(fixed.begin(), fixed.end());
  const Layout layout(make_model("viscous", effects), DataScale{}, made);
  std::vector<Recording> recordings;
  for (const double frequency : {0.5, 0.9, 1.6, 2.5, 4.0}) {
    Recording recording = testing::motion("r" + std::to_string(recordings.size()) + ".csv",
                                          {{0.008 / std::sqrt(frequency), frequency}}, 3.0 / frequency, 400, 0.0);
    testing::set_force(recording, layout, layout.terms(layout.initial()), {}, 0.01, Stream(5).child(recordings.size()));
    recordings.push_back(recording);
  }
  ObjectiveOptions options;
  options.threads = 1;
  return Workbench(scale_of(recordings), Split{recordings, {}, {}, false}, {}, options, 5, [] { return false; });
}

std::vector<std::string_view> named_by_terms(const Workbench& bench) {
  const Fit base = bench.from_anywhere({"viscous", {}, {}}, 2000);
  const Regression regression = regression_of(bench, base, bench.residuals(base));
  std::vector<std::string_view> names;
  for (const std::size_t term : chosen_terms(regression, static_cast<double>(regression.samples))) {
    names.push_back(library()[term].text);
  }
  return names;
}

TEST(Sparse, NamesTheTermThatIsHidden) {
  EXPECT_EQ(named_by_terms(bench_with({"quadratic-damping"}, {{"quadratic-damping.d2", 4e3}})),
            (std::vector<std::string_view>{"|v| v"}));
  EXPECT_EQ(named_by_terms(bench_with({"cubic-stiffness"}, {{"cubic-stiffness.k3", 5e7}})),
            (std::vector<std::string_view>{"x^3"}));
  EXPECT_TRUE(named_by_terms(bench_with({}, {})).empty());
}

TEST(Forward, AddsWhatIsHiddenAndNoMore) {
  const std::vector<std::string> effects = {"inertia", "quadratic-damping", "offset-force", "cubic-stiffness"};
  const auto selected = [&](const Workbench& bench) {
    const Fit base = bench.from_anywhere({"viscous", {}, {}}, 2000);
    return forward(bench, base, refits(bench, base, effects), effects, 2000.0, 5);
  };
  EXPECT_EQ(selected(bench_with({"cubic-stiffness", "quadratic-damping"},
                                {{"quadratic-damping.d2", 4e3}, {"cubic-stiffness.k3", 5e7}}))
                .size(),
            2U);
  EXPECT_EQ(selected(bench_with({"inertia"}, {{"inertia.m", 6.0}})), (std::vector<std::string>{"inertia"}));
  EXPECT_TRUE(selected(bench_with({}, {})).empty());
}

}  // namespace
}  // namespace hysteron::baselines
