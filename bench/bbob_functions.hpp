// The 24 noiseless functions of the Black-Box Optimization Benchmarking (BBOB), in any dimension from 2 on and any
// instance, as archived experiments used them.
// Source: N. Hansen, S. Finck, R. Ros, A. Auger, Real-Parameter Black-Box Optimization Benchmarking 2009: Noiseless
// Functions Definitions, INRIA research report RR-6829, updated 2010; the random draws of an instance are those of the
// 2009 experiments (a minimal standard generator with a shuffle table).
#pragma once

#include <cstddef>
#include <vector>

namespace hysteron::bbob {

inline constexpr int function_count = 24;
// The functions are defined everywhere and have their optimum in [-5, 5]^dimension, where they are searched.
inline constexpr double half_side = 5.0;

class Function {
 public:
  // number 1 to 24, instance from 1 on. Throws InputError for others.
  Function(int number, std::size_t dimension, int instance);

  [[nodiscard]] double operator()(const std::vector<double>& x) const;
  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] std::size_t dimension() const { return dimension_; }
  [[nodiscard]] int instance() const { return instance_; }
  [[nodiscard]] double optimum() const { return f_opt_; }
  // Where the optimum is taken.
  [[nodiscard]] const std::vector<double>& best() const { return best_; }

 private:
  using Vector = std::vector<double>;
  // Row by row.
  struct Matrix {
    std::size_t size = 0;
    Vector value;
    [[nodiscard]] double at(std::size_t row, std::size_t column) const { return value[row * size + column]; }
    [[nodiscard]] Vector times(const Vector& x) const;
  };
  struct Peaks {
    Vector height;
    std::vector<Vector> place;  // rotated
    std::vector<Vector> scale;
  };

  static Matrix rotation(long seed, std::size_t dimension);
  // R diag(condition^(k / (2 (n - 1)))) Q
  static Matrix conditioned(const Matrix& r, const Matrix& q, double condition);
  [[nodiscard]] Vector shifted(const Vector& x) const;
  [[nodiscard]] double value_of(const Vector& x) const;
  void place_optimum(long seed);
  void place_peaks(long seed, std::size_t count);

  int number_;
  std::size_t dimension_;
  int instance_;
  double f_opt_;
  Vector x_opt_;
  Vector best_;
  Matrix r_;
  Matrix q_;
  Matrix m_;
  Peaks peaks_;
};

}  // namespace hysteron::bbob
