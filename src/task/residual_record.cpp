#include "task/residual_record.hpp"

namespace hysteron {

using nlohmann::json;

std::vector<double> normalised_residual(const Recording& recording, const std::vector<double>& force,
                                        Normalisation normalisation) {
  const double scale = normaliser(recording, normalisation);
  std::vector<double> result;
  result.reserve(recording.size());
  for (std::size_t n = 0; n < recording.size(); ++n) {
    result.push_back((recording.force[n] - force[n]) / scale);
  }
  return result;
}

json residual_json(const ResidualFacts& facts) {
  return {{"samples", facts.samples},
          {"autocorrelation", facts.autocorrelation},
          {"white_band", facts.white_band},
          {"lags_outside", facts.outside},
          {"histogram", {{"reach", histogram_reach}, {"density", facts.histogram}, {"beyond", facts.beyond}}}};
}

json residual_json(const ResidualFacts& facts, std::size_t free_parameters) {
  json result = residual_json(facts);
  const Criteria both = criteria(facts.mean_square, facts.effective_samples(), free_parameters);
  result["effective_samples"] = facts.effective_samples();
  result["free_parameters"] = free_parameters;
  result["aic"] = both.aic;
  result["bic"] = both.bic;
  return result;
}

}  // namespace hysteron
