#include "challenge/physics.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "challenge/dormand_prince.hpp"
#include "challenge/electric.hpp"

namespace hysteron::challenge {
namespace {

enum Index : std::size_t {
  hysteresis,   // z
  slip,         // x - y of the modified Bouc-Wen
  inner,        // displacement of the damper behind a series element, less the middle position
  heat,         // K above ambient
  travel,       // m since the start of the recording
  work,         // J since the start of the recording
  seal,         // bristle deflections, m
  rub,          //
  pre_slide,    // of 1
  void_length,  // m, parted fluid column
  mount_one,    // m
  mount_two,    //
  swing,        // m, running amplitude
  valve_open,   // of 1
  speed_seen,   // m/s
  state_count
};
using State = std::array<double, state_count>;

double sign_of(double v, double width) { return v / std::sqrt(v * v + width * width); }

class Plant {
 public:
  Plant(const Physics& physics, const Run& test, double end)
      : p_(physics), test_(test), field_(physics, test.drive, -test.lead, end) {}

  [[nodiscard]] State start() const {
    State s{};
    s[inner] = test_.motion.at(-test_.lead).x;
    s[speed_seen] = test_.motion.at(-test_.lead).v;
    return s;
  }

  [[nodiscard]] State scales() const {
    State s;
    s.fill(p_.length_scale);
    s[hysteresis] = is_bouc_wen() ? full_z() : p_.x_b;
    s[slip] = full_z();
    s[heat] = 20.0;
    s[work] = p_.force_scale * p_.length_scale;
    s[seal] = s[rub] = p_.bristle;
    s[pre_slide] = s[valve_open] = 1.0;
    s[speed_seen] = 0.1;
    return s;
  }

  [[nodiscard]] double force(double t, const State& s) const { return balance(t, s).total; }

  State rate(double t, const State& s) const {
    const Balance b = balance(t, s);
    const double v = b.rod.v;
    State d{};
    const double u = is_modified() ? slip_speed(b, s) : b.v_inner;
    d[hysteresis] = hysteresis_rate(b, s, u);
    if (is_modified()) d[slip] = u;
    d[inner] = p_.has_series() ? b.v_inner : v;
    if (p_.cavitation < never) d[void_length] = b.v_inner - v - s[void_length] / p_.refill_time;
    if (t >= 0.0) {
      const double power = b.core * b.v_inner;
      d[heat] = std::max(power, 0.0) / p_.heat_capacity - s[heat] / p_.cooling_time;
      d[travel] = std::abs(b.v_inner);
      d[work] = std::max(power, 0.0);
    }
    if (p_.seal_static > 0.0) d[seal] = v - std::abs(v) * s[seal] / (p_.bristle * seal_level(v));
    if (p_.coulomb > 0.0) d[rub] = v - std::abs(v) * s[rub] / p_.bristle;
    if (p_.pre_force > 0.0) d[pre_slide] = (v - std::abs(v) * s[pre_slide]) / p_.pre_length;
    if (p_.mount_force != 0.0) {
      d[mount_one] = v - mount_stretch(s[mount_one]) / p_.mount_fast;
      d[mount_two] = v - mount_stretch(s[mount_two]) / p_.mount_slow;
    }
    if (p_.swing_damping != 0.0) {
      const double away = std::abs(b.rod.x - test_.motion.offset);
      d[swing] = away > s[swing] ? (away - s[swing]) / 0.02 : (away - s[swing]) / 0.8;
    }
    if (p_.acting_lag > 0.0) d[speed_seen] = (test_.motion.at(t).v - s[speed_seen]) / p_.acting_lag;
    if (p_.valve != 0.0) {
      const double speed = std::abs(v) / p_.valve_speed;
      const double wanted = speed > 1.0 || (speed > 0.5 && s[valve_open] > 0.5) ? 1.0 : 0.0;
      d[valve_open] = (wanted - s[valve_open]) / 0.004;
    }
    return d;
  }

 private:
  struct Balance {
    Kinematics rod;
    double t = 0.0;
    double drive = 0.0;
    double x_inner = 0.0, v_inner = 0.0;
    double core = 0.0, total = 0.0;
  };

  [[nodiscard]] bool is_bouc_wen() const { return p_.law == Law::bouc_wen || p_.law == Law::modified_bouc_wen; }
  [[nodiscard]] bool is_modified() const { return p_.law == Law::modified_bouc_wen; }
  [[nodiscard]] double full_z() const {
    return is_bouc_wen() ? std::pow(p_.A / (p_.beta + p_.gamma), 1.0 / p_.n) : p_.x_b;
  }

  // Yield force and damping as temperature, rest, swing, place and valve leave them.
  [[nodiscard]] double yield(const Balance& b, const State& s) const {
    double value = p_.alpha_a + p_.alpha_b * b.drive;
    if (p_.heat_rate != 0.0) value *= std::exp(-p_.heat_rate * p_.heat_yield_share * s[heat]);
    return value;
  }
  [[nodiscard]] double damping(const Balance& b, const State& s, double v) const {
    double c = p_.c_a + p_.c_b * b.drive;
    if (p_.heat_rate != 0.0) c *= std::exp(-p_.heat_rate * s[heat]);
    if (p_.thinning != 0.0) {
      c *= 1.0 - p_.thinning + p_.thinning / (1.0 + std::pow(std::abs(v) / p_.thin_speed, p_.thin_power));
    }
    if (p_.swing_damping != 0.0) c *= 1.0 + p_.swing_damping * s[swing] / p_.swing_length;
    if (p_.valve != 0.0) c *= 1.0 - p_.valve * s[valve_open];
    return c;
  }

  [[nodiscard]] double slip_speed(const Balance& b, const State& s) const {
    const double c = damping(b, s, b.v_inner);
    return (p_.c1 * b.v_inner - p_.k0 * s[slip] - yield(b, s) / full_z() * s[hysteresis]) / (c + p_.c1);
  }

  [[nodiscard]] double lugre_level(double v) const {
    return 1.0 + (p_.ratio - 1.0) * std::exp(-(v / p_.v_st) * (v / p_.v_st));
  }

  [[nodiscard]] double hysteresis_rate(const Balance& b, const State& s, double u) const {
    const double z = s[hysteresis];
    if (p_.law == Law::lugre) return u - std::abs(u) * z / (p_.x_b * lugre_level(u));
    if (!is_bouc_wen()) return 0.0;
    const double grip = std::pow(std::abs(z), p_.n - 1.0);
    double d = p_.A * u - p_.beta * std::abs(u) * z * grip - p_.gamma * u * std::abs(z) * grip;
    if (p_.knee_growth != 0.0) d /= 1.0 + p_.knee_growth * b.drive;
    if (p_.slip_lock != 0.0) {
      const double place = (z * (u < 0.0 ? -1.0 : 1.0) / full_z() - p_.slip_centre) / p_.slip_width;
      d *= 1.0 - p_.slip_lock / (1.0 + place * place);
    }
    return d;
  }

  // Force of the damper proper at an inner velocity.
  [[nodiscard]] double core_at(Balance& b, const State& s, double v) const {
    b.v_inner = v;
    const double c = damping(b, s, v);
    const double alpha = yield(b, s);
    const double z = s[hysteresis];
    double f = 0.0;
    double held = p_.k0 * b.x_inner + p_.f0;
    switch (p_.law) {
      case Law::bouc_wen:
        f = alpha / full_z() * z + c * v;
        break;
      case Law::modified_bouc_wen:
        f = p_.c1 * (v - slip_speed(b, s));
        held = p_.k1 * b.x_inner;
        break;
      case Law::tanh_hysteresis:
        f = alpha * std::tanh((v + p_.v_h * std::tanh((b.x_inner - test_.motion.offset) / p_.sign_length)) / p_.v_y) +
            c * v;
        break;
      case Law::bingham:
        f = alpha * std::tanh(v / p_.sign_speed) + c * v;
        break;
      case Law::lugre:
        f = alpha / p_.x_b * z + p_.s1 * (v - std::abs(v) * z / (p_.x_b * lugre_level(v))) + c * v;
        break;
    }
    f += p_.quadratic * v * std::abs(v);
    if (p_.rest_excess != 0.0) f *= 1.0 + p_.rest_excess * std::exp(-s[travel] / p_.rest_length);
    if (p_.pinch != 0.0) {
      const double place = (b.rod.x - p_.pinch_centre) / p_.pinch_width;
      f *= 1.0 - p_.pinch / (1.0 + place * place * place * place);
    }
    if (p_.wear != 0.0) f /= 1.0 + p_.wear * s[work];
    f += held;
    if (p_.asymmetry != 0.0) f *= 1.0 + p_.asymmetry * sign_of(v, 1e-3);
    return f;
  }

  // Force that the series element passes on.
  [[nodiscard]] double series_at(const Balance& b, double v) const {
    const double stretch = b.rod.x - b.x_inner;
    if (p_.gap > 0.0) {
      const double press = std::abs(stretch) - 0.5 * p_.gap;
      if (press <= 0.0) return 0.0;
      const double side = stretch < 0.0 ? -1.0 : 1.0;
      const double f = p_.contact_stiffness * press + p_.contact_damping * side * (b.rod.v - v);
      return side * std::max(f, 0.0);
    }
    if (p_.pocket_length > 0.0) {
      const double left = std::max(1.0 - std::abs(stretch) / p_.pocket_length, 0.02);
      const double f = p_.pocket_force * (std::pow(left, -p_.pocket_exponent) - 1.0);
      return stretch < 0.0 ? -f : f;
    }
    if (p_.series_dashpot < never) return p_.series_dashpot * (b.rod.v - v);
    return p_.series_stiffness * stretch;
  }

  // The inner velocity at which the damper's force is the wanted one (a number, or what the series element passes on):
  // Newton's method inside a bracket; the difference rises with the velocity.
  template <class Wanted>
  double solve(Balance& b, const State& s, const Wanted& wanted) const {
    const double fine = 1e-10 * p_.force_scale;
    double v = b.rod.v;
    double g = core_at(b, s, v) - wanted(v);
    double low = v;
    double high = v;
    double reach = std::max(0.1 * std::abs(v), 1e-3);
    while ((g > 0.0) == (core_at(b, s, g > 0.0 ? low : high) - wanted(g > 0.0 ? low : high) > 0.0) && reach < 1e4) {
      (g > 0.0 ? low : high) += g > 0.0 ? -reach : reach;
      reach *= 4.0;
    }
    for (int k = 0; k < 80 && std::abs(g) > fine && high - low > 1e-13; ++k) {
      (g > 0.0 ? high : low) = v;
      const double h = 1e-6 + 1e-6 * std::abs(v);
      const double slope = (core_at(b, s, v + h) - wanted(v + h) - g) / h;
      const double newton = v - g / slope;
      v = slope > 0.0 && newton > low && newton < high && k < 40 ? newton : 0.5 * (low + high);
      g = core_at(b, s, v) - wanted(v);
    }
    return v;
  }

  [[nodiscard]] Balance balance(double t, const State& s) const {
    Balance b;
    b.t = t;
    b.rod = test_.motion.at(t);
    if (p_.acting_lag > 0.0) b.rod.v = s[speed_seen];
    b.drive = field_.at(t);
    b.x_inner = b.rod.x;
    if (p_.has_series()) {
      b.x_inner = s[inner];
      const double v = solve(b, s, [&](double speed) { return series_at(b, speed); });
      b.core = core_at(b, s, v);
    } else if (p_.cavitation < never) {
      cavitate(b, s);
    } else {
      b.core = core_at(b, s, b.rod.v);
    }
    b.total = b.core + beside(b, s);
    return b;
  }

  // While the rod retracts the force stays above -F_cav: the fluid column parts, and the damper follows at the speed
  // that this force drives. On the way back the void closes before the damper takes up force: without force its springs
  // slacken.
  void cavitate(Balance& b, const State& s) const {
    if (b.rod.v >= 0.0 && s[void_length] > 1e-7) {
      solve(b, s, [](double) { return 0.0; });
      b.core = 0.0;
      return;
    }
    b.core = core_at(b, s, b.rod.v);
    if (b.rod.v < 0.0 && b.core < -p_.cavitation) {
      const double v = solve(b, s, [&](double) { return -p_.cavitation; });
      b.core = core_at(b, s, std::min(v, 0.0));
      b.core = -p_.cavitation;
    }
  }

  [[nodiscard]] double seal_level(double v) const {
    if (p_.seal_static == 0.0) return 0.0;
    return (p_.seal_coulomb +
            (p_.seal_static - p_.seal_coulomb) * std::exp(-(v / p_.seal_speed) * (v / p_.seal_speed))) /
           p_.seal_static;
  }
  [[nodiscard]] double mount_stretch(double y) const {
    const double relative = y / p_.mount_length;
    return y * (1.0 + relative * relative);
  }

  // Everything parallel to the damper.
  [[nodiscard]] double beside(const Balance& b, const State& s) const {
    const double x = b.rod.x;
    const double v = b.rod.v;
    double f = p_.offset + p_.stiffness * x + p_.cubic * x * x * x + p_.viscous * v + p_.mass * b.rod.a;
    f += p_.drift * std::max(b.t, 0.0);
    if (p_.gas_force != 0.0) f += p_.gas_force * std::pow(1.0 - p_.gas_swept * x, -p_.gas_exponent);
    if (p_.stop_force > 0.0) {
      const double up = std::max(x - p_.stop_up, 0.0) / p_.stop_depth;
      const double low = std::max(-x - p_.stop_low, 0.0) / p_.stop_depth;
      f += p_.stop_force * (std::pow(up, p_.stop_power) - std::pow(low, p_.stop_power));
    }
    if (p_.film_speed > 0.0) {
      f += (p_.coulomb + p_.seal_static * seal_level(v)) * std::tanh(v / p_.film_speed);
    } else {
      if (p_.seal_static > 0.0) f += p_.seal_static * s[seal] / p_.bristle;
      if (p_.coulomb > 0.0) f += p_.coulomb * s[rub] / p_.bristle;
    }
    if (p_.pre_force > 0.0) f += p_.pre_force * s[pre_slide];
    if (p_.place_friction != 0.0) {
      const double place = (x - p_.place_centre) / p_.place_length;
      f += p_.place_friction * place * place * sign_of(v, 1e-3);
    }
    if (p_.mount_force != 0.0) {
      f += p_.mount_force / p_.mount_length * (mount_stretch(s[mount_one]) + mount_stretch(s[mount_two]));
    }
    return f;
  }

  const Physics& p_;
  const Run& test_;
  Field field_;
};

}  // namespace

std::string_view model_of(Law law) {
  switch (law) {
    case Law::bouc_wen:
      return "bouc-wen";
    case Law::modified_bouc_wen:
      return "modified-bouc-wen";
    case Law::tanh_hysteresis:
      return "algebraic-hysteresis";
    case Law::bingham:
      return "bingham";
    case Law::lugre:
      return "lugre";
  }
  return "";
}

Track simulate(const Physics& physics, const Run& test, double rate) {
  Track track;
  track.rate = rate;
  track.lead = static_cast<std::size_t>(std::ceil(test.lead * rate));
  const auto points = track.lead + static_cast<std::size_t>(std::lround(test.duration * rate)) + 1;
  const auto time = [&](std::size_t k) { return (static_cast<double>(k) - static_cast<double>(track.lead)) / rate; };
  Run from = test;
  from.lead = static_cast<double>(track.lead) / rate;
  const Plant plant(physics, from, time(points));
  State state = plant.start();
  const State scales = plant.scales();
  double step = 0.25 / rate;
  for (std::vector<double>* channel : {&track.x, &track.v, &track.drive, &track.force}) channel->reserve(points);
  for (std::size_t k = 0; k < points; ++k) {
    const double t = time(k);
    if (k > 0) {
      advance(state, time(k - 1), t, step, 1e-6, scales, [&](double at, const State& s) { return plant.rate(at, s); });
      state[void_length] = std::max(state[void_length], 0.0);
    }
    const Kinematics rod = test.motion.at(t);
    track.x.push_back(rod.x);
    track.v.push_back(rod.v);
    track.drive.push_back(test.drive.at(t));
    track.force.push_back(plant.force(t, state));
  }
  return track;
}

}  // namespace hysteron::challenge
