// What displacement and velocity tell of a lag between their channels, whatever the model.
#pragma once

#include <optional>
#include <span>

#include "core/recording.hpp"

namespace hysteron {

// Lag in s of the recorded velocity behind the slope of the recorded displacement, with its standard error; empty when
// no velocity was measured.
struct ChannelLag {
  double lag = 0.0;
  double std_error = 0.0;
};
std::optional<ChannelLag> velocity_channel_lag(std::span<const Recording> recordings);

}  // namespace hysteron
