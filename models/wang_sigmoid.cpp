// Asymmetric sigmoid of Wang et al. with the sixteen parameters that make its characteristic quantities follow the
// excitation and the drive.
//   F    = f_t tanh(s (v - v_d + v_h b) / 2) (1 + k_vc max(v, 0) + k_ve max(-v, 0)) + f_d,   b = tanh(a / a_s)
//   f_t  = f0 (1 + e^(a1 v_m)) (1 + k2 (L(a2 (i + I0)) - L(a2 I0))),   L(u) = 1 / (1 + e^-u)
//   v_h  = k4 v_m (1 + k3 (L(a3 (i + I1)) - L(a3 I1)))
//   s    = a0 / (1 + k0 v_m),   k_vc = k1c e^(-a4 v_m),   k_ve = k1e e^(-a4 v_m)
//   f_d  = k5 f_t,   v_d = k6 v_m,   v_m = sqrt(v^2 - a x)
// v_m is the peak speed of one sine about x = 0, and the law is meaningful for such a motion only; asymmetric-sigmoid is
// the same force with f_t, ... as constants and holds for any. s is the alpha of the source, i the current, a_s rounds
// the sign of the acceleration. The study that identifies the sixteen by Nelder and Mead prints f_t with
// (1 + e^(a1 v_m))^-1 and has lost a "1 +" in f_t and in v_h; `hysteron reproduce nelder-mead-tables` compares the
// readings on its own tables. At one drive and one sine only seven combinations act, so that the sixteen are not
// determined there.
// Source: Ma, Wang, Rakheja, Su, Proc. 41st IEEE CDC (2002) 4172-4177; Wang, Ma, Rakheja, Su, Proc. IMechE D 217 (2003)
// 537-550, in the form quoted by the Nelder-Mead identification.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

template <class T>
T logistic(const T& u) {
  return T(0.5) + T(0.5) * tanh(T(0.5) * u);
}

struct WangSigmoid {
  static constexpr std::string_view id = "wang-sigmoid";
  static constexpr std::string_view title = "Asymmetric sigmoid (Wang), sixteen parameters of excitation and drive";
  static constexpr std::string_view reference = "Wang, Ma, Rakheja, Su, Proc. IMechE D 217 (2003) 537-550";
  static constexpr std::string_view equations[] = {
      "F = f_t tanh(s (v - v_d + v_h b) / 2) (1 + k_vc max(v, 0) + k_ve max(-v, 0)) + f_d",
      "f_t = f0 (1 + e^(a1 v_m)) (1 + k2 (L(a2 (i + I0)) - L(a2 I0))), L(u) = 1 / (1 + e^-u)",
      "v_h = k4 v_m (1 + k3 (L(a3 (i + I1)) - L(a3 I1)))",
      "s = a0 / (1 + k0 v_m), k_vc = k1c e^(-a4 v_m), k_ve = k1e e^(-a4 v_m)",
      "f_d = k5 f_t, v_d = k6 v_m, v_m = sqrt(v^2 - a x), b = tanh(a / a_s)"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {.name = "f0", .unit = "N", .meaning = "transition force at rest, half of it", .box = {1, 1e3}, .initial = 100, .scale = Scale::logarithmic},
      {.name = "a0", .unit = "s/m", .meaning = "steepness at rest", .box = {5, 1e3}, .initial = 100, .scale = Scale::logarithmic},
      {.name = "a1", .unit = "s/m", .meaning = "growth of the transition force with the peak speed", .box = {-10, 10}, .initial = 0},
      {.name = "a2", .unit = "1/A", .meaning = "steepness of the transition force against the current", .box = {0, 20}, .initial = 5},
      {.name = "a3", .unit = "1/A", .meaning = "steepness of the loop's width against the current", .box = {-20, 100}, .initial = 5},
      {.name = "a4", .unit = "s/m", .meaning = "fading of the damping with the peak speed", .box = {-5, 5}, .initial = 0},
      {.name = "k0", .unit = "s/m", .meaning = "fading of the steepness with the peak speed", .box = {0.01, 100}, .initial = 1, .scale = Scale::logarithmic},
      {.name = "k1c", .unit = "s/m", .meaning = "damping at positive velocity over the transition force", .box = {0, 10}, .initial = 1},
      {.name = "k1e", .unit = "s/m", .meaning = "damping at negative velocity over the transition force", .box = {0, 10}, .initial = 1},
      {.name = "k2", .unit = "1", .meaning = "gain of the transition force by the current", .box = {-0.9, 50}, .initial = 5},
      {.name = "k3", .unit = "1", .meaning = "gain of the loop's width by the current", .box = {-3, 10}, .initial = 0},
      {.name = "k4", .unit = "1", .meaning = "width of the loop over the peak speed, negative for one that dissipates", .box = {-0.9, 0.9}, .initial = -0.3},
      {.name = "k5", .unit = "1", .meaning = "offset force over the transition force", .box = {-1, 1}, .initial = 0},
      {.name = "k6", .unit = "1", .meaning = "offset velocity over the peak speed", .box = {-0.5, 0.5}, .initial = 0},
      {.name = "I0", .unit = "A", .meaning = "current at which the gain of the transition force turns, negative", .box = {-2, 2}, .initial = -0.5},
      {.name = "I1", .unit = "A", .meaning = "current at which the gain of the loop's width turns, negative", .box = {-2, 2}, .initial = -0.5},
      {.name = "a_s", .unit = "m/s^2", .meaning = "acceleration at which its sign is rounded", .box = {1e-4, 5}, .initial = 0.02, .scale = Scale::logarithmic, .fixed = true},
  };

  template <class T>
  static T force(const std::array<T, 17>& p, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& /*below*/) {
    const auto& [f0, a0, a1, a2, a3, a4, k0, k1c, k1e, k2, k3, k4, k5, k6, I0, I1, a_s] = p;
    const T one(1.0);
    // A square at rest would have no slope.
    const T v_m = sqrt(max(in.v * in.v - in.a * in.x, T(1e-24)));
    const T b = tanh(in.a / a_s);
    const T f_t = f0 * (one + exp(a1 * v_m)) * (one + k2 * (logistic(a2 * (in.drive + I0)) - logistic(a2 * I0)));
    const T v_h = k4 * v_m * (one + k3 * (logistic(a3 * (in.drive + I1)) - logistic(a3 * I1)));
    const T steepness = a0 / (one + k0 * v_m);
    const T fading = exp(-a4 * v_m);
    const T slope = (k1c * max(in.v, T(0.0)) + k1e * max(-in.v, T(0.0))) * fading;
    return f_t * (tanh(T(0.5) * steepness * (in.v - k6 * v_m + v_h * b)) * (one + slope) + k5);
  }
};

}  // namespace

extern const Part model_wang_sigmoid;
constexpr Part model_wang_sigmoid = compile<WangSigmoid>();

}  // namespace hysteron
