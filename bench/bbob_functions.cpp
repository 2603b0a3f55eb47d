#include "bench/bbob_functions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>

#include "core/error.hpp"

namespace hysteron::bbob {
namespace {

using Vector = std::vector<double>;
constexpr double pi = std::numbers::pi;

// ---- random draws of an instance

// Park and Miller's minimal standard generator behind a table of 32 that shuffles.
Vector uniform(std::size_t count, long seed) {
  const auto next = [](long state) {
    const long high = state / 127773;
    const long result = 16807 * (state - high * 127773) - 2836 * high;
    return result < 0 ? result + 2147483647 : result;
  };
  long state = std::max(1L, std::labs(seed));
  std::array<long, 32> table{};
  for (int k = 39; k >= 0; --k) {
    state = next(state);
    if (k < 32) table[static_cast<std::size_t>(k)] = state;
  }
  long drawn = table[0];
  Vector result;
  for (std::size_t k = 0; k < count; ++k) {
    state = next(state);
    const auto slot = static_cast<std::size_t>(drawn / 67108865);
    drawn = table[slot];
    table[slot] = state;
    result.push_back(drawn == 0 ? 1e-99 : static_cast<double>(drawn) / 2.147483647e9);
  }
  return result;
}

Vector normal(std::size_t count, long seed) {
  const Vector u = uniform(2 * count, seed);
  Vector result;
  for (std::size_t k = 0; k < count; ++k) {
    const double g = std::sqrt(-2.0 * std::log(u[k])) * std::cos(2.0 * pi * u[count + k]);
    result.push_back(g == 0.0 ? 1e-99 : g);
  }
  return result;
}

// The draws of an instance start from the function's number but for two that share those of another.
long seed_of(int function, int instance) {
  const long own = function == 4 ? 3 : function == 18 ? 17 : function;
  return own + 10000L * instance;
}

double optimum_of(int function, int instance) {
  const long seed = seed_of(function, instance);
  const double ratio = normal(1, seed)[0] / normal(1, seed + 1)[0];
  return std::clamp(std::floor(100.0 * 100.0 * ratio + 0.5) / 100.0, -1000.0, 1000.0);
}

// ---- transformations

double share(std::size_t k, std::size_t n) { return static_cast<double>(k) / static_cast<double>(n - 1); }

double oscillated(double x) {
  if (x == 0.0) return 0.0;
  const double log = std::log(std::fabs(x));
  const double a = x > 0.0 ? 10.0 : 5.5;
  const double b = x > 0.0 ? 7.9 : 3.1;
  return std::copysign(std::exp(log + 0.049 * (std::sin(a * log) + std::sin(b * log))), x);
}
Vector oscillated(Vector x) {
  for (double& v : x) v = oscillated(v);
  return x;
}
Vector skewed(Vector x, double beta) {
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (x[k] > 0.0) x[k] = std::pow(x[k], 1.0 + beta * share(k, x.size()) * std::sqrt(x[k]));
  }
  return x;
}
Vector stretched(Vector x, double condition) {
  for (std::size_t k = 0; k < x.size(); ++k) x[k] *= std::pow(condition, 0.5 * share(k, x.size()));
  return x;
}
double penalty(const Vector& x) {
  double sum = 0.0;
  for (const double v : x) {
    const double beyond = std::max(0.0, std::fabs(v) - half_side);
    sum += beyond * beyond;
  }
  return sum;
}
double squares(const Vector& x) { return std::inner_product(x.begin(), x.end(), x.begin(), 0.0); }

// ---- shapes

double ellipsoid(const Vector& z) {
  double sum = 0.0;
  for (std::size_t k = 0; k < z.size(); ++k) sum += std::pow(1e6, share(k, z.size())) * z[k] * z[k];
  return sum;
}
double rastrigin(const Vector& z) {
  double sum = 10.0 * static_cast<double>(z.size());
  for (const double v : z) sum += v * v - 10.0 * std::cos(2.0 * pi * v);
  return sum;
}
// Of neighbouring coordinates: 100 (a^2 - b)^2 + (a - 1)^2.
double rosenbrock_term(double a, double b) { return 100.0 * (a * a - b) * (a * a - b) + (a - 1.0) * (a - 1.0); }
double rosenbrock_scale(std::size_t n) { return std::max(1.0, std::sqrt(static_cast<double>(n)) / 8.0); }

constexpr double schwefel_place = 4.2096874633;

}  // namespace

Vector Function::Matrix::times(const Vector& x) const {
  Vector result(size, 0.0);
  for (std::size_t row = 0; row < size; ++row) {
    for (std::size_t column = 0; column < size; ++column) result[row] += at(row, column) * x[column];
  }
  return result;
}

// Normal draws, column by column made orthogonal to those before.
Function::Matrix Function::rotation(long seed, std::size_t dimension) {
  const Vector draws = normal(dimension * dimension, seed);
  Matrix result{dimension, Vector(dimension * dimension)};
  const auto at = [&](std::size_t row, std::size_t column) -> double& {
    return result.value[row * dimension + column];
  };
  for (std::size_t row = 0; row < dimension; ++row) {
    for (std::size_t column = 0; column < dimension; ++column) at(row, column) = draws[column * dimension + row];
  }
  for (std::size_t column = 0; column < dimension; ++column) {
    for (std::size_t before = 0; before < column; ++before) {
      double product = 0.0;
      for (std::size_t row = 0; row < dimension; ++row) product += at(row, column) * at(row, before);
      for (std::size_t row = 0; row < dimension; ++row) at(row, column) -= product * at(row, before);
    }
    double length = 0.0;
    for (std::size_t row = 0; row < dimension; ++row) length += at(row, column) * at(row, column);
    for (std::size_t row = 0; row < dimension; ++row) at(row, column) /= std::sqrt(length);
  }
  return result;
}

Function::Matrix Function::conditioned(const Matrix& r, const Matrix& q, double condition) {
  const std::size_t n = r.size;
  Matrix result{n, Vector(n * n, 0.0)};
  for (std::size_t row = 0; row < n; ++row) {
    for (std::size_t column = 0; column < n; ++column) {
      for (std::size_t k = 0; k < n; ++k) {
        result.value[row * n + column] += r.at(row, k) * std::pow(condition, 0.5 * share(k, n)) * q.at(k, column);
      }
    }
  }
  return result;
}

void Function::place_optimum(long seed) {
  x_opt_.clear();
  for (const double u : uniform(dimension_, seed)) {
    const double x = 8.0 * std::floor(1e4 * u) / 1e4 - 4.0;
    x_opt_.push_back(x == 0.0 ? -1e-5 : x);
  }
}

// Gaussian peaks: the highest, 10, has its own condition, the others 1.1 to 9.1 and conditions from 1 to 1000.
void Function::place_peaks(long seed, std::size_t count) {
  const auto order = [](const Vector& draws) {
    std::vector<std::size_t> result(draws.size());
    std::iota(result.begin(), result.end(), std::size_t{0});
    std::ranges::stable_sort(result, {}, [&](std::size_t k) { return draws[k]; });
    return result;
  };
  const bool many = count > 21;
  const double width = many ? 10.0 : 9.8;
  const std::vector<std::size_t> conditions = order(uniform(count - 1, seed));
  for (std::size_t peak = 0; peak < count; ++peak) {
    const auto others = static_cast<double>(count - 2);
    const double condition = peak > 0 ? std::pow(1000.0, static_cast<double>(conditions[peak - 1]) / others)
                             : many   ? std::sqrt(1000.0)
                                      : 1000.0;
    peaks_.height.push_back(peak == 0 ? 10.0 : 1.1 + 8.0 * static_cast<double>(peak - 1) / others);
    Vector scale(dimension_);
    const std::vector<std::size_t> axes = order(uniform(dimension_, seed + 1000L * static_cast<long>(peak)));
    for (std::size_t k = 0; k < dimension_; ++k) scale[k] = std::pow(condition, share(axes[k], dimension_) - 0.5);
    peaks_.scale.push_back(std::move(scale));
  }
  const Vector places = uniform(dimension_ * count, seed);
  for (std::size_t peak = 0; peak < count; ++peak) {
    Vector place(dimension_);
    for (std::size_t k = 0; k < dimension_; ++k) {
      place[k] = (peak == 0 ? 0.8 : 1.0) * width * (places[peak * dimension_ + k] - 0.5);
    }
    if (peak == 0) x_opt_ = place;
    peaks_.place.push_back(r_.times(place));
  }
}

Function::Function(int number, std::size_t dimension, int instance)
    : number_(number), dimension_(dimension), instance_(instance), f_opt_(0.0) {
  if (number < 1 || number > function_count || dimension < 2 || instance < 1) {
    throw InputError("BBOB function " + std::to_string(number) + " in dimension " + std::to_string(dimension) +
                     ", instance " + std::to_string(instance) + ": expected 1 to 24, from 2 on, from 1 on");
  }
  f_opt_ = optimum_of(number, instance);
  const long seed = seed_of(number, instance);
  place_optimum(number == 12 ? seed + 1000000 : seed);
  // Two rotations; functions with one use one of these two.
  r_ = rotation(number == 9 || number == 19 || number == 21 || number == 22 ? seed : seed + 1000000, dimension);
  q_ = rotation(seed, dimension);
  best_ = x_opt_;
  switch (number) {
    case 4:
      for (std::size_t k = 0; k < dimension; k += 2) x_opt_[k] = std::fabs(x_opt_[k]);
      best_ = x_opt_;
      break;
    case 5:
      for (double& x : x_opt_) x = std::copysign(half_side, x);
      best_ = x_opt_;
      break;
    case 6:
    case 13:
    case 15:
      m_ = conditioned(r_, q_, 10.0);
      break;
    case 8:
      for (double& x : x_opt_) x *= 0.75;
      best_ = x_opt_;
      break;
    case 9:
    case 19: {
      // z = scale R x + 1/2 is 1 there.
      for (std::size_t k = 0; k < dimension; ++k) {
        best_[k] = 0.0;
        for (std::size_t row = 0; row < dimension; ++row) best_[k] += 0.5 * r_.at(row, k) / rosenbrock_scale(dimension);
      }
      break;
    }
    case 16:
      m_ = conditioned(r_, q_, 0.01);
      break;
    case 20: {
      const Vector u = uniform(dimension, seed);
      for (std::size_t k = 0; k < dimension; ++k) x_opt_[k] = (u[k] < 0.5 ? -0.5 : 0.5) * schwefel_place;
      best_ = x_opt_;
      break;
    }
    case 21:
    case 22:
      place_peaks(seed, number == 21 ? 101 : 21);
      best_ = x_opt_;
      break;
    case 23:
      m_ = conditioned(r_, q_, 100.0);
      break;
    case 24: {
      const Vector g = normal(dimension, seed);
      for (std::size_t k = 0; k < dimension; ++k) x_opt_[k] = g[k] < 0.0 ? -1.25 : 1.25;
      best_ = x_opt_;
      m_ = conditioned(r_, q_, 100.0);
      break;
    }
    default:
      break;
  }
}

Vector Function::shifted(const Vector& x) const {
  Vector result(dimension_);
  for (std::size_t k = 0; k < dimension_; ++k) result[k] = x[k] - x_opt_[k];
  return result;
}

double Function::operator()(const Vector& x) const { return value_of(x) + f_opt_; }

double Function::value_of(const Vector& x) const {
  const std::size_t n = dimension_;
  const auto count = static_cast<double>(n);
  switch (number_) {
    case 1:  // sphere
      return squares(shifted(x));
    case 2:  // separable ellipsoid
      return ellipsoid(oscillated(shifted(x)));
    case 3:  // separable Rastrigin
      return rastrigin(stretched(skewed(oscillated(shifted(x)), 0.2), 10.0));
    case 4: {  // Bueche-Rastrigin
      Vector z = oscillated(shifted(x));
      for (std::size_t k = 0; k < n; ++k) {
        z[k] *= std::pow(10.0, 0.5 * share(k, n)) * (k % 2 == 0 && z[k] > 0.0 ? 10.0 : 1.0);
      }
      return rastrigin(z) + 100.0 * penalty(x);
    }
    case 5: {  // linear slope
      double sum = 0.0;
      for (std::size_t k = 0; k < n; ++k) {
        const double slope = std::copysign(std::pow(10.0, share(k, n)), x_opt_[k]);
        const double z = x_opt_[k] * x[k] < half_side * half_side ? x[k] : x_opt_[k];
        sum += half_side * std::fabs(slope) - slope * z;
      }
      return sum;
    }
    case 6: {  // attractive sector
      const Vector z = m_.times(shifted(x));
      double sum = 0.0;
      for (std::size_t k = 0; k < n; ++k) {
        const double s = z[k] * x_opt_[k] > 0.0 ? 100.0 * z[k] : z[k];
        sum += s * s;
      }
      return std::pow(oscillated(sum), 0.9);
    }
    case 7: {  // step ellipsoid
      const Vector slanted = stretched(q_.times(shifted(x)), 10.0);
      Vector stepped(n);
      for (std::size_t k = 0; k < n; ++k) {
        stepped[k] =
            std::fabs(slanted[k]) > 0.5 ? std::floor(slanted[k] + 0.5) : std::floor(10.0 * slanted[k] + 0.5) / 10.0;
      }
      const Vector z = r_.times(stepped);
      double sum = 0.0;
      for (std::size_t k = 0; k < n; ++k) sum += std::pow(100.0, share(k, n)) * z[k] * z[k];
      return 0.1 * std::max(1e-4 * std::fabs(slanted[0]), sum) + penalty(x);
    }
    case 8:     // Rosenbrock
    case 9:     // the same, rotated
    case 19: {  // Griewank over Rosenbrock
      Vector z = number_ == 8 ? shifted(x) : r_.times(x);
      for (double& v : z) v = rosenbrock_scale(n) * v + (number_ == 8 ? 1.0 : 0.5);
      double sum = 0.0;
      for (std::size_t k = 0; k + 1 < n; ++k) {
        const double term = rosenbrock_term(z[k], z[k + 1]);
        sum += number_ == 19 ? term / 4000.0 - std::cos(term) : term;
      }
      return number_ == 19 ? 10.0 + 10.0 * sum / (count - 1.0) : sum;
    }
    case 10:  // ellipsoid
      return ellipsoid(oscillated(r_.times(shifted(x))));
    case 11: {  // discus
      const Vector z = oscillated(r_.times(shifted(x)));
      return squares(z) + (1e6 - 1.0) * z[0] * z[0];
    }
    case 12: {  // bent cigar
      const Vector z = r_.times(skewed(r_.times(shifted(x)), 0.5));
      return z[0] * z[0] + 1e6 * (squares(z) - z[0] * z[0]);
    }
    case 13: {  // sharp ridge
      const Vector z = m_.times(shifted(x));
      double sum = 0.0;
      for (std::size_t k = 1; k < n; ++k) sum += z[k] * z[k];
      return z[0] * z[0] + 100.0 * std::sqrt(sum);
    }
    case 14: {  // different powers
      const Vector z = r_.times(shifted(x));
      double sum = 0.0;
      for (std::size_t k = 0; k < n; ++k) sum += std::pow(std::fabs(z[k]), 2.0 + 4.0 * share(k, n));
      return std::sqrt(sum);
    }
    case 15:  // Rastrigin
      return rastrigin(m_.times(skewed(oscillated(r_.times(shifted(x))), 0.2)));
    case 16: {  // Weierstrass
      const Vector z = m_.times(oscillated(r_.times(shifted(x))));
      double sum = 0.0;
      double least = 0.0;
      for (int k = 0; k < 12; ++k) {
        const double amplitude = std::pow(0.5, k);
        const double frequency = 2.0 * pi * std::pow(3.0, k);
        least += amplitude * std::cos(0.5 * frequency);
        for (const double v : z) sum += amplitude * std::cos(frequency * (v + 0.5));
      }
      return 10.0 * std::pow(sum / count - least, 3.0) + 10.0 / count * penalty(x);
    }
    case 17:    // Schaffer F7
    case 18: {  // the same, ill-conditioned
      const Vector z = stretched(q_.times(skewed(r_.times(shifted(x)), 0.5)), number_ == 17 ? 10.0 : 1000.0);
      double sum = 0.0;
      for (std::size_t k = 0; k + 1 < n; ++k) {
        const double s = z[k] * z[k] + z[k + 1] * z[k + 1];
        sum += std::pow(s, 0.25) * (1.0 + std::pow(std::sin(50.0 * std::pow(s, 0.1)), 2.0));
      }
      return std::pow(sum / (count - 1.0), 2.0) + 10.0 * penalty(x);
    }
    case 20: {  // Schwefel
      Vector mirrored(n);
      for (std::size_t k = 0; k < n; ++k) mirrored[k] = std::copysign(2.0, x_opt_[k]) * x[k];
      Vector z = mirrored;
      for (std::size_t k = 1; k < n; ++k) z[k] += 0.25 * (mirrored[k - 1] - schwefel_place);
      for (double& v : z) v -= schwefel_place;
      z = stretched(std::move(z), 10.0);
      double sum = 0.0;
      for (double& v : z) {
        v = 100.0 * (v + schwefel_place);
        sum += v * std::sin(std::sqrt(std::fabs(v)));
      }
      double beyond = 0.0;
      for (const double v : z) beyond += std::pow(std::max(0.0, std::fabs(0.01 * v) - half_side), 2.0);
      return -sum / (100.0 * count) + 4.189828872724339 + 100.0 * beyond;
    }
    case 21:
    case 22: {  // Gallagher's peaks
      const Vector z = r_.times(x);
      double highest = 0.0;
      for (std::size_t peak = 0; peak < peaks_.height.size(); ++peak) {
        double sum = 0.0;
        for (std::size_t k = 0; k < n; ++k) {
          const double d = z[k] - peaks_.place[peak][k];
          sum += peaks_.scale[peak][k] * d * d;
        }
        highest = std::max(highest, peaks_.height[peak] * std::exp(-0.5 * sum / count));
      }
      const double deep = oscillated(10.0 - highest);
      return deep * deep + penalty(x);
    }
    case 23: {  // Katsuura
      const Vector z = m_.times(shifted(x));
      double product = 1.0;
      for (std::size_t k = 0; k < n; ++k) {
        double sum = 0.0;
        for (int j = 1; j <= 32; ++j) {
          const double scale = std::pow(2.0, j);
          sum += std::fabs(scale * z[k] - std::floor(scale * z[k] + 0.5)) / scale;
        }
        product *= std::pow(1.0 + static_cast<double>(k + 1) * sum, 10.0 / std::pow(count, 1.2));
      }
      return 10.0 / (count * count) * (product - 1.0) + penalty(x);
    }
    default: {  // Lunacek
      constexpr double first = 2.5;
      const double s = 1.0 - 1.0 / (2.0 * std::sqrt(count + 20.0) - 8.2);
      const double second = -std::sqrt((first * first - 1.0) / s);
      Vector z(n);
      double one = 0.0;
      double other = 0.0;
      for (std::size_t k = 0; k < n; ++k) {
        const double mirrored = std::copysign(2.0, x_opt_[k]) * x[k];
        one += (mirrored - first) * (mirrored - first);
        other += (mirrored - second) * (mirrored - second);
        z[k] = mirrored - first;
      }
      double cosines = 0.0;
      for (const double v : m_.times(z)) cosines += std::cos(2.0 * pi * v);
      return std::min(one, count + s * other) + 10.0 * (count - cosines) + 1e4 * penalty(x);
    }
  }
}

}  // namespace hysteron::bbob
