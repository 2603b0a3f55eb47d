// Remarks on what was done, which a command prints and a function of the Python package warns of.
#pragma once

#include <iterator>
#include <string>
#include <vector>

namespace hysteron {

inline void append(std::vector<std::string>& remarks, std::vector<std::string> more) {
  remarks.insert(remarks.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace hysteron
