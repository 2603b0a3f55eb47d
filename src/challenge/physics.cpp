#include "challenge/physics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "challenge/dormand_prince.hpp"
#include "challenge/electric.hpp"
#include "core/error.hpp"

namespace hysteron::challenge {
namespace {

// Of a grid point, on average, a twentieth of the track ahead: most dampers take four, the stiffest 140.
constexpr std::size_t most_steps = 200;

// The first states are the plant's, those of the parts follow.
enum Index : std::size_t {
  hysteresis,  // z
  slip,        // x - y of the modified Bouc-Wen
  inner,       // displacement of the damper behind what is in series
  leak,        // m, stretch of a dashpot that stands in a row with an elastic element
  plant_states
};

class State {
 public:
  static constexpr std::size_t most = 48;
  explicit State(std::size_t size) : size_(size) {}
  [[nodiscard]] std::size_t size() const { return size_; }
  double& operator[](std::size_t n) { return values_[n]; }
  const double& operator[](std::size_t n) const { return values_[n]; }
  double* at(std::size_t n) { return values_.data() + n; }
  [[nodiscard]] const double* at(std::size_t n) const { return values_.data() + n; }

 private:
  std::array<double, most> values_{};
  std::size_t size_;
};

// The motion on a grid, between its points by the polynomial of degree 5 that has displacement, velocity and
// acceleration at both: many sines are summed once a point and not in every stage of every step.
class MotionGrid {
 public:
  MotionGrid(const Motion& motion, double begin, double rate, std::size_t points) : begin_(begin), rate_(rate) {
    points_.reserve(points + 2);
    for (std::size_t k = 0; k < points + 2; ++k) {
      points_.push_back(motion.at(begin + static_cast<double>(k) / rate));
    }
  }
  [[nodiscard]] const Kinematics& point(std::size_t k) const { return points_[k]; }
  [[nodiscard]] Kinematics at(double t) const {
    const double place = std::clamp((t - begin_) * rate_, 0.0, static_cast<double>(points_.size()) - 1.000001);
    const auto k = static_cast<std::size_t>(place);
    const double u = place - static_cast<double>(k);
    const Kinematics& p = points_[k];
    const Kinematics& q = points_[k + 1];
    const double h = 1.0 / rate_;
    const double x0 = p.x, v0 = p.v * h, a0 = 0.5 * p.a * h * h;
    // What the parabola of the first point leaves at the second.
    const double dx = q.x - x0 - v0 - a0;
    const double dv = q.v * h - v0 - 2.0 * a0;
    const double da = 0.5 * q.a * h * h - a0;
    const double c3 = 10.0 * dx - 4.0 * dv + da;
    const double c4 = -15.0 * dx + 7.0 * dv - 2.0 * da;
    const double c5 = 6.0 * dx - 3.0 * dv + da;
    return {x0 + u * (v0 + u * (a0 + u * (c3 + u * (c4 + u * c5)))),
            (v0 + u * (2.0 * a0 + u * (3.0 * c3 + u * (4.0 * c4 + u * 5.0 * c5)))) * rate_,
            (2.0 * a0 + u * (6.0 * c3 + u * (12.0 * c4 + u * 20.0 * c5))) * rate_ * rate_};
  }

 private:
  double begin_, rate_;
  std::vector<Kinematics> points_;
};

class Plant {
 public:
  Plant(const Physics& physics, const Run& test, const MotionGrid& motion, double end)
      : p_(physics), test_(test), motion_(motion), field_(physics, test.drive, -test.lead, end) {
    for (const PartPointer& part : p_.parts) {
      parts_.push_back({part.get(), size_});
      size_ += part->states();
      if (part->chain() != InSeries::none) series_.push_back(parts_.back());
    }
    std::vector<InSeries> chain;
    for (const Placed& element : series_) chain.push_back(element.part->chain());
    if (!can_stand_in_series(chain)) throw InputError("no force balance for these elements in series");
    if (size_ > State::most) throw InputError("too many mechanisms in one damper");
    // The elastic one first.
    if (series_.size() == 2 && series_[0].part->chain() == InSeries::dashpot) std::swap(series_[0], series_[1]);
    full_z_ = is_bouc_wen() ? std::pow(p_.A / (p_.beta + p_.gamma), 1.0 / p_.n) : p_.x_b;
  }

  [[nodiscard]] State start(std::span<const double> before) const {
    State s(size_);
    Moment m = moment(-test_.lead);
    s[inner] = m.rod.x;
    for (const Placed& placed : parts_) {
      if (test_.pause && placed.part->goes_on() && !before.empty()) {
        std::copy_n(before.data() + placed.from - plant_states, placed.part->states(), s.at(placed.from));
        placed.part->rest(*test_.pause, s.at(placed.from));
      } else {
        placed.part->start(m, s.at(placed.from));
      }
    }
    return s;
  }
  [[nodiscard]] std::vector<double> of_parts(const State& s) const {
    return {s.at(plant_states), s.at(plant_states) + (size_ - plant_states)};
  }

  [[nodiscard]] State scales() const {
    State s(size_);
    s[hysteresis] = is_bouc_wen() ? full_z_ : p_.x_b;
    s[slip] = is_modified() ? full_z_ : p_.length_scale;
    s[inner] = s[leak] = p_.length_scale;
    const Scale scale{p_.force_scale, p_.length_scale, std::max(test_.peak_speed, 1e-3)};
    for (const Placed& placed : parts_) placed.part->scales(scale, s.at(placed.from));
    return s;
  }

  void settle(double t, State& s) const {
    const Moment m = moment(t);
    for (const Placed& placed : parts_) placed.part->settle(m, s.at(placed.from));
  }

  [[nodiscard]] double force(double t, const State& s) const {
    const Moment m = balance(t, s);
    double total = m.core;
    for (const Placed& placed : parts_) total += placed.part->beside(m, s.at(placed.from));
    return total;
  }

  [[nodiscard]] State rate(double t, const State& s) const {
    const Moment m = balance(t, s);
    State d(size_);
    const double u = is_modified() ? slip_speed(m, s, m.v) : m.v;
    d[hysteresis] = hysteresis_rate(m, s, u);
    if (is_modified()) d[slip] = u;
    d[inner] = m.v;
    if (series_.size() == 2 && series_[1].part->chain() == InSeries::dashpot) d[leak] = series_[1].part->creep(m.core);
    for (const Placed& placed : parts_) placed.part->rate(m, s.at(placed.from), d.at(placed.from));
    return d;
  }

 private:
  struct Placed {
    const Part* part;
    std::size_t from;  // its first state
  };

  [[nodiscard]] bool is_bouc_wen() const { return p_.law == Law::bouc_wen || p_.law == Law::modified_bouc_wen; }
  [[nodiscard]] bool is_modified() const { return p_.law == Law::modified_bouc_wen; }

  [[nodiscard]] Moment moment(double t) const {
    Moment m;
    m.t = t;
    m.test = test_.number;
    m.rod = motion_.at(t);
    if (p_.acting_delay > 0.0) m.rod.v = motion_.at(t - p_.acting_delay).v;
    m.middle = test_.motion.offset;
    m.drive = field_.at(t);
    m.x = m.rod.x;
    m.v = m.rod.v;
    return m;
  }

  [[nodiscard]] double yield(const Moment& m, const State& s) const {
    double value = p_.alpha_a + p_.alpha_b * m.drive;
    for (const Placed& placed : parts_) value *= placed.part->yield(m, s.at(placed.from));
    return value;
  }
  [[nodiscard]] double damping(const Moment& m, const State& s, double v) const {
    double c = p_.c_a + p_.c_b * m.drive;
    for (const Placed& placed : parts_) c *= placed.part->damping(m, s.at(placed.from), v);
    return c;
  }

  [[nodiscard]] double slip_speed(const Moment& m, const State& s, double v) const {
    const double c = damping(m, s, v);
    return (p_.c1 * v - p_.k0 * s[slip] - yield(m, s) / full_z_ * s[hysteresis]) / (c + p_.c1);
  }

  [[nodiscard]] double lugre_level(double v) const {
    return 1.0 + (p_.ratio - 1.0) * std::exp(-(v / p_.v_st) * (v / p_.v_st));
  }

  [[nodiscard]] double hysteresis_rate(const Moment& m, const State& s, double u) const {
    const double z = s[hysteresis];
    if (p_.law == Law::lugre) return u - std::abs(u) * z / (p_.x_b * lugre_level(u));
    if (!is_bouc_wen()) return 0.0;
    const double grip = std::pow(std::abs(z), p_.n - 1.0);
    double d = p_.A * u - p_.beta * std::abs(u) * z * grip - p_.gamma * u * std::abs(z) * grip;
    for (const Placed& placed : parts_) d *= placed.part->hysteresis(m, u, z / full_z_);
    return d;
  }

  // Hysteretic force over yield force at the damper's speed v.
  [[nodiscard]] double branch(const Moment& m, const State& s, double v) const {
    switch (p_.law) {
      case Law::bouc_wen:
      case Law::modified_bouc_wen:
      case Law::lugre:
        return std::clamp(s[hysteresis] / full_z_, -1.0, 1.0);
      case Law::tanh_hysteresis:
        return std::tanh((v + p_.v_h * std::tanh((m.x - m.middle) / p_.sign_length)) / p_.v_y);
      case Law::bingham:
        return std::tanh(v / p_.sign_speed);
    }
    return 0.0;
  }

  // Force of the damper proper at its speed v.
  [[nodiscard]] double core_at(Moment& m, const State& s, double v) const {
    m.v = v;
    m.branch = branch(m, s, v);
    const double c = damping(m, s, v);
    const double alpha = yield(m, s);
    const double z = s[hysteresis];
    double f = 0.0;
    double held = p_.k0 * m.x + p_.f0;
    switch (p_.law) {
      case Law::bouc_wen:
        f = alpha / full_z_ * z + c * v;
        break;
      case Law::modified_bouc_wen:
        f = p_.c1 * (v - slip_speed(m, s, v));
        held = p_.k1 * m.x;
        break;
      case Law::tanh_hysteresis:
      case Law::bingham:
        f = alpha * m.branch + c * v;
        break;
      case Law::lugre:
        f = alpha / p_.x_b * z + p_.s1 * (v - std::abs(v) * z / (p_.x_b * lugre_level(v))) + c * v;
        break;
    }
    for (const Placed& placed : parts_) f += placed.part->fluid(m, s.at(placed.from), v);
    for (const Placed& placed : parts_) f = placed.part->whole(m, s.at(placed.from), v, f);
    return f + held;
  }

  // The damper's speed at which its force is the wanted one (a number, or what the series element passes on): Newton's
  // method inside a bracket; the difference rises with the speed.
  template <class Wanted>
  double solve(Moment& m, const State& s, const Wanted& wanted) const {
    const double fine = 1e-9 * p_.force_scale;
    const auto excess = [&](double v) { return core_at(m, s, v) - wanted(v); };
    double v = m.rod.v;
    double g = excess(v);
    double low = v;
    double high = v;
    double reach = std::max(0.1 * std::abs(v), 1e-3);
    while ((g > 0.0) == (excess(g > 0.0 ? low : high) > 0.0) && reach < 1e4) {
      (g > 0.0 ? low : high) += g > 0.0 ? -reach : reach;
      reach *= 4.0;
    }
    for (int k = 0; k < 80 && std::abs(g) > fine && high - low > 1e-13; ++k) {
      (g > 0.0 ? high : low) = v;
      const double h = 1e-6 + 1e-6 * std::abs(v);
      const double slope = (excess(v + h) - g) / h;
      const double newton = v - g / slope;
      v = slope > 0.0 && newton > low && newton < high && k < 40 ? newton : 0.5 * (low + high);
      g = excess(v);
    }
    return v;
  }

  // The force of two elastic elements in a row: the first stretch between 0 and the whole at which both pass on the
  // same.
  [[nodiscard]] double row_force(const Moment& m, double stretch) const {
    const Part& first = *series_[0].part;
    const Part& second = *series_[1].part;
    double low = std::min(0.0, stretch);
    double high = std::max(0.0, stretch);
    for (int k = 0; k < 60 && high - low > 1e-15; ++k) {
      const double middle = 0.5 * (low + high);
      const double a = first.series(m, nullptr, middle, 0.0);
      const double b = second.series(m, nullptr, stretch - middle, 0.0);
      if (a == b) return a;
      (a > b ? high : low) = middle;
    }
    return first.series(m, nullptr, 0.5 * (low + high), 0.0);
  }

  [[nodiscard]] Moment balance(double t, const State& s) const {
    Moment m = moment(t);
    if (series_.empty()) {
      m.core = core_at(m, s, m.rod.v);
      return m;
    }
    m.x = s[inner];
    m.stretch = m.rod.x - m.x;
    double v = 0.0;
    if (series_.size() == 1) {
      const Placed& element = series_.front();
      if (element.part->chain() == InSeries::elastic) {
        const double f = element.part->series(m, s.at(element.from), m.stretch, 0.0);
        v = solve(m, s, [f](double) { return f; });
      } else {
        v = solve(m, s, [&](double speed) {
          return element.part->series(m, s.at(element.from), m.stretch, m.rod.v - speed);
        });
      }
    } else if (series_[1].part->chain() == InSeries::dashpot) {
      const double f = series_[0].part->series(m, nullptr, m.stretch - s[leak], 0.0);
      v = solve(m, s, [f](double) { return f; });
    } else {
      const double f = row_force(m, m.stretch);
      v = solve(m, s, [f](double) { return f; });
    }
    m.core = core_at(m, s, v);
    m.stretch_rate = m.rod.v - v;
    return m;
  }

  const Physics& p_;
  const Run& test_;
  const MotionGrid& motion_;
  Field field_;
  std::vector<Placed> parts_;
  std::vector<Placed> series_;
  std::size_t size_ = plant_states;
  double full_z_ = 1.0;
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

bool can_stand_in_series(const std::vector<InSeries>& chain) {
  const auto count = [&](InSeries kind) { return std::ranges::count(chain, kind); };
  const auto all = static_cast<std::ptrdiff_t>(chain.size()) - count(InSeries::none);
  if (all <= 1) return true;
  return all == 2 && count(InSeries::whole) == 0 && count(InSeries::dashpot) <= 1;
}

Track simulate(const Physics& physics, const Run& test, double rate, std::span<const double> before) {
  Track track;
  track.rate = rate;
  track.lead = static_cast<std::size_t>(std::ceil(test.lead * rate));
  const auto points = track.lead + static_cast<std::size_t>(std::lround(test.duration * rate)) + 1;
  const auto time = [&](std::size_t k) { return (static_cast<double>(k) - static_cast<double>(track.lead)) / rate; };
  Run from = test;
  from.lead = static_cast<double>(track.lead) / rate;
  const MotionGrid motion(test.motion, -from.lead, rate, points);
  const Plant plant(physics, from, motion, time(points));
  State state = plant.start(before);
  const State scales = plant.scales();
  double step = 0.25 / rate;
  std::size_t steps = 0;
  for (std::vector<double>* channel : {&track.x, &track.v, &track.drive, &track.force}) channel->reserve(points);
  for (std::size_t k = 0; k < points; ++k) {
    const double t = time(k);
    if (k > 0) {
      steps += advance(state, time(k - 1), t, step, 1e-6, scales,
                       [&](double at, const State& s) { return plant.rate(at, s); });
      if (steps > most_steps * (k + points / 20)) throw TooStiff{};
    }
    plant.settle(t, state);
    const Kinematics& rod = motion.point(k);
    track.x.push_back(rod.x);
    track.v.push_back(rod.v);
    track.drive.push_back(test.drive.at(t));
    track.force.push_back(plant.force(t, state));
  }
  track.end = plant.of_parts(state);
  return track;
}

}  // namespace hysteron::challenge
