#include "challenge/absorption.hpp"

#include <cmath>

#include "challenge/chain.hpp"

namespace hysteron::challenge {
namespace {

struct Nudge {
  double Physics::*parameter;
  double step;
};

// The parameters on which the force does not hang linearly.
std::vector<Nudge> nudges(const Physics& p) {
  const double spring = 0.01 * p.force_scale / p.length_scale;
  const double speed = std::max(p.c_a + p.c_b, 1e-9);
  switch (p.law) {
    case Law::bouc_wen:
      return {{&Physics::A, 0.03 * p.A},
              {&Physics::beta, 0.03 * p.beta},
              {&Physics::gamma, 0.03 * p.gamma},
              {&Physics::n, 0.03 * p.n}};
    case Law::modified_bouc_wen:
      // The dashpot c1 takes part of every force.
      return {{&Physics::alpha_a, 0.01 * p.force_scale},
              {&Physics::alpha_b, 0.01 * p.force_scale},
              {&Physics::c_a, 0.03 * speed},
              {&Physics::c_b, 0.03 * speed},
              {&Physics::k0, spring},
              {&Physics::c1, 0.03 * p.c1},
              {&Physics::A, 0.03 * p.A},
              {&Physics::beta, 0.03 * p.beta},
              {&Physics::gamma, 0.03 * p.gamma},
              {&Physics::n, 0.03 * p.n}};
    case Law::tanh_hysteresis:
      return {{&Physics::v_y, 0.03 * p.v_y}, {&Physics::v_h, 0.03 * p.v_h}};
    case Law::bingham:
      return {};
    case Law::lugre:
      return {{&Physics::x_b, 0.03 * p.x_b},
              {&Physics::ratio, 0.03},
              {&Physics::v_st, 0.03 * p.v_st},
              {&Physics::s1, 0.03 * speed}};
  }
  return {};
}

// The others of the plain laws: dF / d alpha_a = h is found by one simulation, the rest are h i, v, v i, x and 1.
std::vector<Forces> linear_derivatives(const Physics& physics, const std::vector<Run>& tests, double rate,
                                       int decimation) {
  const bool modified = physics.law == Law::modified_bouc_wen;
  std::vector<Forces> columns(modified ? 1 : 6);
  Physics changed = physics;
  const double step = 0.01 * physics.force_scale;
  changed.alpha_a += step;
  for (const Run& test : tests) {
    const Track plain = simulate(physics, test, rate);
    const auto add = [&](std::size_t column, const auto& value) {
      Track track = plain;
      for (std::size_t k = 0; k < track.force.size(); ++k) track.force[k] = value(k);
      columns[column].push_back(clean_force(physics, track, decimation));
    };
    add(0, [&](std::size_t k) { return plain.x[k]; });  // k0, or k1 of the modified law
    if (modified) continue;
    const Track more = simulate(changed, test, rate);
    const auto h = [&](std::size_t k) { return (more.force[k] - plain.force[k]) / step; };
    add(1, h);
    add(2, [&](std::size_t k) { return h(k) * plain.drive[k]; });
    add(3, [&](std::size_t k) { return plain.v[k]; });
    add(4, [&](std::size_t k) { return plain.v[k] * plain.drive[k]; });
    add(5, [](std::size_t) { return 1.0; });
  }
  // The step of Bingham's law holds without a spring.
  if (physics.law == Law::bingham) columns.erase(columns.begin());
  return columns;
}

// Takes the part of `column` along the orthonormal `basis` out of it.
void remove_parts(std::vector<double>& column, const std::vector<std::vector<double>>& basis) {
  for (int pass = 0; pass < 2; ++pass) {
    for (const std::vector<double>& direction : basis) {
      double along = 0.0;
      for (std::size_t k = 0; k < column.size(); ++k) along += column[k] * direction[k];
      for (std::size_t k = 0; k < column.size(); ++k) column[k] -= along * direction[k];
    }
  }
}

double norm(const std::vector<double>& column) {
  double sum = 0.0;
  for (const double value : column) sum += value * value;
  return std::sqrt(sum);
}

std::vector<double> stacked(const Forces& forces, const std::vector<double>& peaks, std::size_t first,
                            std::size_t last) {
  std::vector<double> column;
  for (std::size_t r = first; r < last; ++r) {
    for (const double value : forces[r]) column.push_back(value / peaks[r]);
  }
  return column;
}

}  // namespace

std::vector<Forces> law_derivatives(const Physics& physics, const std::vector<Run>& tests, double rate, int decimation,
                                    const Forces& at_truth) {
  std::vector<Forces> result = linear_derivatives(physics, tests, rate, decimation);
  for (const Nudge& nudge : nudges(physics)) {
    Physics changed = physics;
    changed.*nudge.parameter += nudge.step;
    Forces column;
    for (std::size_t r = 0; r < tests.size(); ++r) {
      std::vector<double> force = clean_force(changed, simulate(changed, tests[r], rate), decimation);
      for (std::size_t k = 0; k < force.size(); ++k) force[k] = (force[k] - at_truth[r][k]) / nudge.step;
      column.push_back(std::move(force));
    }
    result.push_back(std::move(column));
  }
  return result;
}

Forces left_over(const Forces& change, const std::vector<Forces>& derivatives, const std::vector<double>& peaks,
                 bool single) {
  Forces result = change;
  const std::size_t count = change.size();
  for (std::size_t first = 0; first < count; first = single ? first + 1 : count) {
    const std::size_t last = single ? first + 1 : count;
    std::vector<std::vector<double>> basis;
    for (const Forces& derivative : derivatives) {
      std::vector<double> column = stacked(derivative, peaks, first, last);
      const double before = norm(column);
      remove_parts(column, basis);
      const double after = norm(column);
      if (after < 1e-6 * before || after == 0.0) continue;
      for (double& value : column) value /= after;
      basis.push_back(std::move(column));
    }
    std::vector<double> left = stacked(change, peaks, first, last);
    remove_parts(left, basis);
    std::size_t at = 0;
    for (std::size_t r = first; r < last; ++r) {
      for (double& value : result[r]) value = left[at++] * peaks[r];
    }
  }
  return result;
}

}  // namespace hysteron::challenge
