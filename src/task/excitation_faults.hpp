// What the channel that excites a mass shows of faults: the reader judges displacement and force of a damper, and of an
// excitation neither where it is a force alone or the column of a base.
#pragma once

#include <string>
#include <vector>

#include "core/recording.hpp"
#include "io/channels.hpp"

namespace hysteron {

// Remarks on sizes, gaps, glitches and lost samples of the base or of the force, that the reader of the recording has
// not made. What is usual of an excitation is none: rests, steps, a blow from rest.
std::vector<Remark> faults_of_excitation(const Recording& recording, bool base);

// In lines, those alike once.
std::vector<std::string> told_once(const std::vector<Remark>& remarks);

// A remark where the base, or the mass under a force, which `response` tells, moves so slowly that times may be in
// another unit.
std::vector<Remark> slowness_of(const Recording& recording, const Recording& response, bool base);

}  // namespace hysteron
