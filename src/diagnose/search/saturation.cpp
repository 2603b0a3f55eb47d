#include "diagnose/search/saturation.hpp"

#include <algorithm>
#include <array>

namespace hysteron {
namespace {

const ParameterLaw* law_of(const Layout& layout, const std::string& parameter) {
  const auto at = std::ranges::find_if(
      layout.laws(), [&](const ParameterLaw& law) { return layout.names()[law.parameter] == parameter; });
  return at == layout.laws().end() ? nullptr : &*at;
}

}  // namespace

bool saturates(const Fit& base, const Fit& augmented, const std::string& parameter) {
  if (contains(augmented.what, effect_extension(saturation))) {
    return false;
  }
  const ParameterLaw* before = law_of(*base.layout, parameter);
  const ParameterLaw* law = law_of(*augmented.layout, parameter);
  if (before == nullptr || law == nullptr || before->drive_nodes.size() < 2) {
    return false;
  }
  if (augmented.layout->cards()[law->parameter].role != PhysicalRole::yield_force) {
    return false;
  }
  const double low = law->drive_nodes.front();
  const double high = law->drive_nodes.back();
  std::array<double, 5> values{};
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double drive = low + (high - low) * static_cast<double>(k) / static_cast<double>(values.size() - 1);
    values[k] = parameters_at(augmented.layout->held(), augmented.terms, drive, law->frequency_nodes.front(),
                              middle_of(augmented.layout->conditions()))[law->parameter];
  }
  for (std::size_t k = 1; k + 1 < values.size(); ++k) {
    if (values[k + 1] - values[k] > values[k] - values[k - 1] || values[k + 1] < values[k]) {
      return false;
    }
  }
  return true;
}

}  // namespace hysteron
