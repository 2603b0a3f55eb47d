#include "diagnose/search/score.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/squared.hpp"
#include "diagnose/search/left_out.hpp"
#include "diagnose/search/stage.hpp"
#include "fit/score.hpp"
#include "fit/synthetic.hpp"

namespace hysteron {
namespace {

constexpr std::uint64_t seed = 11;

// Five sines of a viscous damper with an effect, without run-in.
std::vector<Recording> recordings_with(const std::vector<std::string>& effects,
                                       const std::map<std::string, double>& values, double noise) {
  LayoutOptions made;
  made.fix = {{"c0", 1500.0}, {"k0", 4000.0}, {"f0", 10.0}};
  made.fix.insert(values.begin(), values.end());
  const Layout layout(make_model("viscous", effects), DataScale{}, made);
  std::vector<Recording> result;
  for (const double frequency : {0.5, 0.9, 1.6, 2.5, 4.0}) {
    Recording recording = testing::motion("r" + std::to_string(result.size()) + ".csv",
                                          {{0.008 / std::sqrt(frequency), frequency}}, 3.0 / frequency, 400, 0.0);
    testing::set_force(recording, layout, layout.terms(layout.initial()), {}, noise, Stream(seed).child(result.size()));
    result.push_back(recording);
  }
  return result;
}

Workbench bench_of(const std::vector<Recording>& all, std::vector<Recording> fitted) {
  ObjectiveOptions options;
  options.threads = 1;
  return Workbench(scale_of(all), Split{std::move(fitted), {}, {}, false}, {}, options, seed, [] { return false; });
}

// The law is linear in its parameters: one Gauss-Newton step is the fit itself.
TEST(LeftOut, IsTheRefitWithoutTheRecordingWhereTheLawIsLinear) {
  const std::vector<Recording> all = recordings_with({"quadratic-damping"}, {{"quadratic-damping.d2", 4e3}}, 0.02);
  const Workbench bench = bench_of(all, all);
  const Fit fit = bench.from_anywhere({"viscous", {}, {}}, 2000);
  const LeftOut out = left_out(bench, fit);
  EXPECT_NEAR(out.squares, squared(fit.cost), 1e-6 * out.squares);
  double worst = 0.0;
  for (std::size_t r = 0; r < all.size(); ++r) {
    std::vector<Recording> others = all;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(r));
    const Workbench without = bench_of(all, others);
    const Fit refitted = without.polished(fit, 20);
    const Workbench only = bench_of(all, {all[r]});
    const double expected = squared(only.scored(refitted).cost);
    double mean = 0.0;
    for (const double square : out.predicted[r]) {
      mean += square / static_cast<double>(out.predicted[r].size());
    }
    EXPECT_NEAR(mean, expected, 2e-2 * expected) << r;
    worst = std::max(worst, expected / squared(only.scored(fit).cost));
  }
  EXPECT_GT(worst, 1.05) << "what is not fitted is predicted worse";
}

TEST(LeftOut, RecordingsOfOneMotionAreLeftOutTogether) {
  std::vector<Recording> all = recordings_with({"quadratic-damping"}, {{"quadratic-damping.d2", 4e3}}, 0.02);
  // The first motion once more, with noise of its own.
  Recording again = all.front();
  again.file = "again.csv";
  for (std::size_t n = 0; n < again.size(); ++n) {
    again.force[n] += 0.5 * (all[1].force[n] - all[1].force[(n + 1) % again.size()]);
  }
  all.push_back(again);
  const Workbench bench = bench_of(all, all);
  EXPECT_EQ(bench.motions(), (std::vector<std::size_t>{0, 1, 2, 3, 4, 0}));
  const Fit fit = bench.from_anywhere({"viscous", {}, {}}, 2000);
  const LeftOut out = left_out(bench, fit);
  const Workbench without = bench_of(all, {all[1], all[2], all[3], all[4]});
  const Fit refitted = without.polished(fit, 20);
  for (const std::size_t r : {std::size_t{0}, all.size() - 1}) {
    const Residual expected = bench.residual(refitted, all[r]);
    ASSERT_EQ(out.residuals[r].size(), all[r].size() - expected.from);
    double difference = 0.0;
    double size = 0.0;
    const double unit = normaliser(all[r], Normalisation::max_abs);
    for (std::size_t n = 0; n < out.residuals[r].size(); ++n) {
      const double value = expected.force[expected.from + n] / unit;
      difference += squared(out.residuals[r][n] - value);
      size += squared(value);
    }
    EXPECT_LT(difference, 1e-4 * size) << r;
  }
}

TEST(Workbench, AFarTooLargeSizeIsHalvedBeforeADescent) {
  const std::vector<Recording> all = recordings_with({"self-heating"}, {{"self-heating.b", 1e-4}}, 0.02);
  const Workbench bench = bench_of(all, all);
  const Fit base = bench.from_anywhere({"viscous", {}, {}}, 2000);
  const Hypothesis warm = {"viscous", {"self-heating"}, {}};
  Starts starts = bench.starts(warm, base);
  for (std::vector<double>& point : starts.points) {
    for (const std::size_t c : starts.sizes) {
      point[c] = 1.0;
    }
  }
  Fit as_given = bench.with_neutral(base, "self-heating");
  as_given.point = starts.points.front();
  const double given = bench.scored(as_given).cost;
  ASSERT_GT(given, 1.1 * base.cost) << "the start is no better than it should be";
  // One round of a descent is its start: a sixteenth of the size costs next to nothing more than none.
  EXPECT_LT(bench.from_starts(warm, starts, 1, 4).cost - base.cost, 0.05 * (given - base.cost));
}

TEST(Score, OfAnEffectThatIsLinearIsWhatARefitGains) {
  const std::vector<Recording> all = recordings_with({"inertia"}, {{"inertia.m", 6.0}}, 0.01);
  const Workbench bench = bench_of(all, all);
  const Fit base = bench.from_anywhere({"viscous", {}, {}}, 2000);
  const std::vector<Extension> extensions = {effect_extension("quadratic-damping"), effect_extension("inertia"),
                                             effect_extension("offset-force"), effect_extension("cubic-stiffness")};
  const std::vector<Scored> scores = scored(bench, base, extensions);
  ASSERT_EQ(scores.size(), extensions.size());
  EXPECT_EQ(scores[0].part.effect, "inertia");
  const Fit refitted = bench.from_fit(Hypothesis{"viscous", {"inertia"}, {}}, base, fitting_rounds);
  const double gained = squared(base.cost) - squared(refitted.cost);
  EXPECT_NEAR(scores[0].gain, gained, 0.02 * gained);
  // The best start is already where the refit ends.
  const Fit start = bench.from_starts({"viscous", {"inertia"}, {}},
                                      {scores[0].starts.layout, {scores[0].starts.points[0]}, {}, {}}, 2, 1);
  EXPECT_LT(squared(start.cost) - squared(refitted.cost), 0.02 * gained);
}

// A stage tells how far it is at every first look and every refit; it stood still for as long as the looks take.
TEST(Stage, TellsHowFarItIs) {
  const std::vector<Recording> all = recordings_with({"inertia"}, {{"inertia.m", 6.0}}, 0.01);
  const Workbench bench = bench_of(all, all);
  const Fit base = bench.from_anywhere({"viscous", {}, {}}, 2000);
  const std::vector<Extension> extensions = {effect_extension("quadratic-damping"), effect_extension("inertia"),
                                             effect_extension("offset-force"), effect_extension("cubic-stiffness")};
  std::vector<double> shares;
  const auto told = [&](double share) { shares.push_back(share); };
  const std::vector<Tried> tried = stage(bench, base, extensions, 100.0, nullptr, {}, told);
  const auto refitted =
      static_cast<std::size_t>(std::ranges::count_if(tried, [](const Tried& one) { return one.fit.has_value(); }));
  EXPECT_EQ(shares.size(), extensions.size() + refitted);
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_LE(shares.back(), 1.0);
  shares.clear();
  static_cast<void>(left_out(bench, {&base, &*tried[0].fit}, told));
  EXPECT_EQ(shares, (std::vector<double>{0.5, 1.0}));
}

TEST(Score, NoExtensionTakesMoreOffThanThereIs) {
  const std::vector<Recording> all =
      recordings_with({"end-stop"}, {{"end-stop.k_b", 3e5}, {"end-stop.x_up", 6e-3}}, 0.01);
  const Workbench bench = bench_of(all, all);
  const Fit base = bench.from_anywhere({"viscous", {}, {}}, 2000);
  std::vector<Extension> extensions;
  for (const Part* effect : effect_catalogue()) {
    if (effect->on_double.excite == nullptr && effect->on_double.recall == nullptr) {
      extensions.push_back(effect_extension(std::string(effect->id)));
    }
  }
  double last = 1e300;
  for (const Scored& score : scored(bench, base, extensions)) {
    EXPECT_GE(score.gain, 0.0) << name_of(score.part);
    EXPECT_LE(score.gain, squared(base.cost) * (1.0 + 1e-9)) << name_of(score.part);
    EXPECT_LE(score.gain, last);
    last = score.gain;
  }
}

TEST(Stage, RefitsWhatTheScorePromisesAndKeepsTheOrder) {
  const std::vector<Recording> all = recordings_with({"inertia"}, {{"inertia.m", 6.0}}, 0.01);
  const Workbench bench = bench_of(all, all);
  const Fit base = bench.from_anywhere({"viscous", {}, {}}, 2000);
  std::vector<Extension> extensions;
  for (const char* id : {"quadratic-damping", "inertia", "offset-force", "cubic-stiffness", "force-drift",
                         "seal-friction", "asymmetry", "gas-spring"}) {
    extensions.push_back(effect_extension(id));
  }
  const std::vector<Tried> tried = stage(bench, base, extensions, 200.0);
  ASSERT_EQ(tried.size(), extensions.size());
  EXPECT_EQ(tried[0].part.effect, "inertia");
  ASSERT_TRUE(tried[0].fit.has_value());
  bool seen_unfitted = false;
  for (const Tried& one : tried) {
    EXPECT_FALSE(seen_unfitted && one.fit) << "refitted ones come first";
    seen_unfitted = seen_unfitted || !one.fit;
  }
  EXPECT_TRUE(seen_unfitted);
}

TEST(Stage, ALawOfAnEffectThatIsNotThereIsNoCandidate) {
  const std::vector<Recording> all = recordings_with({"inertia"}, {{"inertia.m", 6.0}}, 0.01);
  const Workbench bench = bench_of(all, all);
  const Fit base = bench.from_anywhere({"viscous", {}, {}}, 2000);
  const std::vector<Tried> tried =
      stage(bench, base, {law_extension({"inertia.m"}), effect_extension("inertia")}, 200.0);
  ASSERT_EQ(tried.size(), 1U);
  EXPECT_EQ(tried[0].part.effect, "inertia");
}

TEST(Stage, WhatTheLawHasAsAPartOfItsOwnIsNoCandidate) {
  const std::vector<Recording> all = recordings_with({"inertia"}, {{"inertia.m", 6.0}}, 0.01);
  const Workbench bench = bench_of(all, all);
  const auto tried = [&](const std::string& law) {
    std::vector<std::string> ids;
    const Fit base = bench.from_anywhere({law, {}, {}}, 500);
    for (const Tried& one :
         stage(bench, base, {effect_extension("series-dashpot"), effect_extension("inertia")}, 200.0)) {
      ids.push_back(one.part.effect);
    }
    std::ranges::sort(ids);
    return ids;
  };
  EXPECT_EQ(tried("modified-bouc-wen"), std::vector<std::string>{"inertia"});
  EXPECT_EQ(tried("bouc-wen"), (std::vector<std::string>{"inertia", "series-dashpot"}));
}

TEST(Hypothesis, PartsComeAndGo) {
  Hypothesis what{"bouc-wen", {"inertia"}, {"alpha"}};
  const Extension law = law_extension({"alpha", "c0"});
  const Hypothesis more = with(with(what, law), effect_extension("asymmetry"));
  EXPECT_EQ(more.richer, (std::vector<std::string>{"alpha", "alpha", "c0"}));
  EXPECT_EQ(name_of(law), "law:alpha,c0");
  EXPECT_TRUE(contains(more, law));
  EXPECT_TRUE(same_parts(without(without(more, law), effect_extension("asymmetry")), what));
  // A parameter that goes takes its law along.
  const Hypothesis lawful = with(more, law_extension({"asymmetry.e"}));
  EXPECT_EQ(without(lawful, effect_extension("asymmetry")), without(more, effect_extension("asymmetry")));
  const std::vector<Extension> parts = extensions_of(more);
  ASSERT_EQ(parts.size(), 4U);
  EXPECT_EQ(parts[2], law_extension({"alpha", "alpha"}));
}

}  // namespace
}  // namespace hysteron
