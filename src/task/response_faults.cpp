#include "task/response_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>

#include "core/extent.hpp"
#include "core/frequency.hpp"
#include "respond/acceleration_fault.hpp"
#include "respond/force_balance.hpp"
#include "respond/release.hpp"
#include "respond/rest_level.hpp"

namespace hysteron {
namespace {

bool is_free(const Recording& recording, const Rig& rig) {
  return rig.base ? span_of(recording.base) == 0.0 : peak_of(recording.force) == 0.0;
}

std::optional<std::string> without_hold(Recording& recording, const Rig& rig) {
  if (!is_free(recording, rig)) return std::nullopt;
  const auto release = release_of(recording.time, recording.displacement);
  if (!release) return std::nullopt;
  const double from = recording.time.front();
  begin_at(recording, *release);
  // One that is let go has hardly a speed yet, where this is told.
  constexpr double at_once = 0.3;
  const bool let_go = std::fabs(recording.velocity.front()) < at_once * peak_of(recording.velocity);
  return fmt::format("nothing moves the mass, and it stands still from {:.4g} to {:.4g} s before it moves{}, sample {}",
                     from, recording.time.front(),
                     let_go ? ": it was held, and the fit starts at its release"
                            : " at once: it was struck, or its sensor was at an end of its range, and the fit starts "
                              "behind that",
                     *release + 1);
}

std::string text_of(const AccelerationFault& fault) {
  using Kind = AccelerationFault::Kind;
  switch (fault.kind) {
    case Kind::reversed:
      return fmt::format(
          "the acceleration runs against the displacement, {:.3g} times its second derivative: check "
          "its sign",
          -fault.size);
    case Kind::factor:
      return fmt::format("the acceleration is {:.3g} times the second derivative of the displacement: check its unit",
                         fault.size);
    case Kind::offset:
      return fmt::format(
          "the acceleration is {:.3g} m/s^2 off what displacement and time tell: check the zero of the "
          "channel",
          fault.size);
    case Kind::absolute:
      return "the acceleration is the absolute one of the mass, expected that relative to the base";
    case Kind::of_base:
      return "the acceleration is that of the base, expected that of the mass relative to it";
    case Kind::foreign:
      break;
  }
  return fmt::format(
      "the acceleration does not follow the second derivative of the displacement (a correlation of "
      "{:.2g}), expected that of the mass relative to its base",
      fault.size);
}

std::optional<std::string> without_wrong_acceleration(Recording& recording) {
  const auto fault = acceleration_fault_of(recording);
  if (!fault) return std::nullopt;
  recording.acceleration.clear();
  return text_of(*fault) + "; the slope of the velocity is taken instead";
}

// A passive damper takes energy from a mass that nothing moves.
std::optional<std::string> growth_of(const Recording& recording, const Rig& rig) {
  if (!is_free(recording, rig)) return std::nullopt;
  // One period would do for a motion of one frequency; a soft spring makes the first ones longer than the usual.
  constexpr double first_periods = 3.0;
  constexpr double grown = 1.1;  // by more than noise and a drifting zero make of one that does not decay
  const double frequency = dominant_frequency(recording);
  if (!(frequency > 0.0)) return std::nullopt;
  const auto behind = std::ranges::upper_bound(recording.time, recording.time.front() + first_periods / frequency);
  const auto count = static_cast<std::size_t>(behind - recording.time.begin());
  const std::span<const double> x(recording.displacement);
  const double first = span_of(x.first(count));
  const double later = span_of(x.subspan(count));
  if (!(later > grown * first)) return std::nullopt;
  return fmt::format(
      "a free decay, with no force on the mass and no base, and yet its displacement spans {:.3g} mm at "
      "first and {:.3g} mm later: something moves it that is not recorded, or not as force or base",
      1e3 * first, 1e3 * later);
}

std::optional<std::string> force_of_damper(const Recording& recording, const Rig& rig) {
  if (!is_of_damper(recording, rig)) return std::nullopt;
  return "the force, taken as that on the mass, is that of the damper in a free decay, -m x'' less that of the spring: "
         "leave its column out, or fit it without the mass";
}

std::optional<std::string> size_of_mass(const Recording& recording, const Rig& rig) {
  // A light swing at resonance is as far from balance as its quality factor, and no damper leaves one of 200.
  constexpr double most_times = 200.0;
  const auto times = inertia_over_known(recording, rig);
  if (!times || *times < most_times) return std::nullopt;
  return fmt::format(
      "m x'' of a mass of {:.4g} kg is {:.2g} times what else is known to act on it: check that the mass "
      "is in kg and the stiffness in N/m",
      rig.mass, *times);
}

}  // namespace

std::vector<Remark> mend_responses(std::vector<Recording>& responses, const Rig& rig) {
  std::vector<Remark> remarks;
  for (Recording& recording : responses) {
    const auto tell = [&](const std::string& key, const std::optional<std::string>& text) {
      if (text) remarks.push_back({recording.file, Remark::Kind::implausible, key, *text});
    };
    tell("hold", without_hold(recording, rig));
    tell("acceleration", without_wrong_acceleration(recording));
    tell("growth", growth_of(recording, rig));
    tell("force of damper", force_of_damper(recording, rig));
    tell("size of mass", size_of_mass(recording, rig));
  }
  return remarks;
}

std::vector<Remark> places_of_rest(const std::vector<Recording>& responses, const Rig& rig,
                                   const CompositeModel& model) {
  // A hysteresis may hold the mass anywhere, and a drive move its place of rest.
  if (model.states() > 0 || drive_levels(responses) > 1) return {};
  struct Place {
    const Recording* recording;
    RestLevel rest;
  };
  std::vector<Place> places;
  for (const Recording& recording : responses) {
    const auto rest = is_free(recording, rig) ? rest_level_of(recording) : std::nullopt;
    if (rest) places.push_back({&recording, *rest});
  }
  if (places.size() < 2) return {};
  const auto [low, high] = std::ranges::minmax(places, {}, [](const Place& place) { return place.rest.level; });
  const double apart = high.rest.level - low.rest.level;
  // What is at rest within a hundredth (respond/rest_level.cpp) is at rest there, and noise is far less.
  constexpr double least_share = 0.02;
  constexpr double surely = 20.0;
  for (const RestLevel& rest : {low.rest, high.rest}) {
    // A friction that held it so far off would not have let it swing so little.
    if (apart < least_share * rest.largest || apart < surely * rest.noise || rest.last_swings > 0.5 * apart) return {};
  }
  return {{high.recording->file, Remark::Kind::implausible, "place of rest",
           fmt::format("the mass comes to rest at {:.4g} mm, and at {:.4g} mm in {}, where the model has one place of "
                       "rest: another zero of the displacement sensor looks so; subtract it from each",
                       1e3 * high.rest.level, 1e3 * low.rest.level, low.recording->file)}};
}

}  // namespace hysteron
