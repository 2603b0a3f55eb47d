// The equations of a part on the recording scalar (scalar/trace.hpp): what PartOperations holds but for the march, and
// what the march of a part alone takes from the part besides.
#pragma once

#include "scalar/trace.hpp"
#include "simulate/part.hpp"

namespace hysteron {

struct TracedPart : PartOperations<Trace> {
  // What drives the state that settles; nullptr where none does.
  Trace (*towards)(const Trace* p, const Trace* s, const Input<Trace>& in) = nullptr;
  Trace (*stiffness_near)(const Trace* p, const Trace* s, const Trace& v, double speed, double change) = nullptr;
};

}  // namespace hysteron
