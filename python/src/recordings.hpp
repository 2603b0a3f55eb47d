// Recordings as Python holds them.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/recording.hpp"

namespace hysteron::python {

using RecordingPointer = std::shared_ptr<Recording>;

// What Python says of a campaign: its recordings and their roles ("", "fit", "validate").
Campaign campaign_of(const std::vector<std::pair<RecordingPointer, std::string>>& recordings);

void add_recordings(pybind11::module_& module);

}  // namespace hysteron::python
