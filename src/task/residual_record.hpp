// What records say of what a model leaves over.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "compare/criteria.hpp"
#include "core/recording.hpp"
#include "fit/score.hpp"

namespace hysteron {

// Measured less simulated force, over the normaliser of the recording.
std::vector<double> normalised_residual(const Recording& recording, const std::vector<double>& force,
                                        Normalisation normalisation);

// `samples`, `autocorrelation` from lag 1 on, `lags_outside` what white noise keeps within, `histogram`.
nlohmann::json residual_json(const ResidualFacts& facts);

// The same of one fit, with its own effective sample size and the criteria from it.
nlohmann::json residual_json(const ResidualFacts& facts, std::size_t free_parameters);

}  // namespace hysteron
