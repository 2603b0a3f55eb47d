// Recordings as Python holds them.
#pragma once

#include <pybind11/pybind11.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/recording.hpp"
#include "io/channels.hpp"

namespace hysteron::python {

using RecordingPointer = std::shared_ptr<Recording>;

// What Python says of a campaign: its recordings and their roles ("", "fit", "validate").
Campaign campaign_of(const std::vector<std::pair<RecordingPointer, std::string>>& recordings);

// Numbers of what laws follow, of words like "2.1 bar"; InputError for another word.
std::map<std::string, ConditionNumber> numbers_of(const std::map<std::string, std::string>& at);

void add_recordings(pybind11::module_& module);

}  // namespace hysteron::python
