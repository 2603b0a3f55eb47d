// Which of many starts descents begin at.
#pragma once

#include <cstddef>
#include <vector>

namespace hysteron {

// So many of `sorted`, points of the unit box, best first: the best, then the best that is half of the box away from
// each one taken in a coordinate that is not projected out, while there is such a one, then the best of the rest.
// Beyond a sign or a pole of a shape lies another valley, which the first starts, neighbours of one another, may all
// miss. `projected` says which coordinates are projected out.
std::vector<std::vector<double>> in_several_valleys(std::vector<std::vector<double>> sorted,
                                                    const std::vector<bool>& projected, std::size_t most);

}  // namespace hysteron
