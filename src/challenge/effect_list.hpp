// What the lists of hidden effects are written with, and the lists.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "challenge/draws.hpp"
#include "challenge/effects.hpp"

namespace hysteron::challenge {

using Effects = std::vector<HiddenEffect>;

inline const std::vector<Law> all_laws = {Law::bouc_wen, Law::modified_bouc_wen, Law::tanh_hysteresis, Law::bingham,
                                          Law::lugre};
inline const std::vector<Law> bouc_wen_laws = {Law::bouc_wen, Law::modified_bouc_wen};
// A law without a state of its own would have to be at rest in a play for ever.
inline const std::vector<Law> series_laws = {Law::bouc_wen, Law::bingham, Law::lugre};

namespace needs {
inline constexpr Needs anything{};
inline constexpr Needs steps{.drive_steps = true, .levels = 3};
inline constexpr Needs constant{.one_level = true};
inline constexpr Needs long_runs{.long_runs = true};
inline constexpr Needs frequencies{.frequencies = 3};
inline constexpr Needs one_frequency{.one_frequency = true, .steady = true};
inline constexpr Needs small{.levels = 2, .frequencies = 2, .small_amplitudes = true};
inline constexpr Needs levels_and_frequencies{.levels = 3, .frequencies = 3};
}  // namespace needs

template <class Form, class... Values>
PartPointer part(Values... values) {
  return std::make_shared<const Form>(values...);
}

// A form that acts beside the damper or in it; one in series.
template <class Make>
HiddenForm form(std::string id, std::string_view words, Make make) {
  return {std::move(id), words, InSeries::none, make};
}
template <class Make>
HiddenForm in_series(std::string id, std::string_view words, InSeries chain, Make make, std::string_view also = {}) {
  return {std::move(id), words, chain, make, also};
}

inline double knee_of(const Device& d) { return std::clamp(4e-3 * d.amplitude, 2e-5, 1.2e-4); }
inline double film_of(const Device& d, Draws& shape) { return d.speed * shape.log_uniform(4e-3, 4e-2); }
inline double stribeck_speed(const Device& d, Draws& shape) {
  return std::clamp(d.speed * shape.log_uniform(0.02, 0.12), 3e-3, 5e-2);
}

inline std::vector<double> scatter_of(Draws& shape, double size) {
  std::vector<double> values;
  values.reserve(16);
  for (int k = 0; k < 16; ++k) values.push_back(size * shape.normal());
  return values;
}

// Each adds to the list, in the order in which effects are listed.
void add_parallel(Effects& list);
void add_fluid(Effects& list);
void add_slow(Effects& list);
void add_series(Effects& list);
void add_electric(Effects& list);
void add_chain(Effects& list);
void add_foreign(Effects& list);

}  // namespace hysteron::challenge
