// Whether the range searched is what a base model lacks is told, and only then.
#include "diagnose/base_bounds.hpp"

#include <gtest/gtest.h>

#include "fit/synthetic.hpp"

namespace hysteron {
namespace {

// Of a dashpot of 2000 N s/m, searched up to `most`.
std::string note_with(double most) {
  LayoutOptions made;
  made.fix = {{"c0", 2000.0}};
  const Layout layout(make_model("viscous", {}), DataScale{}, made);
  std::vector<Recording> recordings;
  for (const double frequency : {1.0, 2.5}) {
    Recording recording = testing::motion("r.csv", {{0.01, frequency}}, 2.0, 200, 0.1);
    testing::set_force(recording, layout, layout.terms(layout.initial()), {}, 0.01, Stream(3).child("noise"));
    recordings.push_back(recording);
  }
  LayoutOptions searched;
  searched.bounds = {{"c0", {0.0, most}}};
  const Workbench bench(scale_of(recordings), Split{recordings, {}, {}, false}, searched, {}, 1, [] { return false; });
  return note_of_bounds(bench, bench.from_anywhere({"viscous", {}, {}}, 2000));
}

TEST(BaseBounds, OfARangeThatLeavesTheDamperOutAreTold) {
  const std::string note = note_with(1500.0);
  EXPECT_TRUE(note.starts_with(
      "in the fit of viscous alone c0 (1.5e+03 N s/m) is at the end of its search range, beyond which the "
      "NRMSE would fall by about"))
      << note;
  EXPECT_EQ(note_with(5000.0), "");
}

}  // namespace
}  // namespace hysteron
