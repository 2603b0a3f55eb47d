// Asymmetric sigmoid force-velocity characteristic with a hysteretic shift.
//   F = tanh((v - v_d - v_h b) / v_t) (f_t + c_c max(v, 0) + c_e max(-v, 0)) + f_d
//   b = tanh(a / a_s), the sign of the acceleration
// The source writes (1 - e^-u) / (1 + e^-u) = tanh(u / 2) with u = alpha (v + v_h): v_t = 2 / alpha, c_c = f_t k_vc,
// c_e = f_t k_ve. Its 16 parameters are these eight as functions of the current and of the excitation's peak speed
// v_m = sqrt(v^2 - a x). The latter holds for one sine about x = 0 only, so it is not part of this model: the eight are
// constants here, and the dependence on current or frequency is put on them as polynomials, as for any other model;
// wang-sigmoid has the sixteen. The acceleration is
// that of models/motion_filter.hpp with tau = 2 ms; a_s = 0.2 m/s^2 rounds its sign. Source: Wang, Ma, Rakheja, Su,
// Proc. IMechE D 217 (2003) 537-550, and Wang et al. 2004 in the form quoted by the Nelder-Mead identification of the
// modified Bouc-Wen model.
#include "models/motion_filter.hpp"
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct AsymmetricSigmoid {
  static constexpr std::string_view id = "asymmetric-sigmoid";
  static constexpr std::string_view title = "Asymmetric sigmoid (Wang), constant characteristic parameters";
  static constexpr std::string_view reference = "Wang, Ma, Rakheja, Su, Proc. IMechE D 217 (2003) 537-550";
  static constexpr std::string_view equations[] = {
      "F = tanh((v - v_d - v_h b) / v_t) (f_t + c_c max(v, 0) + c_e max(-v, 0)) + f_d", "b = tanh(a / a_s)",
      "a from h' = (v - h) / tau"};
  static constexpr int states = 1;
  static constexpr Parameter parameters[] = {
      {.name = "f_t", .unit = "N", .meaning = "transition force", .box = {0, 3e3}, .initial = 500, .linear = true, .role = PhysicalRole::yield_force},
      {.name = "c_c", .symbol = "f_t k_vc", .unit = "N s/m", .meaning = "damping in the direction of positive velocity", .box = {0, 2e4}, .initial = 500, .linear = true, .role = PhysicalRole::damping},
      {.name = "c_e", .symbol = "f_t k_ve", .unit = "N s/m", .meaning = "damping in the direction of negative velocity", .box = {0, 2e4}, .initial = 500, .linear = true, .role = PhysicalRole::damping},
      {.name = "f_d", .unit = "N", .meaning = "offset force", .box = {-1.5e3, 1.5e3}, .initial = 0, .linear = true, .role = PhysicalRole::offset_force},
      {.name = "v_t", .symbol = "2/alpha", .unit = "m/s", .meaning = "width of the transition", .box = {1e-3, 1}, .initial = 0.03, .scale = Scale::logarithmic},
      {.name = "v_h", .unit = "m/s", .meaning = "half width of the loop: velocity at zero force", .box = {0, 0.15}, .initial = 0.01},
      {.name = "v_d", .unit = "m/s", .meaning = "offset velocity", .box = {-0.1, 0.1}, .initial = 0},
      acceleration_lag,
      acceleration_rounding,
  };

  template <class T>
  static std::array<T, 1> rate(const std::array<T, 9>& p, const std::array<T, 1>& s, const Input<T>& in) {
    const auto& [f_t, c_c, c_e, f_d, v_t, v_h, v_d, tau, a_s] = p;
    const auto& [h] = s;
    return {(in.v - h) / tau};
  }
  template <class T>
  static T stiffness(const std::array<T, 9>& p, double /*speed*/) {
    const auto& [f_t, c_c, c_e, f_d, v_t, v_h, v_d, tau, a_s] = p;
    // Four times the bound: the branch function multiplies the error of the lagged velocity by up to 1 / (tau a_s).
    return T(4.0) / tau;
  }
  template <class T>
  static T force(const std::array<T, 9>& p, const std::array<T, 1>& s, const Input<T>& in, const T& /*below*/) {
    const auto& [f_t, c_c, c_e, f_d, v_t, v_h, v_d, tau, a_s] = p;
    const auto& [h] = s;
    const T b = tanh(acceleration(in.v, h, tau, in.age) / a_s);
    const T slope = c_c * max(in.v, T(0.0)) + c_e * max(-in.v, T(0.0));
    return tanh((in.v - v_d - v_h * b) / v_t) * (f_t + slope) + f_d;
  }
};

}  // namespace

extern const Part model_asymmetric_sigmoid;
constexpr Part model_asymmetric_sigmoid = compile<AsymmetricSigmoid>();

}  // namespace hysteron
