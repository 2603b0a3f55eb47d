// What the command line calls the options that messages of the library name.
#pragma once

#include <string>

#include "core/message.hpp"

namespace hysteron::app {

// "--by-current".
inline std::string option_name(Option option) { return "--" + std::string(name_of(option)); }

}  // namespace hysteron::app
