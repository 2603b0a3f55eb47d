// Whether a recording is of the size of a damper's: a wrong or missing unit gives a good fit of something else.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/recording.hpp"
#include "io/channels.hpp"
#include "io/conditions.hpp"

namespace hysteron {

// Tells `options.remark`, if there is one, of every channel whose size is far outside what dampers do, what unit was
// taken where the file gives none, and of a velocity that is not the slope of the displacement.
void remark_on_sizes(const Recording& recording, const Sources& sources, const std::vector<Column>& columns,
                     const ReadOptions& options, const std::string& file);

// Likewise of the channels that a damper is set to and that parameters follow, the drive, a temperature and the columns
// of laws: numbers that stand for missing samples, and samples that stray. `values` are those of the conditions'
// columns, as for make_conditions().
void remark_on_settings(const Sources& sources, const Channels& channels,
                        const std::vector<ConditionSource>& conditions, const std::vector<std::vector<double>>& values,
                        const std::vector<Column>& columns, const ReadOptions& options, const std::string& file);

// Likewise of the numbers that campaign.toml or the command line gives for a whole recording.
void remark_on_numbers(const ReadOptions& options, const std::string& file);

}  // namespace hysteron
