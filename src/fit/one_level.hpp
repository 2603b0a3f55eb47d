// What laws lack where the recordings hold one value of what they follow.
#pragma once

#include <string>
#include <string_view>

#include "core/message.hpp"
#include "fit/layout.hpp"

namespace hysteron {

// Of laws in "current", the drive, "frequency" or a condition of the scale: "the recordings hold only one frequency,
// expected at least two"; empty where there are several values. `whose` are the recordings of the scale.
std::string lack_of_levels(const DataScale& scale, const std::string& what, std::string_view whose = "the recordings");

// InputError where a law of this order, which an option with a parameter gives, lacks them.
void refuse_one_level(const DataScale& scale, const std::string& what, const Message& law, int order,
                      std::string_view whose = "the recordings");

}  // namespace hysteron
