#include "task/coordinate_name.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hysteron {

std::string coordinate_name(const Layout& layout, std::size_t c, DriveKind drive) {
  const Coordinate& coordinate = layout.coordinates()[c];
  const auto law = std::ranges::find(layout.laws(), coordinate.parameter, &ParameterLaw::parameter);
  const ParameterLaw::Node node = law->node(coordinate.node);
  std::string place;
  if (law->drive_nodes.size() > 1) {
    place = fmt::format(" at {:.3g} {}", node.drive, drive == DriveKind::voltage ? "V" : "A");
  }
  if (law->frequency_nodes.size() > 1) {
    place += fmt::format("{} {:.3g} Hz", place.empty() ? " at" : ",", node.frequency);
  }
  for (std::size_t k = 0; k < law->condition_nodes.size(); ++k) {
    if (law->condition_nodes[k].size() > 1) {
      const ConditionRange& condition = layout.conditions()[k];
      place += fmt::format("{} {} {:.3g}{}{}", place.empty() ? " at" : ",", condition.name, node.conditions[k],
                           condition.unit.empty() ? "" : " ", condition.unit);
    }
  }
  return layout.names()[coordinate.parameter] + place;
}

}  // namespace hysteron
