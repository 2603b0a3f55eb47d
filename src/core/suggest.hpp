// "did you mean": the nearest known word for a mistyped one, without regard to case.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace hysteron {

// The first of the known words that take the fewest letters to insert, drop, replace or exchange with their neighbour,
// at most so many; empty when none is near.
std::string_view nearest(std::string_view word, const std::vector<std::string>& known, std::size_t most);

// " (did you mean 'x'?)" or empty when nothing is near: up to half of the letters off, or else the shortest known word
// that begins with this one.
std::string suggestion(std::string_view word, const std::vector<std::string>& known);

}  // namespace hysteron
