#include "task/words.hpp"

#include <set>

#include "core/error.hpp"
#include "core/message.hpp"

namespace hysteron {

void refuse_repeats(const Message& option, const std::vector<std::string>& words) {
  std::set<std::string> seen;
  for (const std::string& word : words) {
    if (!seen.insert(word).second) throw OptionError(option + ": '" + word + "' is given twice, expected each once");
  }
}

}  // namespace hysteron
