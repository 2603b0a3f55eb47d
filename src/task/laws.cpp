#include "task/laws.hpp"

namespace hysteron {

void add_laws_of(const Campaign& campaign, LayoutOptions& asked) {
  if (asked.by_current.empty()) asked.by_current = campaign.by_current;
  if (asked.by_frequency.empty()) asked.by_frequency = campaign.by_frequency;
  asked.by.insert(campaign.by.begin(), campaign.by.end());
}

}  // namespace hysteron
