// Reading recordings to work on, with what the readers remark of them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/recording.hpp"
#include "io/campaign.hpp"
#include "io/channels.hpp"

namespace hysteron {

// Channels that work does not do without, beside the time.
enum class Required { motion_and_force, motion, nothing };

struct Loaded {
  Campaign campaign;
  std::vector<Remark> remarks;
  std::size_t of_each = 0;  // the remarks of the readers, which are first; those of remarks_on follow
};
// As load_campaign, with the channels required; `options.remark` is not called. Recordings of too few samples a period,
// of another unit than the others, and copies are remarked too.
Loaded load_with_remarks(const std::vector<std::string>& data, ReadOptions options, Required required,
                         const TakenOfCampaign& taken = {});

// Of recordings alike the first remark, whose text counts the others.
std::vector<Remark> once_each(const std::vector<Remark>& remarks);
// As a warning of a result file, which holds no paths.
std::string warning_of(const Remark& remark);

}  // namespace hysteron
