// The force of a damper that is held: no noise of the displacement takes it away.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "fit/synthetic.hpp"
#include "io/channels.hpp"

namespace hysteron {
namespace {

TEST(Held, NoiseOfTheDisplacementTakesNoForceAway) {
  constexpr double rate = 1000.0;
  constexpr double noise = 3e-6;
  const double w = 2.0 * std::numbers::pi;
  // Half a period from rest to rest, then held for two seconds with the hysteresis full.
  const auto place = [&](double t) { return t < 0.5 ? 0.005 * (1.0 - std::cos(w * t)) : 0.01; };
  const auto recorded = [&](double sigma) {
    Channels channels;
    const Stream stream(5);
    for (int n = 0; n < 2500; ++n) {
      const double t = n / rate;
      channels[static_cast<std::size_t>(Quantity::time)].push_back(t);
      channels[static_cast<std::size_t>(Quantity::displacement)].push_back(
          place(t) + sigma * stream.normal(static_cast<std::uint64_t>(n)));
    }
    return make_recording(std::move(channels));
  };
  LayoutOptions made;
  made.fix = {{"alpha", 1000.0}, {"c0", 1000.0}, {"k0", 0.0}, {"f0", 0.0}, {"x_y", 5e-4}, {"share", 0.5}, {"n", 1.0}};
  const Layout layout(make_model("bouc-wen", {}), DataScale{}, made);
  const auto force_at_end = [&](double sigma) {
    Recording recording = recorded(sigma);
    testing::set_force(recording, layout, layout.terms(layout.initial()), {});
    return recording.force.back();
  };
  const double held = force_at_end(0.0);
  EXPECT_GT(held, 900.0);
  EXPECT_NEAR(force_at_end(noise), held, 0.005 * held);
}

}  // namespace
}  // namespace hysteron
