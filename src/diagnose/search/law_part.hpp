// Parts that a damper law has of its own and the law whose place it takes lacks, as effects of the model that is
// reported: the law with what was found behind it against what is left of it without the part, with the same.
#pragma once

#include "diagnose/search/search.hpp"

namespace hysteron {

// Adds to `behind_law.found` each part that the law has and the law asked for lacks, where its card says which law is
// left without it, with what was set in its place. `asked` is the search behind the law whose place is taken; that need
// not be the law that is left.
void take_parts_of_law(Search& behind_law, const Search& asked, const Workbench& quick, const SearchOptions& options,
                       const SearchProgress& progress);

}  // namespace hysteron
