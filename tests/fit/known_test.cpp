// What a fit says of how well its parameters are known, against closed forms of linear models.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fit/correlations.hpp"
#include "fit/sensitivity.hpp"
#include "synthetic.hpp"

namespace hysteron {
namespace {

constexpr std::size_t samples = 400;
constexpr double c0 = 3000.0;
constexpr double k0 = 12000.0;
constexpr double omega = 2.0 * std::numbers::pi;
constexpr double stroke = 0.02;

// x = stroke sin(omega t) in the middles of equal parts of so many periods, under a spring and a dashpot.
Recording sine(double periods) {
  Recording recording;
  recording.file = "sine.csv";
  recording.velocity_measured = true;
  for (std::size_t n = 0; n < samples; ++n) {
    const double t = periods * (static_cast<double>(n) + 0.5) / static_cast<double>(samples);
    recording.time.push_back(t);
    recording.displacement.push_back(stroke * std::sin(omega * t));
    recording.velocity.push_back(stroke * omega * std::cos(omega * t));
    recording.force.push_back(c0 * recording.velocity.back() + k0 * recording.displacement.back());
  }
  return recording;
}

struct Case {
  Case(std::vector<Recording> recordings, const std::vector<std::string>& effects, const LayoutOptions& options)
      : layout(make_model("viscous", effects), scale_of(recordings), options), objective(layout, recordings, {}) {}

  [[nodiscard]] std::vector<double> point(const std::map<std::string, double>& values) const {
    return testing::point_with(layout, layout.initial(), values);
  }
  [[nodiscard]] Correlations correlated(const std::vector<double>& u) const {
    return correlations(objective.evaluate({u, true}), u);
  }
  [[nodiscard]] std::map<std::string, double> sensitive(const std::vector<double>& u) const {
    std::map<std::string, double> result;
    double before = 1e300;
    for (const ScaledSensitivity& one :
         sensitivities(layout, objective.evaluate({u, true}), measured_square(objective.targets()), u)) {
      EXPECT_LE(one.value, before) << "the most influential first";
      before = one.value;
      result[layout.names()[one.parameter]] = one.value;
    }
    return result;
  }

  Layout layout;
  Objective objective;
};

LayoutOptions holding(const std::string& name) {
  LayoutOptions options;
  options.fix[name] = 0.0;
  return options;
}

// Over a quarter of a period the mean of sin cos is 1/pi and those of sin^2 and cos^2 are 1/2, so that
// (J^T J)^-1 has r = -(1/pi) / (1/2).
TEST(Correlations, OfASpringAndADashpotOverAQuarterPeriod) {
  const Case one({sine(0.25)}, {}, holding("f0"));
  const Correlations found = one.correlated(one.point({{"c0", c0}, {"k0", k0}}));
  ASSERT_EQ(found.coordinates.size(), 2U);
  ASSERT_EQ(found.pairs().size(), 1U);
  EXPECT_NEAR(found.pairs()[0].r, -2.0 / std::numbers::pi, 1e-5);
  EXPECT_EQ(found.values(0, 1), found.values(1, 0));
  EXPECT_EQ(found.values(0, 0), 1.0);
}

TEST(Correlations, WholePeriodsSeparateSpringAndDashpot) {
  const Case one({sine(2.0)}, {}, {});
  const Correlations found = one.correlated(one.point({{"c0", c0}, {"k0", k0}}));
  ASSERT_EQ(found.coordinates.size(), 3U);
  for (const Correlations::Pair& pair : found.pairs()) EXPECT_LT(std::fabs(pair.r), 1e-9);
}

TEST(Correlations, TwoDashpotsAreKnownTogetherOnly) {
  const Case one({sine(2.0)}, {"viscous-damping"}, holding("f0"));
  const Correlations found = one.correlated(one.point({{"c0", 0.6 * c0}, {"viscous-damping.c", 0.4 * c0}, {"k0", k0}}));
  ASSERT_EQ(found.coordinates.size(), 3U);
  const Correlations::Pair first = found.pairs().front();
  EXPECT_EQ(one.layout.names()[one.layout.coordinates()[found.coordinates[first.first]].parameter], "c0");
  EXPECT_EQ(one.layout.names()[one.layout.coordinates()[found.coordinates[first.second]].parameter],
            "viscous-damping.c");
  EXPECT_LE(first.r, -inseparable);
  EXPECT_LT(std::fabs(found.pairs()[1].r), inseparable);
}

TEST(Correlations, NothingIsSaidOfAParameterOnItsBound) {
  const Case one({sine(2.0)}, {}, holding("f0"));
  std::vector<double> u = one.point({{"c0", c0}});
  u[1] = 0.0;
  EXPECT_EQ(one.correlated(u).coordinates, (std::vector<std::size_t>{0}));
  EXPECT_TRUE(one.correlated(u).pairs().empty());
}

// c v + k x over whole periods: the two parts are orthogonal, of rms c omega A / sqrt 2 and k A / sqrt 2.
TEST(Sensitivity, OfASpringAndADashpotIsTheirPartOfTheForce) {
  const Case one({sine(2.0)}, {}, {});
  const std::map<std::string, double> found = one.sensitive(one.point({{"c0", c0}, {"k0", k0}, {"f0", 0.0}}));
  const double whole = std::hypot(c0 * omega, k0);
  EXPECT_NEAR(found.at("c0"), c0 * omega / whole, 1e-9);
  EXPECT_NEAR(found.at("k0"), k0 / whole, 1e-9);
  EXPECT_NEAR(found.at("f0"), 0.0, 1e-9);
}

// A force that is a parameter times what is recorded changes by as much as the parameter, a law of it included,
// whatever the scales and lengths of the recordings.
TEST(Sensitivity, OfTheOnlyParameterIsOneWithALawToo) {
  LayoutOptions options = holding("f0");
  options.fix["k0"] = 0.0;
  options.by_current["c0"] = 1;
  std::vector<Recording> recordings{sine(2.0), sine(0.7)};
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    const double level = 0.5 + static_cast<double>(r);
    testing::set_drive(recordings[r], level);
    for (std::size_t n = 0; n < samples; ++n) {
      recordings[r].force[n] = (500.0 + 2000.0 * level) * recordings[r].velocity[n];
    }
  }
  const Case one(recordings, {}, options);
  ASSERT_EQ(one.layout.dimension(), 2U);
  const std::vector<double> u{one.layout.unit(0, 1500.0), one.layout.unit(1, 3500.0)};
  ASSERT_LT(one.objective.evaluate({u, false}).cost[0], 1e-12);
  const std::map<std::string, double> found = one.sensitive(u);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found.at("c0"), 1.0, 1e-9);
}

}  // namespace
}  // namespace hysteron
