// One mechanism of a true damper. Every form of every effect is a type of its own with its parameters by name; what it
// does, it does at the sites below, and it keeps its own states. Written from the physics, apart from models/effects.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "challenge/excitation.hpp"

namespace hysteron::challenge {

// What a part sees of an instant.
struct Moment {
  double t = 0.0;                            // s, negative before the recording begins
  std::size_t test = 0;                      // number of the test in its campaign
  Kinematics rod;                            //
  double middle = 0.0;                       // m, of the motion
  double drive = 0.0;                        // A or V that magnetises the fluid
  double x = 0.0, v = 0.0;                   // of the damper behind what is in series with it
  double branch = 0.0;                       // hysteretic force over yield force, -1 to 1
  double core = 0.0;                         // N, of the damper; known to beside() and rate()
  double stretch = 0.0, stretch_rate = 0.0;  // of a series element; known to rate()
};

// Sizes of states, for error control.
struct Scale {
  double force = 1e3, length = 1e-2, speed = 0.1;
};

// What a part is in series. Two may stand in a row where at least one is elastic and the other elastic or a dashpot:
// then the force follows from the stretch alone, and the damper's speed from the force.
enum class InSeries { none, elastic, dashpot, whole };

// Where a part changes the command on its way to the field, in this order.
enum class FieldStage { none, supply, coil, remanence, saturation };

// As the catalogue calls it, where truth and catalogue mean the same quantity.
struct TrueParameter {
  std::string name;
  double value;
  std::string unit;
};

class Part {
 public:
  Part() = default;
  Part(const Part&) = default;
  Part& operator=(const Part&) = default;
  virtual ~Part() = default;

  // States: their number, their sizes, their first values, their rates (with m.core, m.v and the stretch known), and
  // what is done to them at every point of the grid (clamps, counts of events).
  [[nodiscard]] virtual std::size_t states() const { return 0; }
  virtual void scales(const Scale& scale, double* s) const {
    for (std::size_t k = 0; k < states(); ++k) s[k] = scale.length;
  }
  virtual void start(const Moment&, double* s) const {
    for (std::size_t k = 0; k < states(); ++k) s[k] = 0.0;
  }
  virtual void rate(const Moment&, const double*, double*) const {}
  virtual void settle(const Moment&, double*) const {}
  // Where the next test is of the same damper: whether the states go on, and what becomes of them in a pause of so many
  // seconds. Otherwise each test begins with the first values.
  [[nodiscard]] virtual bool goes_on() const { return false; }
  virtual void rest(double /*pause*/, double*) const {}

  // In the damper: factors on yield force, viscous damping at a speed and rate of the hysteresis (u drives it, `z` is
  // its state over the largest); a force beside those of the law; what becomes of the force so far.
  [[nodiscard]] virtual double yield(const Moment&, const double*) const { return 1.0; }
  [[nodiscard]] virtual double damping(const Moment&, const double*, double) const { return 1.0; }
  [[nodiscard]] virtual double hysteresis(const Moment&, double /*u*/, double /*z*/) const { return 1.0; }
  [[nodiscard]] virtual double fluid(const Moment&, const double*, double) const { return 0.0; }
  [[nodiscard]] virtual double whole(const Moment&, const double*, double, double f) const { return f; }

  // Parallel to the damper, N.
  [[nodiscard]] virtual double beside(const Moment&, const double*) const { return 0.0; }

  // In series: the force that is passed on at a stretch (m, rod less damper) and its rate, rising with both; of a
  // dashpot also the rate at a force.
  [[nodiscard]] virtual InSeries chain() const { return InSeries::none; }
  [[nodiscard]] virtual double series(const Moment&, const double*, double, double) const { return 0.0; }
  [[nodiscard]] virtual double creep(double /*force*/) const { return 0.0; }

  // On the way from command to field: `values` on a grid of `step` seconds that begins at `begin`.
  [[nodiscard]] virtual FieldStage field_stage() const { return FieldStage::none; }
  virtual void magnetise(std::vector<double>& /*values*/, double /*step*/, double /*begin*/) const {}

  // In the measuring chain: a channel on a grid of `rate` Hz.
  virtual void on_force(std::vector<double>& /*force*/, double /*rate*/) const {}
  virtual void on_velocity(std::vector<double>& /*velocity*/, double /*rate*/) const {}
  // s, by how much the recorded velocity is late: what a law fed with it sees.
  [[nodiscard]] virtual double velocity_delay() const { return 0.0; }

  [[nodiscard]] virtual std::vector<TrueParameter> parameters() const { return {}; }
};

using PartPointer = std::shared_ptr<const Part>;

}  // namespace hysteron::challenge
