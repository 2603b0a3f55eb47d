#pragma once

#include <string>
#include <vector>

#include "core/message.hpp"

namespace hysteron {

// InputError when a word is there twice; `option` opens the message.
void refuse_repeats(const Message& option, const std::vector<std::string>& words);

}  // namespace hysteron
