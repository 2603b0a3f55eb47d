#include "io/lost_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/extent.hpp"
#include "core/robust.hpp"

namespace hysteron {
namespace {

// Of four steps one may be that of another lost row; the other three differ by this part of their mean at most. Near
// reversals and corners, and where noise is as large as the steps, neighbours tell nothing. A sine of 18 samples a
// period has them so where it is fastest.
constexpr double alike = 0.25;
// Of the usual step of time: a stamp in the file is rounded by less, and a step over a lost row is longer by all of it.
constexpr double even = 0.1;
// A step is so many times larger than what neighbours usually miss, and than the quantum of the channel, by one of
// which rounding alone may be off: r is then within an eighth, as a standard deviation or at most.
constexpr double fast = 8.0;
// Of the span: what the arithmetic on the numbers of the file makes of two steps of one size.
constexpr double rounding = 1e-7;
// So near to a whole number, nearly three of these deviations. Half of all numbers would be by more than that chance.
constexpr double near = 0.35;
// More rows lost at once are a gap, which is told as a leap (io/motion_faults.hpp).
constexpr double most_at_once = 3.0;
// Of measured recordings hardly a step is longer by a whole one, and many times as many are off by anything else. One
// row that is lost does next to nothing to a fit.
constexpr std::size_t fewest_places = 3;
constexpr double most_others = 0.25;

// That tell what is usual.
constexpr std::size_t most_looked_at = 65536;

double usual_length(const std::vector<double>& time) {
  const std::size_t stride = time.size() / most_looked_at + 1;
  std::vector<double> lengths;
  for (std::size_t n = 0; n + 1 < time.size(); n += stride) lengths.push_back(time[n + 1] - time[n]);
  return median_of(std::move(lengths));
}

// Calls `visit(n, told, further)` for the steps from n to n + 1 whose neighbours are alike and whose times are even:
// the step that the neighbours tell, and by how much it is longer.
template <class Visit>
void for_each_told_step(const std::vector<double>& time, const std::vector<double>& x, Visit visit) {
  const double usual = usual_length(time);
  const auto step = [&x](std::size_t n) { return x[n + 1] - x[n]; };
  for (std::size_t n = 2; n + 3 < x.size(); ++n) {
    std::array<double, 4> beside = {step(n - 2), step(n - 1), step(n + 1), step(n + 2)};
    std::ranges::sort(beside);
    const double told = 0.5 * (beside[1] + beside[2]);
    if (!(std::min(beside[2] - beside[0], beside[3] - beside[1]) < alike * std::fabs(told))) continue;
    bool are_even = true;
    for (std::size_t k = n - 2; k <= n + 2; ++k) {
      are_even = are_even && std::fabs(time[k + 1] - time[k] - usual) < even * usual;
    }
    if (are_even) visit(n, told, step(n) - told);
  }
}

// By how much neighbours miss a step, as a standard deviation; nothing where they tell none.
std::optional<double> usual_miss(const std::vector<double>& time, const std::vector<double>& x) {
  const std::size_t stride = x.size() / most_looked_at + 1;
  std::size_t count = 0;
  std::vector<double> missed;
  for_each_told_step(time, x, [&](std::size_t, double, double further) {
    if (count++ % stride == 0) missed.push_back(further);
  });
  return missed.empty() ? std::nullopt : std::optional(robust_deviation(std::move(missed)));
}

// At constant speed, too, where channel_quantum() (io/velocity.hpp) finds none: the smallest change from a step to the
// next one; of a channel without a quantum it is as good as nothing.
double smallest_change(const std::vector<double>& x) {
  const double nothing = rounding * span_of(x);
  double result = 0.0;
  for (std::size_t n = 1; n + 1 < x.size(); ++n) {
    const double change = std::fabs(x[n + 1] - 2.0 * x[n] + x[n - 1]);
    if (change > nothing && (result == 0.0 || change < result)) result = change;
  }
  return result;
}

}  // namespace

std::optional<LostSamples> lost_samples_of(const Recording& recording) {
  const std::vector<double>& x = recording.displacement;
  if (x.size() < 8 || recording.size() != x.size()) return std::nullopt;
  const std::optional<double> miss = usual_miss(recording.time, x);
  if (!miss) return std::nullopt;
  const double least = fast * std::max(*miss, smallest_change(x));
  LostSamples result;
  std::size_t steps = 0;
  std::size_t others = 0;
  double lost = 0.0;
  for_each_told_step(recording.time, x, [&](std::size_t n, double told, double further) {
    if (std::fabs(told) < least) return;
    ++steps;
    const double r = further / told;
    const double whole = std::round(r);
    if (whole >= 1.0 && whole <= most_at_once && std::fabs(r - whole) < near) {
      if (result.count == 0) result.after = n;
      ++result.count;
      lost += whole;
    } else if (std::fabs(r) >= near) {
      ++others;
    }
  });
  const bool alone = static_cast<double>(others) <= most_others * static_cast<double>(result.count);
  if (result.count < fewest_places || !alone) return std::nullopt;
  result.share = lost / (static_cast<double>(steps) + lost);
  return result;
}

std::string sentence_of(const LostSamples& lost, const Recording& recording) {
  return fmt::format(
      "the displacement goes by two of its steps or more at once in {} places, first between {:.4g} and {:.4g} s, "
      "while the times are even: rows that were lost before the times were made, about {:.2g} %, look so; speeds come "
      "out too high, and a damping too small by that part or more; keep the times at which the rows were taken",
      lost.count, recording.time[lost.after], recording.time[lost.after + 1], 100.0 * lost.share);
}

}  // namespace hysteron
