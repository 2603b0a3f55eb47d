// Laws of parameters that campaign.toml gives.
#pragma once

#include "core/recording.hpp"
#include "fit/layout.hpp"

namespace hysteron {

// Laws in the drive, the frequency and every condition for which none are asked are the campaign's.
void add_laws_of(const Campaign& campaign, LayoutOptions& asked);

}  // namespace hysteron
