// Partial regression over all recordings: how much of a signature is in what the base model leaves, beyond what the
// base model itself or the signature's nearest confounders would account for.
//   missing = m s + N theta,   m = (M s)' W missing / (M s)' W (M s),   M = 1 - N (N' W N)^+ N' W
// N holds what a refit of the base can absorb, so m is the size of what was there before the refit took its part
// (Frisch and Waugh 1933). W gives each recording the same weight, as the cost does. A placebo moves `missing` against
// the motion; M s stays.
#pragma once

#include <functional>

#include "diagnose/residual/contrast_parts.hpp"

namespace hysteron::contrast {

class Panel {
 public:
  using Column = std::size_t;
  using Value = std::function<double(const Track& track, std::size_t sample)>;

  // Samples in motion, holds left out; long recordings by means of neighbouring samples. `response` is what is
  // explained.
  Panel(std::span<const Track> tracks, Values Track::*response, std::size_t placebos);

  Column add(const Value& value);
  // Less what the columns `without` explain of it in each recording by itself.
  Column add_within(const Value& value, std::span<const Column> without);

  enum class Null {
    shift,  // the response is shifted in time
    flip,   // it changes its sign, by recordings where seven or more share the weight, else by half-cycles
  };
  // Of the signatures the one that explains most, which placebos choose for themselves too. Empty where the others
  // leave nothing of it, or no motion is there.
  [[nodiscard]] std::optional<Contrast> partial(ContrastKind kind, std::span<const Column> signatures,
                                                std::span<const Column> without, Null null = Null::shift) const;

  [[nodiscard]] bool empty() const { return response_.empty(); }

 private:
  [[nodiscard]] Values built(const Value& value) const;
  [[nodiscard]] double product(const Values& a, const Values& b) const;
  Column keep(Values values);
  // Weights theta of the columns `by` that explain most of what has these products with them.
  [[nodiscard]] Values weights_of(std::span<const Column> by, const Values& products) const;
  struct Left;
  [[nodiscard]] Left left_of(Column signature, std::span<const Column> without) const;

  std::span<const Track> tracks_;
  std::size_t placebos_;
  std::vector<std::vector<std::size_t>> samples_;  // of each track, those that count
  std::vector<std::size_t> width_;                 // of each track, samples to a row
  std::vector<Stretch> rows_;                      // of each track
  std::vector<double> period_;                     // of each track, in rows
  Values weight_;
  Values response_;
  std::vector<std::size_t> block_;  // half-cycle of each row
  std::vector<Values> columns_;
  std::vector<Values> products_;  // of each column with those before and itself
  Values with_response_;
};

}  // namespace hysteron::contrast
