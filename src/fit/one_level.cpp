#include "fit/one_level.hpp"

#include <algorithm>

namespace hysteron {

std::string lack_of_levels(const DataScale& scale, const std::string& what, std::string_view whose) {
  if (what == "current") {
    if (scale.drive_high > scale.drive_low) return {};
    return std::string(whose) + " hold no current or voltage, or only one level of it, expected at least two levels";
  }
  bool several = false;
  if (what == "frequency") {
    several = scale.frequency_high > scale.frequency_low;
  } else {
    const auto condition = std::ranges::find(scale.conditions, what, &ConditionRange::name);
    several = condition != scale.conditions.end() && condition->high > condition->low;
  }
  return several ? std::string{} : std::string(whose) + " hold only one " + what + ", expected at least two";
}

void refuse_one_level(const DataScale& scale, const std::string& what, const Message& law, int order,
                      std::string_view whose) {
  if (order == 0) return;
  const std::string lack = lack_of_levels(scale, what, whose);
  if (!lack.empty()) throw OptionError(law + ":" + std::to_string(order) + ": " + lack);
}

}  // namespace hysteron
