// Laws in conditions beside drive and frequency: two drives at once, and one that moves along a recording.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "fit/identify.hpp"
#include "fit/synthetic.hpp"

namespace hysteron {
namespace {

constexpr double low = 1e5;  // Pa
constexpr double high = 3e5;

// c0 of the Kelvin-Voigt element at a current and a pressure: affine in both, with their product.
double damping_at(double current, double pressure) {
  return 500.0 + 300.0 * current + 1e-3 * pressure + 4e-4 * current * pressure;
}

Recording pressed(const std::string& file, double current, std::vector<double> pressure) {
  Recording recording = testing::motion(file, {{0.02, 1.3}}, 2.0, 300, 0.0);
  testing::set_drive(recording, current);
  for (std::size_t n = 0; n < recording.size(); ++n) {
    const double p = pressure.size() > 1 ? pressure[n] : pressure[0];
    recording.force.push_back(damping_at(current, p) * recording.velocity[n] + 2000.0 * recording.displacement[n]);
  }
  recording.conditions = {{"pressure", "Pa", std::move(pressure)}};
  return recording;
}

// The last one has a pressure that moves along it.
std::vector<Recording> campaign() {
  std::vector<double> ramp;
  for (int n = 0; n < 300; ++n) ramp.push_back(low + (high - low) * n / 299.0);
  return {pressed("a", 0.0, {low}), pressed("b", 1.0, {low}), pressed("c", 0.0, {high}), pressed("d", 1.0, {high}),
          pressed("e", 0.5, std::move(ramp))};
}

LayoutOptions both() {
  LayoutOptions options;
  options.by_current = {{"c0", 1}};
  options.by = {{"pressure", {{"c0", 1}}}};
  return options;
}

TEST(Conditions, ALawIsTheProductOfItsPolynomials) {
  const std::vector<Recording> recordings = campaign();
  LayoutOptions options = both();
  options.by["pressure"]["c0"] = 2;
  const Layout layout(make_model("viscous", {}), scale_of(recordings), options);
  EXPECT_EQ(layout.dimension(), 2U * 3U + 2U);
  std::vector<double> u(layout.dimension());
  for (std::size_t c = 0; c < u.size(); ++c) u[c] = 0.1 + 0.1 * static_cast<double>(c);
  const std::vector<Term> terms = layout.terms(u);
  for (const ParameterLaw& law : layout.laws()) {
    for (std::size_t k = 0; k < law.count(); ++k) {
      const ParameterLaw::Node node = law.node(k);
      const double value = layout.physical(law.first + k, u[law.first + k]);
      const double found =
          parameters_at(layout.held(), terms, node.drive, node.frequency, node.conditions)[law.parameter];
      EXPECT_NEAR(found, value, 1e-9 * std::fabs(value) + 1e-9) << layout.names()[law.parameter] << " " << k;
    }
    const std::vector<double> weights = Layout::weights(law, 0.3, 1.0, std::vector<double>{1.7e5});
    double sum = 0.0;
    double value = 0.0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      sum += weights[k];
      value += weights[k] * layout.physical(law.first + k, u[law.first + k]);
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
    const double found = parameters_at(layout.held(), terms, 0.3, 1.0, std::vector<double>{1.7e5})[law.parameter];
    EXPECT_NEAR(found, value, 1e-9 * std::fabs(value) + 1e-9);
  }
}

TEST(Conditions, TermsAreNamedAfterWhatTheyFollow) {
  const std::vector<ConditionRange> conditions = {{"pressure", "Pa", low, high}, {"valve", "", 0.0, 1.0}};
  const Term term{0, 1, 0, 1.0, {2, 1}};
  EXPECT_EQ(term_name("c0", term, conditions), "c0*i*pressure^2*valve");
  EXPECT_EQ(term_unit("N s/m", term, conditions, DriveKind::current), "N s/m/Pa/Pa/A");
  EXPECT_FALSE(term.constant());
}

// A force affine in current and pressure is recovered to the last digits that the search leaves.
TEST(Conditions, TwoDrivesAtOnceAreRecovered) {
  Campaign all;
  all.recordings = campaign();
  all.roles.assign(all.recordings.size(), Role::fit);
  IdentifyOptions options;
  options.budget = 4000;
  options.layout = both();
  const Identification result = identify(all, "viscous", options, {});
  EXPECT_LT(result.cost, 1e-6);
  for (const double current : {0.0, 0.4, 1.0}) {
    for (const double pressure : {low, 1.7e5, high}) {
      const auto p = parameters_at(result.layout.held(), result.terms, current, 0.0, std::vector<double>{pressure});
      EXPECT_NEAR(p[0] / damping_at(current, pressure), 1.0, 1e-5);
    }
  }
}

// Derivatives where the condition moves and where it does not are those of differences.
TEST(Conditions, DerivativesAreThoseOfDifferences) {
  const std::vector<Recording> recordings = campaign();
  const Layout layout(make_model("viscous", {}), scale_of(recordings), both());
  for (const std::size_t r : {1U, 4U}) {
    const Objective objective(layout, std::vector<Recording>{recordings[r]}, {});
    const std::vector<double> u(layout.dimension(), 0.4);
    const Response at = objective.evaluate({u, true});
    for (std::size_t c = 0; c < u.size(); ++c) {
      const auto squared_cost = [&](double by) {
        std::vector<double> moved = u;
        moved[c] += by;
        const double cost = objective.evaluate({moved, false}).cost[0];
        return 0.5 * cost * cost;
      };
      const double difference = (squared_cost(1e-4) - squared_cost(-1e-4)) / 2e-4;
      EXPECT_NEAR(at.gradient[c], difference, 1e-6 * at.cost[0] * at.cost[0] + 1e-9) << r << " " << c;
    }
  }
}

TEST(Conditions, LawsThatTheDataCannotTellAreRefused) {
  std::vector<Recording> recordings = campaign();
  const auto made = [&](const LayoutOptions& options) {
    return Layout(make_model("viscous", {}), scale_of(recordings), options);
  };
  LayoutOptions options = both();
  options.by = {{"valve", {{"c0", 1}}}};
  EXPECT_THROW(made(options), InputError);
  options.by = {{"pressure", {{"c9", 1}}}};
  EXPECT_THROW(made(options), InputError);
  recordings = {recordings[0], recordings[1]};
  EXPECT_THROW(made(both()), InputError);  // one pressure
  recordings[1].conditions.clear();
  EXPECT_THROW(scale_of(recordings), InputError);
}

}  // namespace
}  // namespace hysteron
