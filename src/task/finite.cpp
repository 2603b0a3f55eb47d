#include "task/finite.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"

namespace hysteron {
namespace {

// No force; its square is still a number.
constexpr double beyond_n = 1e100;

}  // namespace

std::optional<double> diverges_at(const std::vector<double>& force, const Recording& recording) {
  for (std::size_t n = 0; n < force.size(); ++n) {
    if (!(std::fabs(force[n]) < beyond_n)) return recording.time[n];
  }
  return std::nullopt;
}

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
