// How far the descents of a workbench get.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "diagnose/search/workbench.hpp"
#include "fit/synthetic.hpp"

namespace hysteron {
namespace {

constexpr double noise = 0.01;

// Sines of a damper that bears a third of its force within 1.5 mm of a place of its stroke.
std::vector<Recording> of_a_narrow_groove() {
  LayoutOptions made;
  made.fix = {{"c0", 500.0},           {"k0", 5000.0},         {"f0", 0.0},
              {"alpha", 200.0},        {"x_y", 2e-4},          {"pinching.p", 0.7},
              {"pinching.x_p", -1e-3}, {"pinching.w", 1.5e-3}, {"pinching.q", 2.5}};
  const Layout layout(make_model("bouc-wen", {"pinching"}), DataScale{}, made);
  std::vector<Recording> result;
  for (const testing::Tone tone : {testing::Tone{0.004, 1.0}, testing::Tone{0.008, 2.0}, testing::Tone{0.006, 4.0}}) {
    Recording recording = testing::motion("r" + std::to_string(result.size()) + ".csv", {tone}, 3.0, 600, 0.0);
    testing::set_force(recording, layout, layout.terms(layout.initial()), {}, noise, Stream(7).child(result.size()));
    result.push_back(recording);
  }
  return result;
}

// From a seventh of the size and 2 mm beside its place the first steps lead too far: they are taken back, until they
// are short enough.
TEST(Descents, GoOnAfterStepsThatAreTakenBack) {
  const std::vector<Recording> recordings = of_a_narrow_groove();
  const Workbench bench(scale_of(recordings), Split{recordings, {}, {}, false}, {}, {}, 1, [] { return false; });
  const Hypothesis what{"bouc-wen", {"pinching"}, {}};
  const Starts starts = bench.starts(what, bench.from_anywhere({"bouc-wen", {}, {}}, 4000));
  const std::vector<double> start = testing::point_with(
      *starts.layout, starts.neutral, {{"pinching.p", 0.1}, {"pinching.x_p", 1e-3}, {"pinching.w", 1.3e-3}});
  const Fit fit = bench.from_starts(what, {starts.layout, {start}, starts.neutral, {}}, 12, 1);
  EXPECT_LT(fit.cost, 1.2 * noise);
}

}  // namespace
}  // namespace hysteron
