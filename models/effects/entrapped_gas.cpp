// Gas entrapped in the fluid: a series spring that is soft at small force and hardens as the gas is compressed, so that
// the force lags after a reversal.
//   F = F_law(x - d, v - d') = q + tau q',   d = C_c q + d_a (tanh(q / f_a - e_a) + tanh e_a)
// 2 d_a is the travel lost between the directions, C_c + d_a / f_a the compliance at most, C_c that of fluid and mounts
// without gas. e_a f_a is the force at which the gas is softest: 0 where both chambers hold gas alike, and off it where
// one holds more, so that mostly forces of that sign compress it. tau = 0.5 ms.
// Source: saturating form of the gas law in a closed pocket; no accepted form is known.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct EntrappedGas {
  static constexpr std::string_view id = "entrapped-gas";
  static constexpr std::string_view title = "Entrapped gas (hardening series spring)";
  static constexpr std::string_view reference = "no accepted form; hardening series spring";
  static constexpr std::string_view equations[] = {"F = F_law(x - d, v - d') = q + tau q'",
                                                   "d = C_c q + d_a (tanh(q / f_a - e_a) + tanh e_a)"};
  static constexpr int states = 1;
  static constexpr Parameter parameters[] = {
      {.name = "d_a", .unit = "m", .meaning = "travel that compresses the gas", .box = {0, 5e-3}, .initial = 0},
      {.name = "f_a", .unit = "N", .meaning = "force at which the gas is compressed", .box = {30, 1e3}, .initial = 200, .scale = Scale::logarithmic},
      {.name = "e_a", .unit = "1", .meaning = "force at which the gas is softest, over f_a", .box = {-2, 2}, .initial = 0},
      {.name = "C_c", .unit = "m/N", .meaning = "compliance of the compressed gas, fluid and mounts", .box = {0, 1e-6}, .initial = 0},
      {.name = "tau", .unit = "s", .meaning = "relaxation time of the gas spring", .box = {2e-4, 5e-3}, .initial = 5e-4, .scale = Scale::logarithmic, .fixed = true},
  };
  static constexpr std::string_view kin[] = {"compliance", "clearance"};
  static constexpr Limit holds[] = {{"compliance", "d_a"}};
  // A gas that next to no force compresses is a play; where nothing but the gas gives way, C_c is zero.
  static constexpr BoxLimit ends_as[] = {{"clearance", "f_a", BoxEnd::lower}, {id, "C_c", BoxEnd::lower}};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::reversal_travel, Sense::positive}, {ContrastKind::force_travel, Sense::positive}};
  static constexpr Knowledge knowledge = {
      .family = families::free_travel,
      .in_words = "entrapped gas (a hardening spring in series)",
      .shows =
          "the force builds up after each reversal first softly, then steeply, over a travel that falls with the gas "
          "pressure",
      .experiment = "the same run at two charge pressures or after a long rest: only entrapped gas changes",
      .rig_cause = "a soft bush in a joint",
      .kin = kin,
      .holds = holds,
      .ends_as = ends_as,
      .contrasts = contrasts,
  };

  template <class T>
  static Yield<T> yield(const std::array<T, 5>& p, const T& q) {
    const auto& [d_a, f_a, e_a, C_c, tau] = p;
    const T inverse = T(1.0) / f_a;
    const T full = tanh(q * inverse - e_a);
    const T slope = d_a * inverse * (T(1.0) - full * full);
    return {C_c * q + d_a * (full + tanh(e_a)), C_c + slope, T(-2.0) * slope * full * inverse, T(1.0) / tau, T(1.0), f_a};
  }
};

}  // namespace

extern const Part effect_entrapped_gas;
constexpr Part effect_entrapped_gas = compile<EntrappedGas>();

}  // namespace hysteron
