// Laws of parameters that campaign.toml gives.
#pragma once

#include <set>
#include <string>

#include "core/recording.hpp"
#include "fit/layout.hpp"

namespace hysteron {

// Laws in the drive, the frequency and every condition for which none are asked are the campaign's.
void add_laws_of(const Campaign& campaign, LayoutOptions& asked);

// Throws InputError where add_laws_of would add a law of a parameter that the model does not have, nor is one of
// `others`, with its line.
void refuse_laws_of_other_model(const Campaign& campaign, const LayoutOptions& asked, const CompositeModel& model,
                                const std::set<std::string>& others = {});

// Of the recordings that are fitted, which laws are spanned over: not those that campaign.toml holds out.
DataScale scale_of_fitted(const Campaign& campaign);

// Throws InputError where a law that is asked for follows what the fitted recordings alone hold one value of (where all
// do, the layout refuses it), or one that add_laws_of would add (with its line) what the fitted ones hold one value of.
void refuse_laws_of_one_level(const Campaign& campaign, const LayoutOptions& asked, const DataScale& fitted);

}  // namespace hysteron
