#include "check/sampling.hpp"

#include <fmt/format.h>

#include "core/frequency.hpp"

namespace hysteron {
namespace {

// The window from which a velocity is derived is a twelfth of a period; fewer samples do not fill it. A Bouc-Wen damper
// sampled 10, 12, 16 and 20 times a period, with noise of half a percent, has parameters that are off by up to 45, 22,
// 5 and 5 %; sharper knees want more.
constexpr double fewest_a_period = 12.0;
constexpr int enough = 50;

}  // namespace

std::optional<Remark> remark_on_sampling(const Recording& recording) {
  const double frequency = dominant_frequency(recording);
  if (!(frequency > 0.0)) return std::nullopt;
  const double step = (recording.time.back() - recording.time.front()) / static_cast<double>(recording.size() - 1);
  const double a_period = 1.0 / (frequency * step);
  if (a_period > fewest_a_period) return std::nullopt;
  return Remark{recording.file, Remark::Kind::implausible, "sampling",
                fmt::format("{:.1f} samples a period of its main frequency, {:.3g} Hz: what happens at a reversal lies "
                            "between them, and parameters may be off by a third; record {} or more a period",
                            a_period, frequency, enough)};
}

}  // namespace hysteron
