#include "task/rate.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "simulate/parameter.hpp"

namespace hysteron {

void require_no_rate(const CompositeModel& model, const std::vector<bool>& may_act, bool follows_frequency,
                     const std::vector<Recording>& recordings, const Message& advice) {
  const auto untimed = std::ranges::find(recordings, false, &Recording::timed);
  if (untimed == recordings.end()) return;
  if (follows_frequency) {
    throw InputError(untimed->file, 0, "the file has no time, and parameters follow the frequency of the motion");
  }
  const std::vector<std::string> names = model.parameter_names();
  const std::vector<Parameter> cards = model.parameters();
  for (std::size_t k = 0; k < names.size(); ++k) {
    // Times are kept as lengths over velocities.
    if (may_act[k] && dimension_of(cards[k].unit).velocity != 0.0) {
      throw OptionError(untimed->file, 0,
                        "the file has no time, and the force depends on the rate through " + names[k] + " [" +
                            std::string(cards[k].unit) + "], expected " + advice);
    }
  }
}

}  // namespace hysteron
