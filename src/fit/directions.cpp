#include "fit/directions.hpp"

#include "fit/march_inputs.hpp"

namespace hysteron {

Directions directions_of(const Layout& layout, const Target& target) {
  Directions result;
  result.of.resize(layout.dimension());
  result.by_parameter = !target.inputs_vary && MarchInputs<double>(layout.model()).none();
  if (!result.by_parameter) {
    result.count = layout.dimension();
    for (std::size_t c = 0; c < result.count; ++c) {
      result.of[c] = {c};
    }
    return result;
  }
  result.count = layout.laws().size();
  const std::vector<double> conditions = target.conditions_at(0);
  for (std::size_t j = 0; j < result.count; ++j) {
    const ParameterLaw& law = layout.laws()[j];
    const std::vector<double> weights = Layout::weights(law, target.drive, target.frequency, conditions);
    for (std::size_t k = 0; k < weights.size(); ++k) {
      result.of[law.first + k] = {j, weights[k], weights.size() > 1};
    }
  }
  return result;
}

}  // namespace hysteron
