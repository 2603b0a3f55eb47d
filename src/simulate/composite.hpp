// A damper law with the effects put behind it, composed at run time.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "simulate/motion.hpp"
#include "simulate/part.hpp"

namespace hysteron {

// A law and the effects behind it.
inline constexpr std::size_t max_links = 9;

// A part in its place: where its own parameters and states begin among those of the model.
struct Link {
  const Part* part;
  std::size_t parameter;
  int state;
};

struct CompositeModel {
  const Part* law = nullptr;
  std::vector<const Part*> effects;  // nearest to the law first

  // Hands every Link to `take`, the law first, then the effects from it outwards.
  template <class Take>
  void for_links(Take&& take) const {
    Link link{law, 0, 0};
    take(link);
    for (const Part* effect : effects) {
      link = {effect, link.parameter + link.part->parameters.size(), link.state + link.part->states};
      take(link);
    }
  }
  // Parameters of the law, then of the effects in order; effect parameters are named "effect-id.name".
  [[nodiscard]] std::vector<Parameter> parameters() const;
  [[nodiscard]] std::vector<std::string> parameter_names() const;
  [[nodiscard]] std::size_t parameter_count() const;
  [[nodiscard]] int states() const;
  // Holds a series element or a rate that needs the force: each step of a march solves for the balance of forces.
  [[nodiscard]] bool balances() const;
  // Whether march takes WideLanes.
  [[nodiscard]] bool has_wide_march() const { return wide_lanes_pay && !balances(); }

  // States at the start of a recording, from the parameters there: zero but for what earlier recordings left.
  template <class T>
  void begin(const T* p, std::span<const EarlierWork> earlier, T* state) const {
    for_links([&](const Link& link) {
      std::fill_n(state + link.state, link.part->states, T(0.0));
      if (const auto begin = link.part->on<T>().begin; begin != nullptr && !earlier.empty()) {
        begin(p + link.parameter, earlier, state + link.state);
      }
    });
  }
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
