// Messages of the library name what a caller gives: on the command line an option, here an argument.
#pragma once

#include <string>

#include "core/message.hpp"

namespace hysteron::python {

// "by_current"; Option::column is the argument columns.
std::string argument_name(Option option);

// Mappings of columns as the argument takes them: columns displacement="x [mm]" -> columns={"displacement": "x [mm]"}.
std::string with_mappings(const std::string& message);

// Where a message still has options of the command line. "--by-current: ..." -> "by_current: ...", and --column is the
// argument columns.
std::string with_arguments(const std::string& message);

}  // namespace hysteron::python
