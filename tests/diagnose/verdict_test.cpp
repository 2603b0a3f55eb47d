#include "diagnose/verdict.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hysteron {
namespace {

constexpr double floor_squares = 1e-4;

// A search that found one effect: `left` is the squared error it leaves, `gain` what it took off.
Search search_of(const std::string& id, double left, double gain, bool structured = false) {
  Search search;
  search.misfit.squares = left;
  search.misfit.white = search.misfit.floor = floor_squares;
  search.misfit.structure = structured ? 0.8 * (left - floor_squares) : 0.0;
  search.misfit.noise = left - search.misfit.structure;
  search.misfit.predictable = structured ? 0.5 : 0.0;
  search.base_misfit = search.misfit;
  search.base_misfit.squares = left + gain;
  search.augmented.cost = search.augmented.heldout = std::sqrt(left);
  search.base.cost = search.base.heldout = std::sqrt(left + gain);
  Found found;
  found.id = id;
  found.gain = gain;
  found.evidence = 1e4;
  found.without = search.base;
  found.share_of_misfit = 0.9;
  search.found = {found};
  return search;
}

Rival rival(const std::string& id, double share, double evidence) {
  Rival row;
  row.id = id;
  row.share = share;
  row.evidence = evidence;
  return row;
}

Fit with_velocity_lag(double lag) {
  Fit fit;
  fit.what = {"viscous", {"velocity-lag"}, {}};
  fit.layout = std::make_shared<const Layout>(make_model("viscous", {"velocity-lag"}), DataScale{}, LayoutOptions{});
  fit.point = fit.layout->initial();
  for (std::size_t c = 0; c < fit.layout->dimension(); ++c) {
    if (fit.layout->names()[fit.layout->coordinates()[c].parameter] == "velocity-lag.lag") {
      fit.point[c] = fit.layout->unit(c, lag);
    }
  }
  fit.terms = fit.layout->terms(fit.point);
  return fit;
}

TEST(Verdict, FarFromTheNoiseOnlyADominantEffectIsNamed) {
  EXPECT_EQ(verdict_of(search_of("inertia", 1.5 * floor_squares, 20.0 * floor_squares), {}).word, "missing-physics");
  // Fifteen times the noise stays: an effect of five times what stays is no answer, one of twenty times is.
  const double left = 16.0 * floor_squares;
  EXPECT_EQ(verdict_of(search_of("inertia", left, 5.0 * 15.0 * floor_squares, true), {}).word, "unattributed");
  EXPECT_EQ(verdict_of(search_of("inertia", left, 20.0 * 15.0 * floor_squares, true), {}).word, "missing-physics");
}

TEST(Verdict, ARivalThatLeavesMuchMoreThanNoiseIsExcluded) {
  // One part in a hundred of the gain: eleven times what stays above the noise ...
  Search search = search_of("linear-stiffness", 1.2 * floor_squares, 220.0 * floor_squares);
  search.found[0].rivals = {rival("cubic-stiffness", 0.99, 500.0)};
  const Verdict clear = verdict_of(search, {});
  ASSERT_EQ(clear.word, "missing-physics");
  EXPECT_TRUE(clear.effects[0].indistinguishable_from.empty());
  // ... and half of it where more stays.
  search = search_of("linear-stiffness", 5.0 * floor_squares, 220.0 * floor_squares);
  search.found[0].rivals = {rival("cubic-stiffness", 0.99, 500.0)};
  EXPECT_EQ(verdict_of(search, {}).word, "ambiguous");
}

TEST(Verdict, AFormThatHoldsTheEffectAsItsLimitMustBeWorthItsParameters) {
  Search search = search_of("offset-force", 1.1 * floor_squares, 50.0 * floor_squares);
  search.found[0].rivals = {rival("gas-spring", 1.0, 5.0)};
  EXPECT_EQ(verdict_of(search, {}).word, "missing-physics");
  search.found[0].rivals = {rival("gas-spring", 1.0, -1.0)};
  EXPECT_EQ(verdict_of(search, {}).word, "ambiguous");
}

TEST(Verdict, TheChannelsTellALagOfTheVelocityFromADelayOfTheForce) {
  // The recorded velocity comes 5 ms late, so that the one that acts leads it.
  const ChannelLag channel{5e-3, 1e-5};
  Search search = search_of("sensor-delay", 1.1 * floor_squares, 50.0 * floor_squares);
  search.found[0].rivals = {rival("velocity-lag", 1.0, 1.0)};
  search.found[0].rivals[0].fit = with_velocity_lag(-4.9e-3);
  Verdict verdict = verdict_of(search, channel);
  ASSERT_EQ(verdict.word, "missing-physics");
  EXPECT_EQ(verdict.effects[0].id, "velocity-lag");
  search.found[0].rivals[0].fit = with_velocity_lag(2e-3);
  verdict = verdict_of(search, channel);
  ASSERT_EQ(verdict.word, "missing-physics");
  EXPECT_EQ(verdict.effects[0].id, "sensor-delay");
  search = search_of("velocity-lag", 1.1 * floor_squares, 50.0 * floor_squares);
  search.augmented.layout = with_velocity_lag(-4.9e-3).layout;
  search.augmented.terms = with_velocity_lag(-4.9e-3).terms;
  search.found[0].rivals = {rival("sensor-delay", 1.0, 1.0)};
  EXPECT_EQ(verdict_of(search, channel).word, "missing-physics");
}

}  // namespace
}  // namespace hysteron
