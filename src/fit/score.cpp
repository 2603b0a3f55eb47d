#include "fit/score.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/mean.hpp"
#include "core/message.hpp"
#include "core/suggest.hpp"

namespace hysteron {

namespace {

double standard_deviation(const std::vector<double>& values) {
  const double mean = mean_of(values);
  double sum = 0.0;
  for (const double value : values) {
    sum += (value - mean) * (value - mean);
  }
  return std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace

Normalisation normalisation_of(const std::string& word) {
  if (word == "max-abs") {
    return Normalisation::max_abs;
  }
  if (word == "range") {
    return Normalisation::range;
  }
  if (word == "std") {
    return Normalisation::standard_deviation;
  }
  if (word == "mean-abs") {
    return Normalisation::mean_abs;
  }
  throw OptionError(Option::normalisation + ": unknown '" + word + "'" +
                    suggestion(word, {"max-abs", "range", "std", "mean-abs"}) +
                    ", expected max-abs, range, std or mean-abs");
}

std::string_view word_of(Normalisation normalisation) {
  switch (normalisation) {
    case Normalisation::range:
      return "range";
    case Normalisation::standard_deviation:
      return "std";
    case Normalisation::mean_abs:
      return "mean-abs";
    case Normalisation::max_abs:
      break;
  }
  return "max-abs";
}

double normaliser(const Recording& recording, Normalisation normalisation) {
  double result = 0.0;
  switch (normalisation) {
    case Normalisation::max_abs:
      for (const double force : recording.force) {
        result = std::max(result, std::fabs(force));
      }
      break;
    case Normalisation::range: {
      const auto [low, high] = std::ranges::minmax(recording.force);
      result = high - low;
      break;
    }
    case Normalisation::standard_deviation:
      result = standard_deviation(recording.force);
      break;
    case Normalisation::mean_abs:
      for (const double force : recording.force) {
        result += std::fabs(force);
      }
      result /= static_cast<double>(recording.force.size());
      break;
  }
  if (!(result > 0.0)) {
    throw InputError(recording.file, 0,
                     "the force is zero or constant throughout, expected a signal to normalise by (" +
                         std::string(word_of(normalisation)) + ")");
  }
  return result;
}

Score score(const std::vector<double>& predicted, const Recording& recording, Normalisation normalisation) {
  double squares = 0.0;
  for (std::size_t n = 0; n < predicted.size(); ++n) {
    const double residual = predicted[n] - recording.force[n];
    squares += residual * residual;
  }
  Score result{};
  result.rmse = std::sqrt(squares / static_cast<double>(predicted.size()));
  result.nrmse = result.rmse / normaliser(recording, normalisation);
  result.fit_percent = 100.0 * (1.0 - result.rmse / standard_deviation(recording.force));
  return result;
}

double overall(const std::vector<Score>& scores, const std::vector<const Recording*>& recordings,
               Normalisation normalisation, Weighting weighting, const std::vector<const Recording*>& normalised_by) {
  double sum = 0.0;
  double total = 0.0;
  for (std::size_t r = 0; r < scores.size(); ++r) {
    const auto samples = static_cast<double>(recordings[r]->size());
    if (weighting == Weighting::pooled) {
      sum += scores[r].rmse * scores[r].rmse * samples;
      total += samples;
    } else {
      sum += scores[r].nrmse * scores[r].nrmse;
      total += 1.0;
    }
  }
  double largest = 0.0;
  if (weighting == Weighting::pooled) {
    for (const Recording* one : normalised_by.empty() ? recordings : normalised_by) {
      largest = std::max(largest, normaliser(*one, normalisation));
    }
  }
  return std::sqrt(sum / total) / (weighting == Weighting::pooled ? largest : 1.0);
}

}  // namespace hysteron
