// Parameters against time, as a solver that follows the data in time order believed them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "fit/driver.hpp"
#include "fit/layout.hpp"

namespace hysteron {

// `recordings`: those the solver followed, in its order. Thinned to at most 400 instants; `time` in s runs on over the
// recordings; bands are mean +- 2 standard deviations of the unit coordinate, in the parameter's unit. Null for a run
// that followed nothing.
nlohmann::json track_json(const RunResult& run, const Layout& layout, const std::vector<const Recording*>& recordings);

}  // namespace hysteron
