// The force of a published parameter set on the motion of a recording: `hysteron simulate --preset`.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/recording.hpp"
#include "presets/preset.hpp"

namespace hysteron {

// InputError, which offers the nearest, for another word.
const Preset& preset_called(const std::string& id);

// Force in N; of the recording's own only how it begins is looked at. `quantities` are values by name in the unit that
// the source prints, of those that it does not print or that are to differ; `drive` (A or V) takes the place of the
// recording's, NaN for that. `remarks` are of a drive beyond the source's experiments. Throws InputError for a quantity
// that the preset has not or that is missing, and where the drive is missing or of the other kind, WorkError where the
// simulation does not stay finite.
std::vector<double> force_of_preset(const Preset& preset, const std::map<std::string, double>& quantities, double drive,
                                    Recording recording, double tolerance, std::vector<std::string>& remarks);

}  // namespace hysteron
