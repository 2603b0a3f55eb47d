#include "check/campaign.hpp"

#include "check/beside_others.hpp"
#include "check/channels_beside_others.hpp"
#include "check/copies.hpp"
#include "check/sampling.hpp"
#include "check/scaled_channels.hpp"
#include "check/switched_drive.hpp"

namespace hysteron {

std::vector<Remark> remarks_on(const std::vector<Recording>& recordings, Moving moving) {
  std::vector<Remark> result;
  if (moving == Moving::damper) {
    for (const Recording& recording : recordings) {
      if (const auto remark = remark_on_sampling(recording)) result.push_back(*remark);
    }
    const std::vector<Remark> of_channels = remarks_on_channels_beside_others(recordings);
    result.insert(result.end(), of_channels.begin(), of_channels.end());
  }
  for (const auto& of_campaign : {remarks_beside_others(recordings), remarks_on_scaled_channels(recordings),
                                  remarks_on_switched_drives(recordings), remarks_on_copies(recordings)}) {
    result.insert(result.end(), of_campaign.begin(), of_campaign.end());
  }
  return result;
}

}  // namespace hysteron
