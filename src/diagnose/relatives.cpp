#include "diagnose/relatives.hpp"

#include <algorithm>

namespace hysteron {

std::vector<std::string> relatives(const std::string& id) {
  static const std::vector<std::vector<std::string>> families = {
      {"offset-force", "gas-spring"},
      {"linear-stiffness", "gas-spring", "cubic-stiffness", "end-stop"},
      {"compliance", "clearance", "entrapped-gas"},
      {"compliance", "series-dashpot"},
      {"inertia", "sensor-delay", "velocity-lag"},
      {"coulomb-friction", "seal-friction", "pre-yield-hysteresis"},
      {"viscous-damping", "quadratic-damping", "shear-thinning"},
      {"self-heating", "degradation", "stiction"},
      {"coil-lag", "magnetic-remanence", "magnetic-saturation"},
      {"asymmetry", "cavitation"},
      {"pinching", "cubic-stiffness"},
  };
  std::vector<std::string> result;
  for (const std::vector<std::string>& family : families) {
    if (std::ranges::find(family, id) == family.end()) {
      continue;
    }
    for (const std::string& other : family) {
      if (other != id && std::ranges::find(result, other) == result.end()) {
        result.push_back(other);
      }
    }
  }
  return result;
}

bool is_limit(const std::string& effect, const std::string& wider) {
  static const std::vector<std::pair<std::string, std::string>> limits = {
      {"offset-force", "gas-spring"},  {"linear-stiffness", "gas-spring"}, {"coulomb-friction", "seal-friction"},
      {"compliance", "entrapped-gas"}, {"compliance", "clearance"},        {"cubic-stiffness", "end-stop"},
  };
  return std::ranges::find(limits, std::pair{effect, wider}) != limits.end();
}

}  // namespace hysteron
