// A workbench that keeps its pieces gives the same numbers, and the next one does none of the work again.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>

#include "diagnose/search/left_out.hpp"
#include "diagnose/search/of_fit.hpp"
#include "diagnose/search/workbench.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

std::vector<Recording> recordings() {
  std::vector<Recording> result;
  for (const double frequency : {1.0, 2.0}) {
    Recording recording;
    recording.file = std::to_string(frequency);
    const double omega = 2.0 * std::numbers::pi * frequency;
    for (int n = 0; n < 120; ++n) {
      const double t = 2.0 / frequency * n / 119.0;
      recording.time.push_back(t);
      recording.displacement.push_back(0.02 * std::sin(omega * t));
      recording.velocity.push_back(0.02 * omega * std::cos(omega * t));
      recording.force.push_back(900.0 * recording.velocity.back() + 3000.0 * recording.displacement.back() +
                                80.0 * std::tanh(40.0 * recording.velocity.back()));
    }
    recording.velocity_measured = true;
    result.push_back(std::move(recording));
  }
  return result;
}

class Pieces : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "hysteron-pieces-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }

  static Workbench bench(std::function<bool()> stopped = [] { return false; }) {
    const std::vector<Recording> all = recordings();
    ObjectiveOptions options;
    options.stopped = stopped;
    return {scale_of(all), Split{all, {{all.front(), 0}}, {}, false}, {}, options, 1, std::move(stopped)};
  }

  // Everything that is kept, of one search.
  struct All {
    std::vector<Fit> fits;
    LeftOut left;
    Misfit misfit;
  };
  static All work(const Workbench& on) {
    const Hypothesis law{"viscous", {}, {}};
    All result;
    result.fits.push_back(on.from_anywhere(law, 300));
    result.fits.push_back(on.from_fit(Hypothesis{"viscous", {"coulomb-friction"}, {}}, result.fits[0], 4));
    result.fits.push_back(on.polished(result.fits[1], 3));
    result.fits.push_back(on.on_all(result.fits[2], recordings(), 2));
    result.fits.push_back(on.scored(result.fits[1]));
    result.left = left_out(on, result.fits[2]);
    result.misfit = misfit_of(on, result.fits[2]);
    return result;
  }
  static void expect_same(const All& a, const All& b) {
    ASSERT_EQ(a.fits.size(), b.fits.size());
    for (std::size_t k = 0; k < a.fits.size(); ++k) {
      EXPECT_EQ(a.fits[k].what, b.fits[k].what) << k;
      EXPECT_EQ(a.fits[k].point, b.fits[k].point) << k;
      EXPECT_EQ(a.fits[k].cost, b.fits[k].cost) << k;
      EXPECT_EQ(a.fits[k].heldout, b.fits[k].heldout) << k;
      ASSERT_EQ(a.fits[k].terms.size(), b.fits[k].terms.size()) << k;
      for (std::size_t t = 0; t < a.fits[k].terms.size(); ++t) {
        EXPECT_EQ(a.fits[k].terms[t].value, b.fits[k].terms[t].value) << k;
      }
    }
    EXPECT_EQ(a.left.predicted, b.left.predicted);
    EXPECT_EQ(a.left.squares, b.left.squares);
    EXPECT_EQ(a.misfit.squares, b.misfit.squares);
    EXPECT_EQ(a.misfit.evenness.by_chance, b.misfit.evenness.by_chance);
    EXPECT_EQ(a.misfit.independent, b.misfit.independent);
  }

  fs::path folder_;
};

TEST_F(Pieces, AreTakenBitByBitAndNotWorkedOutAgain) {
  const All plain = work(bench());
  const fs::path path = folder_ / "partial";
  std::size_t kept = 0;
  {
    Checkpoint checkpoint(path, "command");
    Workbench keeping = bench();
    keeping.keep_in(checkpoint);
    expect_same(work(keeping), plain);
    kept = checkpoint.pieces();
  }
  EXPECT_EQ(kept, 8U);
  Checkpoint checkpoint(path, "command");
  Workbench again = bench();
  again.keep_in(checkpoint);
  expect_same(work(again), plain);
  EXPECT_EQ(checkpoint.pieces(), kept) << "something was worked out again under another name";
  ByteWriter key;
  key.text("never asked for");
  EXPECT_EQ(again.piece(key, [] { return std::string("new"); }), "new");
  EXPECT_EQ(again.piece(key, []() -> std::string { throw std::logic_error("worked out again"); }), "new");
}

TEST_F(Pieces, OfAnotherWorkbenchAreNotTaken) {
  Checkpoint checkpoint(folder_ / "partial", "command");
  Workbench one = bench();
  one.keep_in(checkpoint);
  ByteWriter key;
  key.text("what both ask for");
  EXPECT_EQ(one.piece(key, [] { return std::string("one"); }), "one");
  std::vector<Recording> others = recordings();
  others.front().force.front() += 1e-9;
  Workbench other(scale_of(others), Split{others, {}, {}, false}, {}, {}, 1, [] { return false; });
  other.keep_in(checkpoint);
  EXPECT_EQ(other.piece(key, [] { return std::string("other"); }), "other");
  ObjectiveOptions finer;
  finer.tolerance = 1e-6;
  Workbench third(scale_of(others), Split{others, {}, {}, false}, {}, finer, 1, [] { return false; });
  third.keep_in(checkpoint);
  EXPECT_EQ(third.piece(key, [] { return std::string("third"); }), "third");
}

TEST_F(Pieces, ThatWereStoppedAreNotKept) {
  Checkpoint checkpoint(folder_ / "partial", "command");
  bool stopped = false;
  Workbench stopping = bench([&] { return stopped; });
  stopping.keep_in(checkpoint);
  const Fit base = stopping.from_anywhere({"viscous", {}, {}}, 300);
  EXPECT_EQ(checkpoint.pieces(), 1U);
  stopped = true;
  EXPECT_EQ(stopping.polished(base, 3).cost, diverged_cost) << "the descent was to be cut off";
  EXPECT_EQ(checkpoint.pieces(), 1U);
}

}  // namespace
}  // namespace hysteron
