// What keeps a fit of long recordings small gives the bits of the short way.
#include <gtest/gtest.h>

#include "fit/jackknife.hpp"
#include "fit/synthetic.hpp"

namespace hysteron {
namespace {

using testing::motion;
using testing::random_points;
using testing::set_drive;
using testing::set_force;

std::vector<Recording> recordings(const Layout& layout) {
  std::vector<Recording> result = {motion("a.csv", {{0.01, 1.3}}, 2.0, 700, 0.3),
                                   motion("b.csv", {{0.02, 0.7}}, 3.0, 450, 0.0)};
  set_drive(result[0], 0.4);
  set_drive(result[1], 0.9);
  for (std::size_t n = 200; n < result[1].size(); ++n) result[1].drive[n] = 0.3;
  for (Recording& recording : result) {
    set_force(recording, layout, layout.terms(std::vector<double>(layout.dimension(), 0.4)), {}, 0.02);
  }
  return result;
}

Layout layout_of(const std::vector<std::string>& effects) {
  LayoutOptions options;
  options.by_current["c0"] = 1;
  DataScale scale{800.0, 0.02, 0.1};
  scale.drive_low = 0.3;
  scale.drive_high = 0.9;
  return Layout(make_model("bouc-wen", effects), scale, options);
}

TEST(Memory, LeanMotionsGiveTheSameBits) {
  for (const std::vector<std::string>& effects :
       {std::vector<std::string>{}, {"coil-lag"}, {"compliance"}, {"sensor-delay", "clearance"}}) {
    const Layout layout = layout_of(effects);
    const std::vector<Recording> data = recordings(layout);
    ObjectiveOptions lean_options;
    lean_options.most_prepared_samples = 0;
    const Objective prepared(layout, data, {});
    const Objective lean(layout, data, lean_options);
    ASSERT_TRUE(prepared.targets()[0].motion.intervals.size() > 0);
    ASSERT_TRUE(lean.targets()[0].motion.intervals.empty());
    const std::vector<double> points = random_points(Stream(5), 11, layout.dimension(), 0.3);
    EXPECT_EQ(prepared.evaluate({points, false}).cost, lean.evaluate({points, false}).cost);
    const Response a = prepared.evaluate({points, true});
    const Response b = lean.evaluate({points, true});
    EXPECT_EQ(a.cost, b.cost);
    EXPECT_EQ(a.gradient, b.gradient);
    EXPECT_EQ(a.gauss_newton, b.gauss_newton);
    const std::vector<double> point(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(layout.dimension()));
    const auto one = prepared.linearised(point);
    const auto other = lean.linearised(point);
    for (std::size_t r = 0; r < data.size(); ++r) {
      EXPECT_EQ(one[r].residual, other[r].residual);
      EXPECT_EQ(one[r].jacobian, other[r].jacobian);
    }
    const auto terms = layout.terms(point);
    EXPECT_EQ(predict(layout.model(), layout.held(), terms, make_target(data[1], {})),
              predict(layout.model(), layout.held(), terms, make_target(data[1], lean_options)));
  }
}

TEST(Memory, JackknifeNeedsNotAllDerivativesAtOnce) {
  const Layout layout = layout_of({});
  const Objective objective(layout, recordings(layout), {});
  const std::vector<double> point(layout.dimension(), 0.45);
  std::vector<Eigen::Index> free;
  for (std::size_t c = 0; c < layout.dimension(); ++c) free.push_back(static_cast<Eigen::Index>(c));
  const auto whole = jackknife(objective.linearised(point), free, layout.dimension());
  const auto streamed = jackknife(objective, point, free);
  ASSERT_TRUE(whole && streamed);
  EXPECT_EQ(whole->stretches.covariance, streamed->stretches.covariance);
}

}  // namespace
}  // namespace hysteron
