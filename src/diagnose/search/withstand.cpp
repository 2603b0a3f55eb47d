#include "diagnose/search/withstand.hpp"

#include <algorithm>

#include "diagnose/residual/misfit.hpp"

namespace hysteron {
namespace {

constexpr int rounds = 10;
constexpr double comparable = 2.0;
constexpr const char* skew = "sensor-delay";
constexpr std::string_view behind = "behind ";

Trial trial(const std::string& under, const Fit& with, const Fit& without, double gain, double effective) {
  return {under, (squared(without.cost) - squared(with.cost)) / gain,
          evidence(squared(without.cost), squared(with.cost),
                   static_cast<double>(with.dimension()) - static_cast<double>(without.dimension()), effective)};
}

}  // namespace

bool is_of_another_law(const Trial& trial) { return trial.under.starts_with(behind); }

std::vector<Trial> trials_of(const Workbench& bench, const std::string& effect, const Fit& augmented,
                             const Fit& without, const Fit& base, const std::vector<Fit>& other_laws,
                             double effective) {
  std::vector<Trial> result;
  const double gain = squared(without.cost) - squared(augmented.cost);
  const auto other = std::ranges::min_element(other_laws, {}, &Fit::cost);
  if (other != other_laws.end() && squared(other->cost) < comparable * squared(base.cost)) {
    const Fit with = bench.from_fit({other->what.model, {effect}, {}}, *other, rounds);
    result.push_back(trial(std::string(behind) + other->what.model, with, *other, gain, effective));
  }
  const auto holds_skew = [](const Fit& fit) {
    return std::ranges::find(fit.what.effects, skew) != fit.what.effects.end();
  };
  if (!holds_skew(augmented) && !holds_skew(without)) {
    Hypothesis with = augmented.what;
    Hypothesis less = without.what;
    with.effects.emplace_back(skew);
    less.effects.emplace_back(skew);
    const Fit skewed = bench.from_fit(less, without, rounds);
    result.push_back(trial("with a skew between the channels left free", bench.from_fit(with, augmented, rounds),
                           skewed, gain, effective));
  }
  return result;
}

}  // namespace hysteron
