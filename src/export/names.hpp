// Names for exported code: of its functions, files, Python module and Modelica package.
#pragma once

#include <string>
#include <string_view>

#include "core/message.hpp"

namespace hysteron {

// Begins with a letter, then letters, digits and underscores: "bouc-wen" -> "bouc_wen", "2nd" -> "m_2nd".
std::string identifier(std::string_view text);

// InputError, opened by the option that gave the name, unless it can stand in every language that is written: it is an
// identifier, a word of none of them, and no file or module that the exported code uses.
void refuse_name(Option option, const std::string& name);

}  // namespace hysteron
