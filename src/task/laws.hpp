// Laws of parameters that campaign.toml gives.
#pragma once

#include "core/recording.hpp"
#include "fit/layout.hpp"

namespace hysteron {

// Laws in the drive, the frequency and every condition for which none are asked are the campaign's.
void add_laws_of(const Campaign& campaign, LayoutOptions& asked);

// Throws InputError where add_laws_of would add a law of a parameter that the model does not have, with its line.
void refuse_laws_of_other_model(const Campaign& campaign, const LayoutOptions& asked, const CompositeModel& model);

}  // namespace hysteron
