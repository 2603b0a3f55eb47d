// What every target of `export` starts from: an identified model, and a motion with its force to check a copy with.
#pragma once

#include <string>
#include <vector>

#include "core/recording.hpp"
#include "export/equations.hpp"
#include "fit/layout.hpp"

namespace hysteron {

// Between two samples, where the stiffness of the equations is not asked for more or fewer.
inline constexpr int default_most_substeps = 65536;

struct ExportedModel {
  CompositeModel model;
  std::vector<double> held;
  std::vector<Term> terms;
  std::string name;         // as names.hpp wants it
  double tolerance = 1e-4;  // of the integration, as in simulate
  int most_substeps = default_most_substeps;
  int substeps = 0;                   // always so many; 0: as many as the stiffness asks for
  DriveKind drive = DriveKind::none;  // what the drive is; none: not known
  std::string holds_at = {};          // "pressure = 2e5 Pa": values of conditions that it holds at; empty: of none

  [[nodiscard]] std::string title() const;  // and the conditions it holds at
  [[nodiscard]] bool follows_drive() const;
  [[nodiscard]] bool follows_frequency() const;
  // s by which the drive has to be given ahead of the motion, where an effect leads it and parameters follow it; else
  // 0.
  [[nodiscard]] double drive_ahead() const;
  // What the drive of a sample is: its unit, and its time where it is given ahead.
  [[nodiscard]] std::string about_drive() const;
};

// A part in its place: law first, then the effects from the law outwards.
struct ExportedLink {
  const Part* part;
  PartEquations equations;
  std::string name;  // of its functions
  std::size_t parameter;
  int state;
  int memory;  // of an excite operation; -1: none
};
// Throws InputError where the model needs the drive of a sample and the drive ahead of it.
std::vector<ExportedLink> links_of(const ExportedModel& exported);
// Whether the force is another under another drive: parameters follow it, or equations take it.
bool takes_drive(const ExportedModel& exported, const std::vector<ExportedLink>& links);

// Samples as simulate sees them.
struct TestSample {
  double time;
  double displacement;
  double velocity;
  double slope;
  double acceleration;
  double jerk;
  double drive;  // ahead of the sample by ExportedModel::drive_ahead
};
struct TestVector {
  double frequency = 0.0;           // Hz
  std::vector<TestSample> lead_in;  // marched beforehand, where the recording begins in mid-motion
  std::vector<TestSample> samples;
  std::vector<double> force;  // N, one a sample: as the exported code takes its steps, from one sample to the next
  // Largest difference to what simulate gives, as a share of its largest force.
  double off_simulate = 0.0;
  bool steps_limited = false;  // by --substeps or --most-substeps
  // Of the motion, where straight lines of it meet: later samples tell simulate of them, and exported code has none.
  std::size_t corners = 0;

  // By how much the force moves, as a share of its largest, where the motion does by one part in 10^12: far more where
  // the model jumps, as friction that sticks and slips does, the instant of which rounding decides.
  double off_rounding = 0.0;

  // By which a replay may differ, as a share of the largest force.
  [[nodiscard]] double allowed() const;
};
// InputError where the steps asked for are too few for the integration to stay finite, WorkError where the force does
// not stay finite whatever the steps.
TestVector test_vector(const ExportedModel& exported, const Recording& motion);

// A motion from rest with two tones, 10 mm, and a drive that swings about 0.5.
Recording motion_for_testing();

}  // namespace hysteron
