// Where a hidden change of force sits: how its energy spreads over the variables in which places of a misfit are told.
// What since a reversal or a step of the drive means is written here once more, as all of a challenge is: a mistake of
// the diagnosis must not judge itself.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "challenge/absorption.hpp"
#include "challenge/chain.hpp"

namespace hysteron::challenge {

// For every variable of the contract's `locations` that the recordings have, the ends of its classes in SI units and
// the shares of samples and of squared change in each: {"speed": {"edges":[..], "samples":[..], "energy":[..]}, ...}.
// `left` is the change in N that a re-fit of the law does not take up; each recording weighs 1 / peak.
[[nodiscard]] nlohmann::json places_of(const std::vector<Measured>& recordings, const Forces& left,
                                       const std::vector<double>& peaks);

// Share of the squared change over the share of the samples in [from, to] of a variable; 0 where there are no samples,
// and for a variable that `places` does not hold.
[[nodiscard]] double concentration(const nlohmann::json& places, const std::string& variable, double from, double to);

}  // namespace hysteron::challenge
