// A damper law with the effects put behind it, composed at run time.
#pragma once

#include <string>
#include <vector>

#include "simulate/motion.hpp"
#include "simulate/part.hpp"

namespace hysteron {

struct CompositeModel {
  const Part* law = nullptr;
  std::vector<const Part*> effects;  // nearest to the law first

  // Parameters of the law, then of the effects in order; effect parameters are named "effect-id.name".
  [[nodiscard]] std::vector<Parameter> parameters() const;
  [[nodiscard]] std::vector<std::string> parameter_names() const;
  [[nodiscard]] std::size_t parameter_count() const;
  [[nodiscard]] int states() const;

  // As PartOperations::march, over the whole chain.
  template <class T>
  void march(const Motion& motion, const T* p, std::size_t stride, std::size_t begin, std::size_t end, T* state,
             T* out) const;
};

// Throws InputError naming the unknown id and the nearest known ones.
CompositeModel make_model(std::string_view law, const std::vector<std::string>& effects);

// Force in N of one parameter set at every sample, from rest (all states zero).
std::vector<double> simulate(const CompositeModel& model, const Motion& motion, const std::vector<double>& parameters);

}  // namespace hysteron
