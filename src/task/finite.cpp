#include "task/finite.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"

namespace hysteron {

std::string percent_text(double percent) {
  constexpr double readable = 1e5;
  return !std::isfinite(percent)         ? "-"
         : std::fabs(percent) < readable ? fmt::format("{:.1f}", percent)
                                         : fmt::format("{:.3g}", percent);
}

void require_finite(const std::vector<double>& force, const Recording& recording) {
  if (const auto time = diverges_at(force, recording)) {
    throw WorkError(fmt::format(
        "{}: the simulation does not stay finite from {:g} s on: with these parameters the model does not hold for "
        "this motion",
        recording.file, *time));
  }
}

}  // namespace hysteron
