#include "challenge/electric.hpp"

#include <algorithm>
#include <cmath>

namespace hysteron::challenge {
namespace {
constexpr double grid = 1e-4;
}

Field::Field(const Physics& physics, const Drive& drive, double begin, double end) : drive_(drive), begin_(begin) {
  const bool changed = std::ranges::any_of(
      physics.parts, [](const PartPointer& part) { return part->field_stage() != FieldStage::none; });
  if (!changed) return;
  const auto points = static_cast<std::size_t>(std::ceil((end - begin) / grid)) + 2;
  values_.reserve(points);
  for (std::size_t k = 0; k < points; ++k) values_.push_back(drive.at(begin + grid * static_cast<double>(k)));
  for (const FieldStage stage : {FieldStage::supply, FieldStage::coil, FieldStage::remanence, FieldStage::saturation}) {
    for (const PartPointer& part : physics.parts) {
      if (part->field_stage() == stage) part->magnetise(values_, grid, begin);
    }
  }
}

double Field::at(double t) const {
  if (values_.empty()) return drive_.at(t);
  const double place = std::clamp((t - begin_) / grid, 0.0, static_cast<double>(values_.size() - 2));
  const auto k = static_cast<std::size_t>(place);
  return values_[k] + (place - static_cast<double>(k)) * (values_[k + 1] - values_[k]);
}

}  // namespace hysteron::challenge
