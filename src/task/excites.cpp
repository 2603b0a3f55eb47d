#include "task/excites.hpp"

#include "core/error.hpp"
#include "core/message.hpp"

namespace hysteron {

Excites excites_of(const std::string& word) {
  if (word == "auto") return Excites::what_is_recorded;
  if (word == "force") return Excites::force;
  if (word == "base") return Excites::base;
  throw OptionError(Option::excitation + ": '" + word + "' is not known, expected auto, force or base");
}

}  // namespace hysteron
