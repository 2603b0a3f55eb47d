// Which signature contrast speaks for an effect: the choice that a probability is computed from and a reader is shown.
#pragma once

#include <optional>
#include <string>

#include "diagnose/judge/evidence.hpp"

namespace hysteron {

struct Speaking {
  const Signature* signature = nullptr;  // of the evidence
  double z = 0.0;                        // in the sense that the effect has; not below 0
};

// The one with the largest z in the effect's sense of those that speak for it. Nothing where none could be taken.
std::optional<Speaking> speaking_for(const std::string& effect, const std::vector<Signature>& signatures);
// Likewise for a candidate, of what is left without it.
std::optional<Speaking> speaking_for(const Candidate& candidate);

// z of a contrast in the effect's sense: not below 0.
double z_for(const std::string& effect, const Signature& signature);

// z of a contrast in the sense that suits it best of those of the effects it speaks for.
double loudness(const Signature& signature);

// Beyond 95 % of the placebos.
bool beyond_placebos(const Speaking& speaking);

// Two standard errors in the effect's sense, and beyond 95 % of the placebos: enough to be seen by itself.
bool shows(const Speaking& speaking);

// Shows, by three standard errors: what noise and the misfit of a bare law do not do (docs/contrasts.md).
bool speaks(const Speaking& speaking);

// Whether a contrast that speaks for the candidate, and that the augmented model explains, speaks on where `instead`
// takes the candidate's place (ContrastLeft): in its own form it explains the squares, not what the candidate does.
bool leaves_the_contrast(const Candidate& candidate, const std::string& instead, bool law, const Evidence& evidence);

// Of the effects and laws that were set in the candidate's place, laws that have it as a part of their own apart.
struct InItsPlace {
  std::size_t tried = 0;
  std::size_t leave_the_contrast = 0;
};
InItsPlace in_its_place(const Candidate& candidate, const Evidence& evidence);

}  // namespace hysteron
