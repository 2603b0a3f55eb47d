#include "study/ranks.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace hysteron {
namespace {

constexpr std::size_t exact_up_to = 50;

// Distribution of the sum of a random subset of doubled ranks: probability of a sum at least as far from its mean as
// the one seen. Doubling makes midranks whole.
double exact_p(const std::vector<double>& ranks, double w_plus) {
  std::size_t total = 0;
  std::vector<double> ways{1.0};
  for (const double rank : ranks) {
    const auto step = static_cast<std::size_t>(std::lround(2.0 * rank));
    ways.resize(total + step + 1, 0.0);
    for (std::size_t sum = total + 1; sum-- > 0;) ways[sum + step] += ways[sum];
    total += step;
  }
  const double all = std::exp2(static_cast<double>(ranks.size()));
  const auto seen = static_cast<std::size_t>(std::lround(2.0 * w_plus));
  const std::size_t tail = std::min(seen, total - seen);
  double count = 0.0;
  for (std::size_t sum = 0; sum <= tail; ++sum) count += ways[sum];
  return std::min(1.0, 2.0 * count / all);
}

// Regularised lower incomplete gamma function by its series.
double gamma_series(double a, double x) {
  double term = 1.0 / a;
  double sum = term;
  for (int n = 1; n < 10000; ++n) {
    term *= x / (a + n);
    sum += term;
    if (term < sum * 1e-17) break;
  }
  return sum * std::exp(-x + a * std::log(x) - std::lgamma(a));
}

// Upper one by its continued fraction (Lentz).
double gamma_fraction(double a, double x) {
  constexpr double tiny = 1e-300;
  double b = x + 1.0 - a;
  double c = 1.0 / tiny;
  double d = 1.0 / b;
  double h = d;
  for (int n = 1; n < 10000; ++n) {
    const double an = -n * (n - a);
    b += 2.0;
    d = an * d + b;
    if (std::fabs(d) < tiny) d = tiny;
    c = b + an / c;
    if (std::fabs(c) < tiny) c = tiny;
    d = 1.0 / d;
    const double factor = d * c;
    h *= factor;
    if (std::fabs(factor - 1.0) < 1e-16) break;
  }
  return h * std::exp(-x + a * std::log(x) - std::lgamma(a));
}

// Probability that the range of k independent standard normal values is at most q.
//   P(q) = k integral phi(u) [Phi(u) - Phi(u - q)]^(k-1) du
double range_probability(double q, double k) {
  constexpr int steps = 4000;
  constexpr double low = -8.0;
  constexpr double high = 8.0;
  const double h = (high + q - low) / steps;
  double sum = 0.0;
  for (int n = 0; n <= steps; ++n) {
    const double u = low + n * h;
    const double density = std::exp(-0.5 * u * u) / std::sqrt(2.0 * std::numbers::pi);
    const double inside = std::max(0.0, normal_tail(u - q) - normal_tail(u));
    const double weight = n == 0 || n == steps ? 1.0 : (n % 2 == 1 ? 4.0 : 2.0);
    sum += weight * density * std::pow(inside, k - 1.0);
  }
  return k * sum * h / 3.0;
}

}  // namespace

double normal_tail(double value) { return 0.5 * std::erfc(value / std::numbers::sqrt2); }

double chi_squared_tail(double value, double degrees) {
  if (!(value > 0.0) || !(degrees > 0.0)) return 1.0;
  const double a = 0.5 * degrees;
  const double x = 0.5 * value;
  return x < a + 1.0 ? 1.0 - gamma_series(a, x) : gamma_fraction(a, x);
}

double nemenyi_quantile(std::size_t k) {
  if (k < 2) return 0.0;
  double low = 0.0;
  double high = 20.0;
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high);
    (range_probability(middle, static_cast<double>(k)) < 0.95 ? low : high) = middle;
  }
  return 0.5 * (low + high) / std::numbers::sqrt2;
}

SignedRank signed_rank_test(const std::vector<double>& differences, double zero) {
  SignedRank result;
  result.pairs = differences.size();
  std::vector<double> kept;
  std::vector<double> magnitude;
  for (const double difference : differences) {
    assert(!std::isnan(difference));
    if (std::fabs(difference) <= zero) {
      ++result.zeros;
      continue;
    }
    kept.push_back(difference);
    magnitude.push_back(std::fabs(difference));
  }
  const std::vector<double> ranks = midranks(magnitude);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    if (kept[k] > 0.0) result.w_plus += ranks[k];
  }
  const auto n = static_cast<double>(kept.size());
  if (kept.empty()) return result;
  if (kept.size() <= exact_up_to) {
    result.exact = true;
    result.p = exact_p(ranks, result.w_plus);
    return result;
  }
  // sum of squared ranks / 4 is the variance, ties included.
  double variance = 0.0;
  for (const double rank : ranks) variance += 0.25 * rank * rank;
  const double distance = std::max(0.0, std::fabs(result.w_plus - 0.25 * n * (n + 1.0)) - 0.5);
  result.p = std::min(1.0, 2.0 * normal_tail(distance / std::sqrt(variance)));
  return result;
}

std::size_t pairs_to_tell(std::size_t tests, double level) {
  // Of the 2^n ways in which n differences can be signed two are as far out as all of one sign.
  std::size_t pairs = 1;
  while (static_cast<double>(tests) * std::exp2(1.0 - static_cast<double>(pairs)) >= level) ++pairs;
  return pairs;
}

std::vector<double> holm(const std::vector<double>& p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
  std::vector<double> adjusted(p.size());
  double largest = 0.0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    largest = std::max(largest, std::min(1.0, static_cast<double>(p.size() - k) * p[order[k]]));
    adjusted[order[k]] = largest;
  }
  return adjusted;
}

Friedman friedman_test(const std::vector<std::vector<double>>& blocks, double tie) {
  Friedman result;
  result.blocks = blocks.size();
  if (blocks.empty()) return result;
  const std::size_t k = blocks.front().size();
  std::vector<double> sums(k, 0.0);
  double squares = 0.0;
  for (const std::vector<double>& block : blocks) {
    assert(block.size() == k);
    const std::vector<double> ranks = midranks(block, tie);
    for (std::size_t j = 0; j < k; ++j) {
      sums[j] += ranks[j];
      squares += ranks[j] * ranks[j];
    }
  }
  const auto n = static_cast<double>(blocks.size());
  const auto groups = static_cast<double>(k);
  for (const double sum : sums) result.mean_ranks.push_back(sum / n);
  if (k < 2) return result;
  // chi^2 = (k - 1) sum_j (R_j - n (k + 1) / 2)^2 / (sum r^2 - n k (k + 1)^2 / 4): Conover's form, valid with ties.
  double between = 0.0;
  for (const double sum : sums) between += (sum - 0.5 * n * (groups + 1.0)) * (sum - 0.5 * n * (groups + 1.0));
  const double within = squares - 0.25 * n * groups * (groups + 1.0) * (groups + 1.0);
  result.chi_squared = within > 0.0 ? (groups - 1.0) * between / within : 0.0;
  result.p = chi_squared_tail(result.chi_squared, groups - 1.0);
  result.critical_difference = nemenyi_quantile(k) * std::sqrt(groups * (groups + 1.0) / (6.0 * n));
  return result;
}

std::vector<std::pair<std::size_t, std::size_t>> cliques(const std::vector<double>& sorted_mean_ranks,
                                                         double critical_difference) {
  std::vector<std::pair<std::size_t, std::size_t>> result;
  std::size_t covered = 0;
  for (std::size_t first = 0; first < sorted_mean_ranks.size(); ++first) {
    std::size_t last = first;
    while (last + 1 < sorted_mean_ranks.size() &&
           sorted_mean_ranks[last + 1] - sorted_mean_ranks[first] < critical_difference) {
      ++last;
    }
    if (last > first && last + 1 > covered) {
      result.emplace_back(first, last);
      covered = last + 1;
    }
  }
  return result;
}

}  // namespace hysteron
