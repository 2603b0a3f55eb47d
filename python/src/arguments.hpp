// Messages of the library name what a value was given by: on the command line an option, here an argument.
#pragma once

#include <string>

namespace hysteron::python {

// "--by-current: ..." -> "by_current: ...", and --column is the argument columns.
std::string with_arguments(const std::string& message);

}  // namespace hysteron::python
