#include "fit/one_level.hpp"

#include <algorithm>

namespace hysteron {

std::string lack_of_levels(const DataScale& scale, const std::string& what) {
  if (what == "current") {
    if (scale.drive_high > scale.drive_low) return {};
    return "the recordings hold no current or voltage, or only one level of it, expected at least two levels";
  }
  bool several = false;
  if (what == "frequency") {
    several = scale.frequency_high > scale.frequency_low;
  } else {
    const auto condition = std::ranges::find(scale.conditions, what, &ConditionRange::name);
    several = condition != scale.conditions.end() && condition->high > condition->low;
  }
  return several ? std::string{} : "the recordings hold only one " + what + ", expected at least two";
}

}  // namespace hysteron
