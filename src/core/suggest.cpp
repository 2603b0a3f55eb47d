#include "core/suggest.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/lower_case.hpp"

namespace hysteron {
namespace {

// Letters to insert, drop, replace or exchange with their neighbour (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> two_up;
  std::vector<std::size_t> above(b.size() + 1);
  std::iota(above.begin(), above.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::vector<std::size_t> row(b.size() + 1, i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], two_up[j - 2] + 1);
      }
    }
    two_up = std::exchange(above, std::move(row));
  }
  return above.back();
}

}  // namespace

std::string_view nearest(std::string_view word, const std::vector<std::string>& known, std::size_t most) {
  const std::string typed = lower_case(word);
  // Of words that differ in case alone the one that is written alike.
  std::pair best{most + 1, std::size_t{0}};
  std::string_view result;
  for (const std::string& candidate : known) {
    const std::size_t distance = edit_distance(typed, lower_case(candidate));
    if (distance > std::min(most, best.first)) continue;
    const std::pair here{distance, edit_distance(word, candidate)};
    if (here < best) {
      best = here;
      result = candidate;
    }
  }
  return result;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& known) {
  if (word.empty()) return {};
  std::string_view found = nearest(word, known, word.size() / 2);
  if (found.empty()) {
    const std::string typed = lower_case(word);
    for (const std::string& candidate : known) {
      if (lower_case(candidate).starts_with(typed) && (found.empty() || candidate.size() < found.size())) {
        found = candidate;
      }
    }
  }
  return found.empty() ? std::string{} : " (did you mean '" + std::string(found) + "'?)";
}

}  // namespace hysteron
