// Explicit Runge-Kutta pair of order 5(4) with step control.
// Source: Dormand, Prince, J. Comput. Appl. Math. 6 (1980) 19-26, doi 10.1016/0771-050X(80)90013-3.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <utility>

namespace hysteron::challenge {

// Advances y from t to end by y' = rate(t, y). `step` is the trial step, kept between calls; `scale` the size of each
// state at which an error of `tolerance` is allowed. Steps never fall below 1e-9 of a second, so that a jump of the
// right-hand side is crossed in bounded work. Returns the steps it took.
// State: an array of numbers with size().
template <class State, class Rate>
std::size_t advance(State& y, double t, double end, double& step, double tolerance, const State& scale, Rate&& rate) {
  constexpr double smallest = 1e-9;
  const std::size_t size = y.size();
  const auto combine = [size](const State& from, double h,
                              std::initializer_list<std::pair<double, const State*>> terms) {
    State result = from;
    for (const auto& [weight, k] : terms) {
      for (std::size_t n = 0; n < size; ++n) result[n] += h * weight * (*k)[n];
    }
    return result;
  };
  State k1 = rate(t, y);
  std::size_t steps = 0;
  while (t < end) {
    ++steps;
    const bool last = t + step >= end * (1.0 - 1e-15);
    const double h = last ? end - t : step;
    const State k2 = rate(t + h / 5.0, combine(y, h, {{1.0 / 5.0, &k1}}));
    const State k3 = rate(t + 3.0 * h / 10.0, combine(y, h, {{3.0 / 40.0, &k1}, {9.0 / 40.0, &k2}}));
    const State k4 =
        rate(t + 4.0 * h / 5.0, combine(y, h, {{44.0 / 45.0, &k1}, {-56.0 / 15.0, &k2}, {32.0 / 9.0, &k3}}));
    const State k5 = rate(
        t + 8.0 * h / 9.0,
        combine(y, h,
                {{19372.0 / 6561.0, &k1}, {-25360.0 / 2187.0, &k2}, {64448.0 / 6561.0, &k3}, {-212.0 / 729.0, &k4}}));
    const State k6 = rate(t + h, combine(y, h,
                                         {{9017.0 / 3168.0, &k1},
                                          {-355.0 / 33.0, &k2},
                                          {46732.0 / 5247.0, &k3},
                                          {49.0 / 176.0, &k4},
                                          {-5103.0 / 18656.0, &k5}}));
    const State next = combine(y, h,
                               {{35.0 / 384.0, &k1},
                                {500.0 / 1113.0, &k3},
                                {125.0 / 192.0, &k4},
                                {-2187.0 / 6784.0, &k5},
                                {11.0 / 84.0, &k6}});
    const State k7 = rate(t + h, next);
    double error = 0.0;
    for (std::size_t n = 0; n < size; ++n) {
      const double e = h * (71.0 / 57600.0 * k1[n] - 71.0 / 16695.0 * k3[n] + 71.0 / 1920.0 * k4[n] -
                            17253.0 / 339200.0 * k5[n] + 22.0 / 525.0 * k6[n] - 1.0 / 40.0 * k7[n]);
      error = std::max(error, std::abs(e) / scale[n]);
    }
    const double ratio = error / tolerance;
    const bool accepted = ratio <= 1.0 || h <= smallest;
    if (accepted) {
      t = last ? end : t + h;
      y = next;
      k1 = k7;
    }
    const double factor = ratio > 0.0 ? std::clamp(0.9 * std::pow(ratio, -0.2), 0.2, 5.0) : 5.0;
    // A step cut short by the end says nothing about how long the next may be.
    if (!last || !accepted || factor < 1.0) step = std::max(h * factor, smallest);
  }
  return steps;
}

}  // namespace hysteron::challenge
