#include "fit/usable.hpp"

#include <algorithm>
#include <string>

#include "core/error.hpp"

namespace hysteron {
namespace {

bool changes(const std::vector<double>& values) {
  return std::ranges::any_of(values, [&](double value) { return value != values.front(); });
}

}  // namespace

void require_usable(const std::vector<Recording>& recordings, ForceOf force) {
  for (const Recording& recording : recordings) {
    if (recording.size() < fewest_samples) {
      throw InputError(recording.file, 0,
                       std::to_string(recording.size()) + " samples, expected at least " +
                           std::to_string(fewest_samples) + " to identify a model from");
    }
    if (force == ForceOf::damper && changes(recording.displacement) && !changes(recording.force)) {
      throw InputError(recording.file, 0,
                       "the force is the same throughout, expected one that changes with the motion");
    }
  }
  if (std::ranges::none_of(recordings, [](const Recording& one) { return changes(one.displacement); })) {
    throw InputError(recordings.front().file, 0,
                     std::string("the displacement is the same throughout") +
                         (recordings.size() > 1 ? ", as in every other recording" : "") + ", expected a motion");
  }
}

}  // namespace hysteron
