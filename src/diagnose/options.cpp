#include "diagnose/options.hpp"

namespace hysteron {

std::vector<std::string> alternative_laws() {
  std::vector<std::string> result;
  for (const Part* law : model_catalogue()) {
    if (law->alternative) {
      result.emplace_back(law->id);
    }
  }
  return result;
}

std::map<std::string, int> base_laws(const std::string& model, const std::vector<Recording>& recordings) {
  std::map<std::string, int> result;
  const Part* part = find_model(model);
  if (drive_levels(recordings) < 2 || part == nullptr) {
    return result;
  }
  for (const Parameter& parameter : part->parameters) {
    const bool follows = parameter.role == PhysicalRole::yield_force || parameter.role == PhysicalRole::damping;
    if (follows && !parameter.fixed) {
      result[std::string(parameter.name)] = 1;
    }
  }
  return result;
}

}  // namespace hysteron
