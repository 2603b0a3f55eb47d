// model.json. What is taken can be simulated: every parameter of the model has a term, and all numbers are finite.
#include <algorithm>
#include <cmath>

#include "target.hpp"
#include "task/model_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hysteron;
  StoredModel stored;
  if (!fuzz::taken([&] { stored = parse_model(fuzz::text_of(data, size), "model.json"); })) return 0;
  const std::size_t count = stored.model.parameter_names().size();
  for (std::size_t k = 0; k < count; ++k) {
    fuzz::require(std::ranges::any_of(stored.terms, [&](const Term& term) { return term.parameter == k; }),
                  "every parameter has a term");
  }
  for (const Term& term : stored.terms) {
    fuzz::require(term.parameter < count && std::isfinite(term.value), "terms are finite and of a parameter");
  }
  return 0;
}
