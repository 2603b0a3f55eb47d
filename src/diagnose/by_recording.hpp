// How each recording by itself would change the parameters of a damper law that was fitted to all of them.
#pragma once

#include <cstddef>
#include <vector>

#include "diagnose/residual/partition.hpp"
#include "diagnose/search/workbench.hpp"

namespace hysteron {

// A parameter of the damper law by which recordings may differ.
struct Handle {
  std::size_t parameter;
  bool factor;  // of its whole law in the drive; else a number that is added to it
};

std::vector<Handle> handles_of(const Fit& fit);

// The fit with one of them changed: by this part of its law, or this much.
Fit moved(const Fit& fit, const Handle& handle, double step);

// What each fitted recording of the bench leaves over the handles, to first order, which is exact for parameters that
// the force is affine in.
std::vector<Quadratic> quadratics_of(const Workbench& bench, const Fit& fit, const std::vector<Handle>& handles);

bool finite(const std::vector<Quadratic>& quadratics);

struct ByRecording {
  Fit joint;  // to all recordings of the bench
  std::vector<Handle> handles;
  std::vector<Quadratic> quadratics;  // of each recording

  // Whether there is anything to change, and every change is a number.
  [[nodiscard]] bool told() const { return !handles.empty() && finite(quadratics); }
};

constexpr int descent_rounds = 10;  // of a fit to all recordings, or to a group of them

// A parameter counts as different between recordings where this part of what its changes take off comes back without.
constexpr double least_difference = 0.1;

ByRecording by_recording(const Workbench& bench, const Fit& base);

}  // namespace hysteron
