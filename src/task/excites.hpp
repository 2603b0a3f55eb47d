// What moves the mass of a response.
#pragma once

#include <string>

namespace hysteron {

enum class Excites { what_is_recorded, force, base };

// Of auto, force, base; InputError for another word.
Excites excites_of(const std::string& word);

}  // namespace hysteron
