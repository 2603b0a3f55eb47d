#include "diagnose/search/extend.hpp"

#include <algorithm>

#include "diagnose/residual/misfit.hpp"
#include "diagnose/search/stage.hpp"

namespace hysteron {
namespace {

// Parts of the squared error that an addition takes off: of the fitted recordings, and of the judged ones.
constexpr double plain_gain = 0.03;
constexpr double plain_heldout_gain = 0.01;

}  // namespace

Fit extended(const Workbench& bench, const Fit& fit, std::vector<std::string> effects, double effective, int most) {
  Fit current = fit;
  for (int depth = 0; depth < most; ++depth) {
    std::vector<std::string> candidates = effects;
    for (const auto& laws : {law_candidates(bench, current.what), joint_law_candidates(bench, current.what)}) {
      candidates.insert(candidates.end(), laws.begin(), laws.end());
    }
    const std::vector<Tried> tried = stage(bench, current, candidates, effective);
    const auto chosen = std::ranges::find_if(tried, [&](const Tried& one) {
      return worth(one, current, static_cast<double>(candidates.size())) &&
             one.gain > plain_gain * squared(current.cost) &&
             one.heldout_gain > plain_heldout_gain * squared(current.heldout);
    });
    if (chosen == tried.end()) {
      break;
    }
    effects = promising(tried);
    current = chosen->fit;
  }
  return current;
}

}  // namespace hysteron
