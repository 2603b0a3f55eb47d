// Whether a recording is of the size of a damper's: a wrong or missing unit gives a good fit of something else.
#pragma once

#include <functional>
#include <string>

#include "core/recording.hpp"
#include "io/channels.hpp"

namespace hysteron {

// Tells `options.remark`, if there is one, of every channel whose size is far outside what dampers do, what unit was
// taken where the file gives none, and of a velocity that is not the slope of the displacement.
void remark_on_sizes(const Recording& recording, const Sources& sources, const std::vector<Column>& columns,
                     const ReadOptions& options, const std::string& file);

// Likewise of the numbers that campaign.toml or the command line gives for a whole recording.
void remark_on_numbers(const ReadOptions& options, const std::string& file);

}  // namespace hysteron
