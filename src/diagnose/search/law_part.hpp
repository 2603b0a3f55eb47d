// Parts that a damper law has of its own and the law whose place it takes lacks, as effects of the model that is
// reported: the law with what was found behind it against the other one with the same.
#pragma once

#include "diagnose/search/search.hpp"

namespace hysteron {

// Adds to `behind_law.found` each part by which the two laws differ, where that is all they differ by, with what was
// set in its place. `asked` is the search behind the law whose place is taken.
void take_parts_of_law(Search& behind_law, const Search& asked, const Workbench& quick, const SearchOptions& options,
                       const SearchProgress& progress);

}  // namespace hysteron
