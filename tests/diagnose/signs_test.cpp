#include "diagnose/search/signs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/squared.hpp"
#include "fit/score.hpp"
#include "fit/synthetic.hpp"

namespace hysteron {
namespace {

constexpr std::uint64_t seed = 11;

// Four sines of a viscous damper with a gas spring that is compressed by negative displacement.
std::vector<Recording> of_gas_spring() {
  LayoutOptions made;
  made.fix = {{"c0", 1500.0},           {"k0", 0.0}, {"f0", 0.0}, {"gas-spring.f_g", -250.0}, {"gas-spring.g", -11.0},
              {"gas-spring.kappa", 1.2}};
  const Layout layout(make_model("viscous", {"gas-spring"}), DataScale{}, made);
  std::vector<Recording> result;
  for (const double amplitude : {0.006, 0.012, 0.02, 0.03}) {
    Recording recording =
        testing::motion("r" + std::to_string(result.size()) + ".csv", {{amplitude, 1.0}}, 3.0, 400, 0.0);
    testing::set_force(recording, layout, layout.terms(layout.initial()), {}, 0.01, Stream(seed).child(result.size()));
    result.push_back(recording);
  }
  return result;
}

double value_of(const Fit& fit, const std::string& name) {
  const auto at = std::ranges::find_if(
      fit.terms, [&](const Term& term) { return fit.layout->names()[term.parameter] == name && term.constant(); });
  return at == fit.terms.end() ? 0.0 : at->value;
}

class Signs : public ::testing::Test {
 protected:
  std::vector<Recording> recordings_ = of_gas_spring();
  ObjectiveOptions options_;
  Workbench bench_{scale_of(recordings_), Split{recordings_, {}, {}, false}, {}, options_, seed, [] { return false; }};

  // Of the gas spring beside a cubic stiffness, descended from a gas force and a swept fraction.
  Fit descended_from(double force, double swept) {
    const Hypothesis what{"viscous", {"gas-spring", "cubic-stiffness"}, {}};
    const auto layout = std::make_shared<const Layout>(bench_.layout(what));
    const std::vector<double> point =
        testing::point_with(*layout, layout->initial(), {{"gas-spring.f_g", force}, {"gas-spring.g", swept}});
    return bench_.from_starts(what, {layout, {point}, point, {}}, 10, 1);
  }
};

TEST_F(Signs, AGasSpringThatIsCompressedTheWrongWayIsTurnedRound) {
  const Fit wrong = descended_from(-200.0, 14.0);
  ASSERT_LT(value_of(wrong, "gas-spring.f_g") * value_of(wrong, "gas-spring.g"), 0.0) << "a descent ends there";
  const auto turned = turned_round(bench_, wrong);
  ASSERT_TRUE(turned.has_value());
  EXPECT_NEAR(value_of(*turned, "gas-spring.g"), -11.0, 3.0);
  EXPECT_LT(value_of(*turned, "gas-spring.f_g"), 0.0);
  EXPECT_LE(turned->cost, 1.005 * wrong.cost);
}

TEST_F(Signs, APossibleOneIsLeftAlone) {
  const Fit right = descended_from(-200.0, -14.0);
  ASSERT_GT(value_of(right, "gas-spring.f_g") * value_of(right, "gas-spring.g"), 0.0);
  EXPECT_FALSE(turned_round(bench_, right).has_value());
}

}  // namespace
}  // namespace hysteron
