// Why a solver ended without a candidate that has a cost.
#pragma once

#include <cstddef>
#include <string>

#include "fit/driver.hpp"
#include "fit/layout.hpp"

namespace hysteron {

// Throws OptionError where the budget did not allow a first evaluation, WorkError where the solver stopped before it or
// where none of them was finite.
// `stage` stands before the message with ": ", or is empty; `before` is how many of the evaluations other searches
// took.
[[noreturn]] void throw_without_candidate(const std::string& stage, const RunResult& run, const Layout& layout,
                                          const LayoutOptions& options, std::size_t before = 0);

}  // namespace hysteron
