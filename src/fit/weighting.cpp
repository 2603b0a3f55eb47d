#include "fit/weighting.hpp"

#include "core/error.hpp"
#include "core/message.hpp"

namespace hysteron {

Weighting weighting_of(const std::string& word) {
  if (word == "per-recording") return Weighting::per_recording;
  if (word == "pooled") return Weighting::pooled;
  throw OptionError(Option::weighting + ": unknown '" + word + "', expected per-recording or pooled");
}

std::string_view word_of(Weighting weighting) { return weighting == Weighting::pooled ? "pooled" : "per-recording"; }

}  // namespace hysteron
