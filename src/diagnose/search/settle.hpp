// What of a grown model keeps its place.
#pragma once

#include <vector>

#include "diagnose/search/course.hpp"
#include "diagnose/search/found.hpp"

namespace hysteron {

// Drops what stopped helping, sets each part against its rivals and takes a rival that does clearly better, until
// nothing changes; then fits the model to the finer samples, and takes out what these do not confirm. The model there;
// `found` are its parts. `fine_base` is the base on the finer samples.
Fit confirmed(Course& course, const Workbench& fine, const Fit& fine_base, const std::vector<Extension>& candidates,
              const SearchProgress& progress, std::vector<Found>& found);

}  // namespace hysteron
