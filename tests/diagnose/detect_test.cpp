// What the diagnosis says could not have been seen follows from forces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "diagnose/search/observe.hpp"
#include "diagnose/search/of_fit.hpp"
#include "diagnose/search/signature.hpp"
#include "fit/synthetic.hpp"

namespace hysteron {
namespace {

// A Bouc-Wen damper at 1 A, its base fit on three sines.
struct Base {
  Workbench bench;
  Fit fit;
};

// `apart`: how far the last of them lies from the others.
Base base_of(double apart = 0.0) {
  LayoutOptions made;
  made.fix = {{"alpha", 600.0}, {"c0", 1500.0}, {"k0", 2000.0}, {"f0", 20.0},
              {"x_y", 8e-4},    {"share", 0.6}, {"n", 1.5}};
  const Layout layout(make_model("bouc-wen", {}), DataScale{}, made);
  Split split;
  for (const double frequency : {0.7, 1.3, 2.6}) {
    Recording recording = testing::motion("r.csv", {{0.01, frequency}}, 4.0 / frequency, 600, 0.2 / frequency);
    if (frequency > 2.0) {
      std::ranges::for_each(recording.displacement, [&](double& x) { x += apart; });
    }
    testing::set_force(recording, layout, layout.terms(layout.initial()), {}, 0.01, Stream(3).child(split.fit.size()));
    testing::set_drive(recording, 1.0);
    split.fit.push_back(recording);
  }
  split.judge.push_back({split.fit[0], 0});
  Workbench bench(scale_of(split.fit), split, {}, {}, 1, [] { return false; });
  Fit fit = bench.from_anywhere({"bouc-wen", {}, {}}, 4000);
  return {std::move(bench), std::move(fit)};
}

TEST(DetectionLimits, FollowFromForces) {
  const Base base = base_of();
  std::vector<std::string> every;
  for (const Part* effect : effect_catalogue()) {
    every.emplace_back(effect->id);
  }
  const Misfit misfit = misfit_of(base.bench, base.fit);
  const std::vector<Unobservable> rows = detection_limits(base.bench, base.fit, misfit, every);
  ASSERT_EQ(rows.size(), every.size());
  for (const Unobservable& row : rows) {
    EXPECT_NE(row.reason.empty(), row.detection_limit.empty()) << row.id;
    EXPECT_EQ((row.reason + row.detection_limit).find("nan"), std::string::npos) << row.id;
    EXPECT_EQ((row.reason + row.detection_limit).find("inf"), std::string::npos) << row.id;
    const bool none = row.reason.starts_with("it changes no force");
    // The current is constant and no parameter follows it: only what acts through it does nothing.
    EXPECT_EQ(none, row.id == "coil-lag" || row.id.starts_with("magnetic-")) << row.id << ": " << row.reason;
  }
  // These change the force by ten times the noise at a part of their range, whatever their derivative at none.
  for (const char* id : {"clearance", "cavitation", "inertia", "entrapped-gas", "compliance"}) {
    const auto row = std::ranges::find(rows, id, &Unobservable::id);
    ASSERT_NE(row, rows.end()) << id;
    EXPECT_FALSE(row->detection_limit.empty()) << id << ": " << row->reason;
  }
}

// A Bouc-Wen law has a spring, a dashpot and an offset in parallel; its hysteresis is no friction, and it is no mass.
TEST(HadByTheLaw, IsWhatItHasInTheSameForm) {
  const Base base = base_of();
  const std::vector<std::string> had = had_by_the_law(
      base.bench, base.fit, {"coulomb-friction", "inertia", "linear-stiffness", "offset-force", "viscous-damping"});
  EXPECT_EQ(had, (std::vector<std::string>{"linear-stiffness", "offset-force", "viscous-damping"}));
}

// The middle of all strokes, around which a weak range is looked for, is a place where no rod was.
TEST(DetectionLimits, SayThatNoRecordingComesWhereAnEffectIsLookedFor) {
  const Base base = base_of(0.1);
  const std::vector<Unobservable> rows =
      detection_limits(base.bench, base.fit, misfit_of(base.bench, base.fit), {"pinching"});
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_TRUE(rows.front().reason.starts_with("no recording comes where it is looked for, x_p from 0.0"))
      << rows.front().reason;
}

// Samples so far apart that friction which turns over in its initial length cannot be simulated from one to the next.
TEST(DetectionLimits, AShapeThatIsTooStiffGivesWayToOneThatIsNot) {
  const Base fine = base_of();
  Split split = fine.bench.split();
  for (Recording& recording : split.fit) {
    recording = every_kth(recording, 12);
  }
  ObjectiveOptions comparing;
  comparing.comparing = true;
  const Workbench coarse(scale_of(split.fit), split, {}, comparing, 1, [] { return false; });
  const Fit fit = coarse.scored(fine.fit);
  const Fit initial = coarse.with_neutral(fit, "coulomb-friction");
  ASSERT_FALSE(stacked(coarse, moved(initial, size_of(initial, "coulomb-friction"), 0.1)).allFinite());
  const Fit neutral = at_neutral_size(coarse, fit, "coulomb-friction");
  const auto change = [&](double size) {
    const Eigen::VectorXd with = stacked(coarse, moved(neutral, size_of(neutral, "coulomb-friction"), size));
    return (with - stacked(coarse, fit)).norm() / std::sqrt(static_cast<double>(with.size()));
  };
  // Of the peak force: next to nothing at its neutral size, and not so at a tenth of its box. No NaN passes.
  EXPECT_LT(change(0.0), 2e-3);
  EXPECT_GT(change(0.1), 2e-2);
}

}  // namespace
}  // namespace hysteron
