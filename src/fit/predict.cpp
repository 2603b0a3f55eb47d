#include "fit/predict.hpp"

#include <algorithm>
#include <cstring>

#include "fit/march_target.hpp"

namespace hysteron {

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

}  // namespace hysteron
