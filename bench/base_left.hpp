// What the base law of a campaign leaves, prepared as `hysteron diagnose` does: what checks of the residual are
// measured on.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "diagnose/diagnose.hpp"
#include "diagnose/workbenches.hpp"
#include "io/campaign.hpp"

namespace hysteron::bench {

struct BaseLeft {
  std::vector<Recording> recordings;
  std::vector<Residual> residuals;
};

inline BaseLeft base_left(const std::filesystem::path& folder, int threads) {
  constexpr std::size_t budget = 20000;
  Campaign campaign = load_campaign({folder.string()});
  without_outliers(campaign);
  DiagnoseOptions options;
  options.model = campaign.model.empty() ? "bouc-wen" : campaign.model;
  options.layout.by_current = campaign.by_current;
  options.layout.by_frequency = campaign.by_frequency;
  options.objective.threads = threads;
  std::vector<std::string> notes;
  const Workbenches benches = workbenches_of(campaign, split_of(campaign), options, notes);
  const Fit base = benches.quick.from_anywhere({options.model, {}, {}}, budget);
  return {benches.whole.split().fit, benches.whole.plain_residuals(base)};
}

}  // namespace hysteron::bench
