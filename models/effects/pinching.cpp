// Pinching: the force is smaller around the middle of the stroke, where worn or slipping parts do not bear.
//   F <- F (1 - p exp(-|(x - x_p) / w|^q))
// It acts on all of the force below, so p is not linear together with the forces of the law. The law baber-noori has
// pinching inside its hysteresis instead.
// Source: the slip function of Baber, Noori, J. Vib. Acoust. 108 (1986) 411-420, written in the displacement, with an
// exponent.
#include "simulate/compile.hpp"

namespace hysteron {
namespace {

struct Pinching {
  static constexpr std::string_view id = "pinching";
  static constexpr std::string_view title = "Pinching (a weak range of the stroke)";
  static constexpr std::string_view reference =
      "after Baber, Noori, J. Vib. Acoust. 108 (1986) 411-420; written in the displacement";
  static constexpr std::string_view equations[] = {"F <- F (1 - p exp(-|(x - x_p) / w|^q))"};
  static constexpr int states = 0;
  static constexpr Parameter parameters[] = {
      {.name = "p", .unit = "1", .meaning = "relative loss of force in the middle", .box = {-0.5, 0.95}, .initial = 0, .limits = {.upper = 1}},
      {.name = "x_p", .unit = "m", .meaning = "middle of the weak range", .box = {-0.03, 0.03}, .initial = 0, .place = 1},
      {.name = "w", .unit = "m", .meaning = "half width of the weak range", .box = {5e-4, 0.03}, .initial = 4e-3, .scale = Scale::logarithmic},
      {.name = "q", .unit = "1", .meaning = "sharpness of its borders: 2 is a bell, more a flat bottom", .box = {1.2, 8}, .initial = 2, .scale = Scale::logarithmic},
  };
  static constexpr std::string_view kin[] = {"cubic-stiffness"};
  static constexpr PartOfLaw part_of[] = {{"baber-noori"}};
  static constexpr ContrastSense contrasts[] = {{ContrastKind::middle_loss, Sense::either}, {ContrastKind::side_loss, Sense::either}};
  static constexpr Knowledge knowledge = {
      .family = families::place,
      .in_words = "pinching (a weak range of the stroke)",
      .shows = "the force of both directions is smaller around one place of the stroke",
      .experiment = "small strokes inside a large one, at two amplitudes",
      .rig_cause = "a lever whose arm changes along the stroke, or a joint that is loose and rubs",
      .acts = Acts::by_place,
      .kin = kin,
      .part_of = part_of,
      .contrasts = contrasts,
  };

  template <class T>
  static T force(const std::array<T, 4>& card, const std::array<T, 0>& /*s*/, const Input<T>& in, const T& below) {
    const auto& [p, x_p, w, q] = card;
    const T relative = (in.x - x_p) / w;
    const T square = max(relative * relative, T(1e-12));
    return below * (T(1.0) - p * exp(-pow(square, T(0.5) * q)));
  }
};

}  // namespace

extern const Part effect_pinching;
constexpr Part effect_pinching = compile<Pinching>();

}  // namespace hysteron
