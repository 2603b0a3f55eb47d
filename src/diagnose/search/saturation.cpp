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

// Whether, behind the base model, the effect takes off more than it leaves to richer laws.
bool does_most_of_the_laws(const std::vector<Tried>& first_stage) {
  double by_effect = 0.0;
  double by_laws = 0.0;
  for (const Tried& tried : first_stage) {
    if (tried.part == effect_extension(saturation)) {
      by_effect = tried.gain;
    } else if (tried.part.is_law()) {
      by_laws = std::max(by_laws, tried.gain);
    }
  }
  return by_effect > by_laws - by_effect;
}

}  // namespace

bool saturates(const Fit& base, const Fit& augmented, const std::string& parameter,
               const std::vector<Tried>& first_stage) {
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
  if (does_most_of_the_laws(first_stage)) {
    return true;
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
