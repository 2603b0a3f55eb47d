#include "diagnose/workbenches.hpp"

#include <fmt/format.h>

#include "diagnose/signal/thin.hpp"

namespace hysteron {
namespace {

// What hypotheses are compared on.
constexpr std::size_t quick_samples = 3000;
constexpr std::size_t quick_recordings = 8;

// The laws of the user's choice, or the base model's own with a note.
LayoutOptions with_laws(const DiagnoseOptions& options, const Split& split, const Campaign& campaign,
                        std::vector<std::string>& notes) {
  LayoutOptions layout = options.layout;
  if (!layout.by_current.empty() || !layout.by_frequency.empty()) {
    return layout;
  }
  layout.by_current = base_laws(options.model, split.fit);
  std::string list;
  for (const auto& [name, order] : layout.by_current) {
    list += (list.empty() ? "" : ",") + fmt::format("{}:{}", name, order);
  }
  if (!list.empty()) {
    notes.push_back("the drive varies and no laws were given: laws in the drive assumed, " + list);
  } else if (!base_laws(options.model, campaign.recordings).empty()) {
    notes.emplace_back(
        "the fitted recordings hold one level of the drive, and those held out another: no law in the drive can be "
        "found from them, and none is assumed");
  }
  return layout;
}

}  // namespace

Workbenches workbenches_of(const Campaign& campaign, const Split& split, const DiagnoseOptions& options,
                           std::vector<std::string>& notes) {
  const LayoutOptions layout = with_laws(options, split, campaign, notes);
  const DataScale scale = scale_of(campaign.recordings);
  ObjectiveOptions objective = options.objective;
  objective.skip_run_in = true;
  objective.stopped = options.stopped;
  ObjectiveOptions coarse = objective;
  coarse.comparing = true;
  Split fewer{thinned(spread(split.fit, quick_recordings), quick_samples), {}, {}, false};
  Split some{thinned(split.fit, fine_samples), {}, {}, false};
  Workbenches result{Workbench(scale, split, layout, objective, options.seed, options.stopped),
                     Workbench(scale, std::move(fewer), layout, coarse, options.seed, options.stopped),
                     Workbench(scale, std::move(some), layout, coarse, options.seed, options.stopped),
                     Workbench(scale, {thinned(campaign.recordings, fine_samples), {}, {}, false}, layout, coarse,
                               options.seed, options.stopped)};
  for (Workbench* bench : {&result.quick, &result.fine, &result.every}) {
    bench->take_noise_and_motions_of(result.whole);
  }
  if (options.checkpoint != nullptr) {
    for (Workbench* bench : {&result.whole, &result.quick, &result.fine, &result.every}) {
      bench->keep_in(*options.checkpoint);
    }
  }
  return result;
}

}  // namespace hysteron
