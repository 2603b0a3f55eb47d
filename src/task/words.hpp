#pragma once

#include <string>
#include <vector>

namespace hysteron {

// InputError when a word is there twice; `option` opens the message.
void refuse_repeats(const std::string& option, const std::vector<std::string>& words);

}  // namespace hysteron
