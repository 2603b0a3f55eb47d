// Adding what the data ask for.
#pragma once

#include <vector>

#include "diagnose/search/course.hpp"

namespace hysteron {

// Adds the best candidate while one is worth a place, predicts recordings left out better, and more than noise is left.
void grow(Course& course, const std::vector<Extension>& effects, int most_effects, const SearchProgress& progress);

}  // namespace hysteron
