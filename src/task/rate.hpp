// Recordings without a time column, for laws whose force depends on the order of the displacements and not on their
// rate.
#pragma once

#include <string>
#include <vector>

#include "core/message.hpp"
#include "core/recording.hpp"
#include "simulate/composite.hpp"

namespace hysteron {

// A force of parameters none of which has time in its unit cannot tell one rate from another: there is nothing to set
// the rate against. Throws InputError where a recording has no time and a parameter with time in its unit may differ
// from 0 (may_act, one a parameter), or laws follow the frequency. `advice` ends the message.
void require_no_rate(const CompositeModel& model, const std::vector<bool>& may_act, bool follows_frequency,
                     const std::vector<Recording>& recordings, const Message& advice);

}  // namespace hysteron
