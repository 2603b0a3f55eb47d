#include "diagnose/residual/misfit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/search/of_fit.hpp"
#include "diagnose/signal/noise.hpp"
#include "fit/synthetic.hpp"

namespace hysteron {
namespace {

// What a viscous damper whose force fades leaves of such a force, of noise, and of a friction that it lacks.
Misfit left_of(double fading, double friction) {
  Recording recording = testing::motion("r.csv", {{0.01, 2.0}}, 6.0, 3000, 0.2);
  recording.velocity_measured = true;
  const Stream stream = Stream(17);
  double travelled = 0.0;
  for (std::size_t n = 0; n < recording.size(); ++n) {
    const double v = recording.velocity[n];
    travelled += n == 0 ? 0.0 : std::fabs(v) * (recording.time[n] - recording.time[n - 1]);
    recording.force.push_back(2000.0 * v * (1.0 + fading * std::exp(-travelled / 0.1)) +
                              friction * std::tanh(v / 0.005) + 3.0 * stream.normal(n));
  }
  EXPECT_EQ(noise_floor(recording).method, NoiseMethod::cycles);
  const Workbench bench(scale_of({recording}), {{recording}, {{recording, 0}}, "", false}, {}, {}, 1,
                        [] { return false; });
  return misfit_of(bench, bench.from_anywhere({"viscous", {"stiction"}, {}}, 2000));
}

TEST(Misfit, WhatFadesOverTheCyclesHidesNothingThatRepeats) {
  const Misfit whole = left_of(0.5, 0.0);
  EXPECT_FALSE(structured(whole));
  EXPECT_LT(whole.predictable, 0.01);
  const Misfit lacking = left_of(0.5, 10.0);
  // What fades is no noise: of white noise the cycles tell what its fourth differences do.
  EXPECT_NEAR(lacking.floor, lacking.white, 0.1 * lacking.white);
  EXPECT_LT(lacking.floor, 0.5 * lacking.squares);
  EXPECT_TRUE(structured(lacking));
}

}  // namespace
}  // namespace hysteron
