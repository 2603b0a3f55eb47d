#include "fit/predict.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "fit/march_target.hpp"

namespace hysteron {
namespace {

// No force; its square is still a number.
constexpr double beyond_n = 1e100;

}  // namespace

std::vector<double> predict(const CompositeModel& model, const std::vector<double>& held,
                            const std::vector<Term>& terms, const Target& target) {
  std::vector<double> force(target.motion.time.size());
  march_target<double>(
      model, target,
      [&](double drive, std::span<const double> conditions, double* p) {
        const std::vector<double> values = parameters_at(held, terms, drive, target.frequency, conditions);
        std::ranges::copy(values, p);
      },
      [&](std::size_t begin, std::size_t count, const double* out) {
        std::memcpy(force.data() + begin, out, count * sizeof(double));
      },
      [](std::size_t, std::size_t, const double*) {});
  return force;
}

std::optional<double> diverges_at(const std::vector<double>& force, const Recording& recording) {
  for (std::size_t n = 0; n < force.size(); ++n) {
    if (!(std::fabs(force[n]) < beyond_n)) return recording.time[n];
  }
  return std::nullopt;
}

}  // namespace hysteron
