#include "diagnose/search/observe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/drive.hpp"
#include "diagnose/search/relatives.hpp"
#include "diagnose/search/wording.hpp"
#include "io/channel_lag.hpp"

namespace hysteron {
std::optional<std::string> unmet(Need need, const std::vector<Recording>& recordings) {
  switch (need) {
    case Need::drive:
      if (std::ranges::all_of(recordings, [](const Recording& r) { return r.drive.empty(); })) {
        return "no current or voltage was recorded";
      }
      break;
    case Need::changing_drive:
      if (std::ranges::none_of(recordings, drive_varies)) {
        return worded("the current is constant in every recording", drive_kind_of(recordings));
      }
      break;
    case Need::returning_drive:
      if (std::ranges::none_of(recordings, [](const Recording& r) { return returns(r.drive); })) {
        return worded("the current does not both rise and fall in any recording", drive_kind_of(recordings));
      }
      break;
    case Need::three_drive_levels:
      if (drive_levels(recordings) < 3) {
        return worded("fewer than three current levels: it looks like another slope of the force with current",
                      drive_kind_of(recordings));
      }
      break;
    case Need::velocity:
      if (std::ranges::none_of(recordings, &Recording::velocity_measured)) {
        return "the velocity was not recorded";
      }
      break;
    case Need::lagging_velocity: {
      const std::optional<ChannelLag> lag = velocity_channel_lag(recordings);
      if (!lag) {
        return "the velocity was not recorded but derived from the displacement without lag";
      }
      if (std::fabs(lag->lag) < std::max(3.0 * lag->std_error, 1e-4)) {
        return fmt::format("the recorded velocity agrees with the slope of the displacement within {:.2g} ms",
                           1e3 * std::max({std::fabs(lag->lag), 2.0 * lag->std_error, 1e-6}));
      }
      break;
    }
  }
  return std::nullopt;
}

std::optional<std::string> excluded_by_inputs(const std::string& effect, const std::vector<Recording>& recordings) {
  for (const Need need : knowledge_of(effect).needs) {
    if (std::optional<std::string> reason = unmet(need, recordings)) {
      return reason;
    }
  }
  return std::nullopt;
}

}  // namespace hysteron
