// Particle swarm: the constriction coefficient and the deterministic trajectory.
#include <gtest/gtest.h>

#include <cmath>

#include "algorithms/support/constriction.hpp"
#include "algorithms/support/topology.hpp"
#include "core/random.hpp"

namespace hysteron {
namespace {

using support::constricted_move;
using support::constriction_coefficient;
using support::ParticleState;

TEST(Constriction, CoefficientOfThePaper) {
  EXPECT_NEAR(constriction_coefficient(4.1, 1.0), 0.7298437881, 1e-9);
  EXPECT_NEAR(constriction_coefficient(4.1, 0.5), 0.5 * 0.7298437881, 1e-9);
  EXPECT_DOUBLE_EQ(constriction_coefficient(4.0, 1.0), 1.0);
  // chi is the smaller root of chi^2 - chi (phi - 2) + 1 = 0
  for (const double phi : {4.05, 4.1, 4.5, 6.0, 10.0}) {
    const double chi = constriction_coefficient(phi, 1.0);
    EXPECT_NEAR(chi * chi - chi * (phi - 2.0) + 1.0, 0.0, 1e-12) << phi;
    EXPECT_LE(chi, 1.0);
  }
}

// With fixed factors and one attractor, y = x - p obeys y'' = (1 + chi - chi phi) y' - chi y: a damped oscillation of
// radius sqrt(chi)^t.
TEST(Constriction, DeterministicTrajectoryIsTheClosedForm) {
  const double phi = 4.1;
  const double chi = constriction_coefficient(phi, 1.0);
  const double attractor = 0.37;
  ParticleState state{0.9, -0.15};
  const double radius = std::sqrt(chi);
  const double cosine = (1.0 + chi - chi * phi) / (2.0 * radius);
  ASSERT_LT(std::fabs(cosine), 1.0);
  const double angle = std::acos(cosine);
  const double first = state.position - attractor;
  const double second = first + chi * (state.velocity - phi * first);
  const double sine_part = (second / radius - first * cosine) / std::sin(angle);
  for (int t = 1; t <= 60; ++t) {
    state = constricted_move(state, attractor, attractor, 0.5 * phi, 0.5 * phi, chi, 100.0);
    const double expected = std::pow(radius, t) * (first * std::cos(angle * t) + sine_part * std::sin(angle * t));
    EXPECT_NEAR(state.position - attractor, expected, 1e-12) << "step " << t;
  }
  EXPECT_NEAR(state.position, attractor, 1e-3);
}

TEST(Constriction, EqualsTheInertiaForm) {
  const double chi = constriction_coefficient(4.1, 1.0);
  const ParticleState moved = constricted_move({0.2, 0.05}, 0.6, 0.9, 2.05 * 0.3, 2.05 * 0.8, chi, 100.0);
  const double velocity = 0.72984 * 0.05 + 1.49618 * 0.3 * (0.6 - 0.2) + 1.49618 * 0.8 * (0.9 - 0.2);
  EXPECT_NEAR(moved.velocity, velocity, 1e-5);
  EXPECT_NEAR(moved.position, 0.2 + velocity, 1e-5);
}

TEST(Constriction, VelocityIsLimited) {
  EXPECT_DOUBLE_EQ(constricted_move({0.0, 50.0}, 0.0, 0.0, 1.0, 1.0, 0.7, 1.0).velocity, 1.0);
  EXPECT_DOUBLE_EQ(constricted_move({0.0, -50.0}, 0.0, 0.0, 1.0, 1.0, 0.7, 1.0).velocity, -1.0);
}

TEST(Topology, NeighbourhoodsAreWhatTheyAreCalled) {
  const support::Neighbourhood ring = support::ring_neighbourhood(5);
  EXPECT_EQ(ring[0], (std::vector<std::size_t>{0, 4, 1}));
  const support::Neighbourhood torus = support::von_neumann_neighbourhood(12);  // 3 rows of 4
  EXPECT_EQ(torus[5], (std::vector<std::size_t>{5, 4, 6, 1, 9}));
  EXPECT_EQ(torus[0], (std::vector<std::size_t>{0, 3, 1, 8, 4}));
  // every particle informs itself and three draws
  std::size_t links = 0;
  const support::Neighbourhood drawn = support::random_neighbourhood(40, 3, Stream(7), 3);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    links += drawn[i].size();
    EXPECT_EQ(drawn[i].front(), i);
  }
  EXPECT_EQ(links, 160U);
}

}  // namespace
}  // namespace hysteron
