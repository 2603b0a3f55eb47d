// What follows the motion: inertia, delay, compliance, friction, damping, position and direction. Each signature is
// freed of what a refit of the base model absorbs (the displacement, the velocity, the simulated force itself, their
// products with the drive, and a stretch of the hysteresis along the travel) and of what it is mistaken for.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/drive.hpp"
#include "diagnose/residual/contrast_panel.hpp"

namespace hysteron::contrast {
namespace {

using Columns = std::vector<Panel::Column>;

constexpr double film = 0.02;      // of a recording's largest speed: where the sign of the velocity is rounded
constexpr double low_speed = 0.1;  // of the largest of all: where friction at low speed has fallen off
// Of the half stroke: where the ends begin, half widths of the weak middle, places and half width of the border of a
// weak side, yield travel of a second hysteresis.
constexpr std::array<double, 3> ends = {0.6, 0.75, 0.9};
constexpr std::array<double, 2> middles = {0.15, 0.35};
constexpr std::array<double, 3> borders = {-0.4, 0.0, 0.4};
constexpr double border_width = 0.2;
constexpr std::array<double, 2> yields = {0.1, 0.3};
// Of the largest force of all: beyond them the limit of one side is looked for.
constexpr std::array<double, 3> large_forces = {0.3, 0.5, 0.7};

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  [[nodiscard]] double centre() const { return 0.5 * (low + high); }
  [[nodiscard]] double half() const { return 0.5 * (high - low); }
};

// Dahl's hysteresis of yield travel `yield`, one of unit force: z' = (v - |v| z) / yield along the recorded path.
std::vector<Values> hystereses(std::span<const Track> tracks, double yield) {
  std::vector<Values> result;
  for (const Track& track : tracks) {
    Values z(track.x.size(), 0.0);
    for (std::size_t n = 1; n < z.size(); ++n) {
      const double step = track.x[n] - track.x[n - 1];
      const double sign = step > 0.0 ? 1.0 : -1.0;
      z[n] = sign + (z[n - 1] - sign) * std::exp(-std::fabs(step) / yield);
    }
    result.push_back(std::move(z));
  }
  return result;
}

Columns operator+(Columns a, const Columns& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace

void add_motion_contrasts(std::span<const Track> tracks, std::size_t placebos, std::vector<Contrast>& result) {
  Range place;
  double fastest = 0.0;
  double strongest = 0.0;
  double mean_drive = 0.0;
  Values drives;
  bool driven = true;
  for (const Track& track : tracks) {
    for (std::size_t n = track.from; n < track.x.size(); ++n) {
      place.low = std::min(place.low, track.x[n]);
      place.high = std::max(place.high, track.x[n]);
    }
    fastest = std::max(fastest, track.speed);
    strongest = std::max(strongest, track.peak);
    driven = driven && !track.drive.empty();
    drives.insert(drives.end(), track.drive.begin(), track.drive.end());
  }
  driven = driven && varies(drives);
  for (const double drive : drives) {
    mean_drive += drive / static_cast<double>(drives.size());
  }
  const double centre = place.centre();
  const double half = place.half();
  const double slow = low_speed * fastest;

  Panel panel(tracks, &Track::missing, placebos);
  const auto add = [&](auto&& value) { return panel.add(value); };
  const Panel::Column one = add([](const Track&, std::size_t) { return 1.0; });
  const Panel::Column x = add([&](const Track& t, std::size_t n) { return t.x[n] - centre; });
  const Panel::Column x2 = add([&](const Track& t, std::size_t n) { return std::pow(t.x[n] - centre, 2.0); });
  const Panel::Column x3 = add([&](const Track& t, std::size_t n) { return std::pow(t.x[n] - centre, 3.0); });
  const Panel::Column v = add([](const Track& t, std::size_t n) { return t.v[n]; });
  const Panel::Column vv = add([](const Track& t, std::size_t n) { return t.v[n] * std::fabs(t.v[n]); });
  const Panel::Column a = add([](const Track& t, std::size_t n) { return t.a[n]; });
  const Panel::Column f = add([](const Track& t, std::size_t n) { return t.simulated[n]; });
  const Panel::Column later = add([](const Track& t, std::size_t n) { return -t.slope[n]; });
  const Panel::Column stretch = add([](const Track& t, std::size_t n) { return t.stiff[n] * t.since[n]; });
  // The knee of the hysteresis rounder or sharper, and other before the force passes zero than after.
  const auto relative = [](const Track& t, std::size_t n) { return t.direction[n] * t.simulated[n] / t.peak; };
  const Panel::Column skewed =
      add([&](const Track& t, std::size_t n) { return t.stiff[n] * t.since[n] * relative(t, n); });
  const Panel::Column rounder =
      add([&](const Track& t, std::size_t n) { return t.stiff[n] * t.since[n] * relative(t, n) * relative(t, n); });
  const Panel::Column play =
      add([](const Track& t, std::size_t n) { return t.direction[n] * t.simulated[n] > 0.0 ? -t.stiff[n] : 0.0; });
  const Panel::Column soft =
      add([](const Track& t, std::size_t n) { return -t.stiff[n] * std::fabs(t.simulated[n] - t.at_reversal[n]); });
  const auto sign_at = [](const Track& t, std::size_t n) { return std::tanh(t.v[n] / (film * t.speed)); };
  const Panel::Column sign = add(sign_at);
  const Panel::Column stribeck =
      add([&](const Track& t, std::size_t n) { return sign_at(t, n) * std::exp(-(t.v[n] / slow) * (t.v[n] / slow)); });
  const Panel::Column sided = add([&](const Track& t, std::size_t n) { return t.simulated[n] * sign_at(t, n); });
  // Beyond a force, what is lost on one side less what is on the other, and on both together.
  Columns one_sided;
  Columns two_sided;
  for (const double part : large_forces) {
    const auto over = [=](const Track& t, std::size_t n) {
      return -std::max(std::fabs(t.simulated[n]) - part * strongest, 0.0);
    };
    one_sided.push_back(add(over));
    two_sided.push_back(add([=](const Track& t, std::size_t n) { return std::copysign(over(t, n), t.simulated[n]); }));
  }

  Columns base = {one, x, v, f};
  if (driven) {
    base.push_back(add([&](const Track& t, std::size_t n) { return t.v[n] * (t.drive[n] - mean_drive); }));
    base.push_back(add([&](const Track& t, std::size_t n) { return t.simulated[n] * (t.drive[n] - mean_drive); }));
  }
  const Columns knee = {stretch, skewed, rounder};
  const auto less = [](Columns columns, Panel::Column without) {
    std::erase(columns, without);
    return columns;
  };
  const auto contrast = [&](ContrastKind kind, const Columns& signatures, const Columns& without,
                            Panel::Null null = Panel::Null::shift) {
    if (std::optional<Contrast> found = panel.partial(kind, signatures, without, null)) {
      result.push_back(std::move(*found));
    }
  };
  using Kind = ContrastKind;

  contrast(Kind::force_travel, {soft}, base + knee + Columns{play, later, a});
  contrast(Kind::force_delay, {later}, base + knee + Columns{a});
  contrast(Kind::acceleration, {a}, base + knee + Columns{later});
  contrast(Kind::mean_force, {one}, less(base, one) + Columns{sided}, Panel::Null::flip);
  contrast(Kind::stiffness, {x}, less(base, x) + Columns{a, later, stretch});
  contrast(Kind::stiffness_bend, {x2}, base + Columns{a, sided});
  contrast(Kind::stiffness_cubic, {x3}, base + Columns{x2, a, sign, later});
  contrast(Kind::direction, {sided}, base + Columns{x2, a});
  contrast(Kind::one_sided_limit, one_sided, base + two_sided + Columns{x2, a, sided});
  contrast(Kind::dry_friction, {sign}, base + knee + Columns{a, later, vv});
  contrast(Kind::low_speed, {stribeck}, base + knee + Columns{sign, a, later, vv});
  contrast(Kind::viscous, {v}, less(base, v) + Columns{a, sign, vv, stretch});
  contrast(Kind::speed_bend, {vv}, base + Columns{a, sign, stretch});

  Columns at_ends;
  for (const double end : ends) {
    const auto up = [=](const Track& t, std::size_t n) { return std::max(t.x[n] - centre - end * half, 0.0); };
    const auto low = [=](const Track& t, std::size_t n) { return std::min(t.x[n] - centre + end * half, 0.0); };
    at_ends.push_back(add(up));
    at_ends.push_back(add(low));
    at_ends.push_back(add([=](const Track& t, std::size_t n) { return up(t, n) + low(t, n); }));
  }
  contrast(Kind::stroke_end, at_ends, base + Columns{x2, a, sided});

  // Of both directions: a spring that bends there, whatever its shape, is a force of the place alone.
  Columns in_middle;
  Columns of_place = {x2, x3};
  for (const double middle : middles) {
    const auto near = [=](const Track& t, std::size_t n) {
      const double from = (t.x[n] - centre) / (middle * half);
      return std::exp(-from * from);
    };
    in_middle.push_back(add([=](const Track& t, std::size_t n) { return -t.simulated[n] * near(t, n); }));
    of_place.push_back(add([=](const Track& t, std::size_t n) { return near(t, n); }));
    of_place.push_back(add([=](const Track& t, std::size_t n) { return (t.x[n] - centre) * near(t, n); }));
  }
  contrast(Kind::middle_loss, in_middle, base + Columns{vv, a, sign, stretch} + of_place);

  // Likewise on one side of a place. A gain that changes evenly with the place is that of a lever, and what is lost at
  // both ends alike is lost on no side.
  Columns on_one_side;
  Columns at_both_ends;
  for (const double border : borders) {
    const auto beyond = [=](const Track& t, std::size_t n) {
      return std::tanh((t.x[n] - centre - border * half) / (border_width * half));
    };
    on_one_side.push_back(add([=](const Track& t, std::size_t n) { return -t.simulated[n] * beyond(t, n); }));
    of_place.push_back(add(beyond));
    if (border > 0.0) {  // which the border opposite makes a pair
      const auto beyond_opposite = [=](const Track& t, std::size_t n) {
        return std::tanh((t.x[n] - centre + border * half) / (border_width * half));
      };
      at_both_ends.push_back(
          add([=](const Track& t, std::size_t n) { return t.simulated[n] * (beyond_opposite(t, n) - beyond(t, n)); }));
    }
  }
  of_place.push_back(add([=](const Track& t, std::size_t n) { return t.simulated[n] * (t.x[n] - centre); }));
  contrast(Kind::side_loss, on_one_side, base + Columns{vv, a, sign, stretch} + of_place + at_both_ends);

  Columns second;
  for (const double yield : yields) {
    const std::vector<Values> z = hystereses(tracks, yield * half);
    second.push_back(
        add([&](const Track& t, std::size_t n) { return z[static_cast<std::size_t>(&t - tracks.data())][n]; }));
  }
  contrast(Kind::pre_yield, second, base + knee + Columns{sign, a, vv});
}

}  // namespace hysteron::contrast
