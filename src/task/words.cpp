#include "task/words.hpp"

#include <set>

#include "core/error.hpp"

namespace hysteron {

void refuse_repeats(const std::string& option, const std::vector<std::string>& words) {
  std::set<std::string> seen;
  for (const std::string& word : words) {
    if (!seen.insert(word).second) throw InputError(option + ": '" + word + "' is given twice, expected each once");
  }
}

}  // namespace hysteron
