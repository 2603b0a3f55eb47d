#include "diagnose/residual/locality.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "diagnose/search/of_fit.hpp"
#include "fit/synthetic.hpp"

namespace hysteron {
namespace {

TEST(Locality, CountsWhatAStopExplainsBeyondItsPlace) {
  const double place = 0.015;
  LayoutOptions made;
  made.fix = {{"c0", 1000.0}, {"end-stop.x_up", place}, {"end-stop.x_low", 1.0}, {"end-stop.p", 1.0}};
  const Layout layout(make_model("viscous", {"end-stop"}), DataScale{}, made);
  std::vector<Term> terms = layout.terms(layout.initial());
  for (Term& term : terms) {
    term.value = layout.names()[term.parameter] == "end-stop.k_b" ? 5e4 : term.value;
  }
  Recording recording = testing::motion("r.csv", {{0.02, 1.0}}, 4.0, 500, 0.0);
  testing::set_force(recording, layout, terms, {}, 0.0, Stream(1));

  const Workbench bench(DataScale{}, Split{{recording}, {}, "", false}, made, {}, 1, [] { return false; });
  Fit with;
  with.what = {"viscous", {"end-stop"}, {}};
  with.layout = std::make_shared<const Layout>(layout);
  with.terms = terms;
  LayoutOptions bare = made;
  std::erase_if(bare.fix, [](const auto& row) { return row.first.starts_with("end-stop"); });
  Fit without;
  without.what = {"viscous", {}, {}};
  without.layout = std::make_shared<const Layout>(make_model("viscous", {}), DataScale{}, bare);
  without.terms = without.layout->terms(without.layout->initial());

  const Locality part = locality_of(bench, with, without, "end-stop");
  // The stop changes the force by 2 % of its peak somewhat beyond its place.
  const double peak = normaliser(recording, bench.options().normalisation);
  double acted = 0.0;
  double squares = 0.0;
  for (const double x : recording.displacement) {
    const double force = 5e4 * std::max(x - place, 0.0) / peak;
    if (force > 0.02) {
      acted += 1.0;
      squares += force * force;
    }
  }
  EXPECT_NEAR(part.share, acted / static_cast<double>(recording.size()), 1e-9);
  EXPECT_GT(part.share, 0.1);
  EXPECT_NEAR(part.before, squares, 1e-6 * squares);
  EXPECT_LT(part.after, 1e-9 * squares);
}

}  // namespace
}  // namespace hysteron
