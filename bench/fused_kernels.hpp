// Kernels written by hand for one law each, as the limit that the general march is measured against: classical
// Runge-Kutta with one step a sample, nothing done for kinks, stiffness, drives, or times that are not evenly spaced.
#pragma once

#include <string_view>
#include <vector>

#include "scalar/lanes.hpp"
#include "simulate/motion.hpp"

namespace hysteron::bench {

// What the kernels take from a motion: velocities at the samples and half-way, displacements at the samples.
struct PlainMotion {
  double step = 0.0;           // s
  std::vector<double> x;       // m
  std::vector<double> v;       // m/s
  std::vector<double> middle;  // m/s, between a sample and the next

  explicit PlainMotion(const Motion& motion);
};

// Forces in N of packs of candidates. p holds the packs' parameters in the order of the law's card, one pack after the
// other, out the packs' forces at a sample beside each other. Knees of n = 1 have a kernel of their own.
inline constexpr int most_packs = 2;
using FusedKernel = void (*)(const PlainMotion& motion, const Lanes* p, Lanes* out);
// Marches `packs` (1 or 2) packs at a time; nullptr for a law without such a kernel.
FusedKernel fused_kernel(std::string_view law, bool knee_of_one, int packs);

}  // namespace hysteron::bench
