#include "export/exported.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/error.hpp"
#include "core/extent.hpp"
#include "core/message.hpp"
#include "export/fixed_steps.hpp"
#include "export/names.hpp"
#include "export/writer.hpp"
#include "fit/objective.hpp"
#include "fit/predict.hpp"
#include "fit/start.hpp"
#include "simulate/command.hpp"

namespace hysteron {

std::string ExportedModel::title() const {
  std::string text(model.law->title);
  for (const Part* effect : model.effects) {
    text += ", " + std::string(effect->id);
  }
  return holds_at.empty() ? text : text + ", at " + holds_at;
}

bool ExportedModel::follows_drive() const {
  return std::ranges::any_of(terms, [](const Term& term) { return term.drive_power > 0; });
}

bool ExportedModel::follows_frequency() const {
  return std::ranges::any_of(terms, [](const Term& term) { return term.frequency_power > 0; });
}

double ExportedModel::drive_ahead() const {
  double ahead = 0.0;
  model.for_links([&](const Link& link) {
    if (link.part->on_double.recall == nullptr) return;
    for (const Term& term : terms) {
      if (term.parameter == link.parameter && term.drive_power + term.frequency_power == 0) {
        ahead = std::max(ahead, -term.value);
      }
    }
  });
  return follows_drive() ? ahead : 0.0;
}

std::string ExportedModel::about_drive() const {
  const double ahead = drive_ahead();
  const std::string unit = drive == DriveKind::none ? "A or V" : drive == DriveKind::voltage ? "V" : "A";
  return ahead > 0.0 ? fmt::format("{}, of {} s after the sample", unit, ahead) : unit;
}

namespace {

// Whether the equations of a part take the drive itself.
bool in_equations(const ExportedLink& link) {
  const PartEquations& e = link.equations;
  for (const std::optional<Function>* function : {&e.drive, &e.rate, &e.force, &e.towards}) {
    if (!*function) continue;
    const Statements statements = write_statements(**function, link.part->parameters, Language::c);
    if (std::ranges::find(statements.used, Argument::drive, &ArgumentNumber::argument) != statements.used.end()) {
      return true;
    }
  }
  return false;
}

// Where the drive is given ahead: whether equations take that of the sample, or operations on the drive parameters
// at it.
bool needs_drive_of_sample(const ExportedModel& exported, const ExportedLink& link) {
  if (in_equations(link)) return true;
  const PartEquations& e = link.equations;
  const std::size_t end = link.parameter + link.part->parameters.size();
  return (e.excite || e.recall) && std::ranges::any_of(exported.terms, [&](const Term& term) {
           const bool varies = term.drive_power > 0 || (e.recall && term.frequency_power > 0);
           return term.parameter >= link.parameter && term.parameter < end && varies;
         });
}

// The drive that is given ahead, as the recall of an effect sees it.
void give_ahead(double ahead, const Motion& motion, std::vector<TestSample>& samples) {
  if (ahead <= 0.0 || motion.drive.empty()) return;
  for (std::size_t n = 0; n < samples.size(); ++n) {
    samples[n].drive = Command{motion.time, motion.drive, n}.earlier(-ahead);
  }
}

}  // namespace

std::vector<ExportedLink> links_of(const ExportedModel& exported) {
  std::vector<ExportedLink> result;
  std::set<std::string> names;
  int memory = 0;
  exported.model.for_links([&](const Link& at) {
    ExportedLink link{at.part, equations_of(*at.part), identifier(at.part->id), at.parameter, at.state, -1};
    if (!names.insert(link.name).second) {
      link.name += "_" + std::to_string(result.size());
      names.insert(link.name);
    }
    if (!exported.follows_drive()) {
      // They act on parameters that follow the drive only.
      link.equations.recall.reset();
      link.equations.excite.reset();
      link.equations.excite_first.reset();
    }
    if (link.equations.excite) {
      link.memory = memory++;
    }
    result.push_back(std::move(link));
  });
  if (exported.drive_ahead() > 0.0) {
    for (ExportedLink& link : result) {
      if (needs_drive_of_sample(exported, link)) {
        throw InputError(fmt::format(
            "export: {} needs the drive of the sample itself, which is given {:g} s ahead because an effect leads it; "
            "expected a delay >= 0 or no parameter that follows the drive",
            link.part->id, exported.drive_ahead()));
      }
      link.equations.recall.reset();  // the drive comes as it acts
    }
  }
  return result;
}

bool takes_drive(const ExportedModel& exported, const std::vector<ExportedLink>& links) {
  return exported.follows_drive() || std::ranges::any_of(links, in_equations);
}

Recording motion_for_testing() {
  constexpr double rate = 500.0;
  constexpr double duration = 1.4;
  constexpr double amplitude = 0.01;
  constexpr double rise = 0.3;
  constexpr double w = 2.0 * std::numbers::pi * 1.7;
  Recording recording;
  recording.file = "the test motion";
  recording.drive_kind = DriveKind::current;
  for (int n = 0; n <= static_cast<int>(rate * duration); ++n) {
    const double t = n / rate;
    // Rises over 0.3 s with continuous slope and curvature.
    const double u = std::min(t / rise, 1.0);
    const double envelope = u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
    const double envelope_slope = 30.0 * u * u * (1.0 - u) * (1.0 - u) / rise;
    const double shape = std::sin(w * t) + 0.3 * std::sin(2.6 * w * t);
    const double shape_slope = w * (std::cos(w * t) + 0.78 * std::cos(2.6 * w * t));
    recording.time.push_back(t);
    recording.displacement.push_back(amplitude * envelope * shape);
    recording.velocity.push_back(amplitude * (envelope * shape_slope + envelope_slope * shape));
    recording.drive.push_back(0.5 + 0.4 * std::sin(5.0 * t));
  }
  return recording;
}

namespace {

std::vector<TestSample> samples_of(const Motion& motion) {
  std::vector<TestSample> result;
  for (std::size_t n = 0; n < motion.time.size(); ++n) {
    result.push_back({motion.time[n], motion.x[n], motion.v[n], velocity_slope(motion, n), motion.a[n], motion.jerk[n],
                      motion.drive.empty() ? 0.0 : motion.drive[n]});
  }
  return result;
}

// As the exported code sees the samples.
Target without_foresight(Target target) {
  target.motion = without_foresight(std::move(target.motion));
  if (target.preroll > 0) target.lead_in = beginning_of(target.motion, target.lead_in.time.size());
  return target;
}

// In the steps that the exported code takes.
std::vector<double> force_as_exported(const ExportedModel& exported, Target& target) {
  if (exported.substeps > 0) {
    return force_in_fixed_steps(exported, target);
  }
  target.motion.most_substeps = exported.most_substeps;
  target.lead_in.most_substeps = exported.most_substeps;
  return predict(exported.model, exported.held, exported.terms, target);
}

// Steps with which the march stays finite, as it does with as many as simulate takes.
int enough_steps(ExportedModel exported, Target& target, const Recording& recording) {
  int& steps = exported.substeps > 0 ? exported.substeps : exported.most_substeps;
  while (2 * steps < default_most_substeps) {
    steps *= 2;
    if (!diverges_at(force_as_exported(exported, target), recording)) {
      return steps;
    }
  }
  return default_most_substeps;
}

// Travel, heat or wear that count from the first sample: exported code cannot leave a period beforehand out of them.
bool counts_from_start(const CompositeModel& model) {
  bool counts = false;
  model.for_links([&](const Link& link) { counts = counts || link.part->on_double.begin != nullptr; });
  return counts;
}

// Largest difference of two forces, N.
double largest_apart(const std::vector<double>& a, const std::vector<double>& b) {
  double apart = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) apart = std::max(apart, std::fabs(a[n] - b[n]));
  return apart;
}

// By how much the force moves where the motion does by a part that is beyond all rounding and below all else, N.
double moved_by_rounding(const ExportedModel& exported, const Recording& recording, const ObjectiveOptions& options,
                         const std::vector<double>& force) {
  constexpr double part = 1e-12;
  double moved = 0.0;
  for (const double by : {1.0 - part, 1.0 + part}) {
    Recording other = recording;
    for (double& x : other.displacement) x *= by;
    for (double& v : other.velocity) v *= by;
    Target seen = without_foresight(make_target(other, options, false));
    moved = std::max(moved, largest_apart(force_as_exported(exported, seen), force));
  }
  return moved;
}

}  // namespace

double TestVector::allowed() const {
  constexpr double rounding = 1e-6;
  // Steps that hardly hold the equations let rounding grow: two runs then agree to a part of what either is off.
  constexpr double of_the_error = 0.01;
  // One run may be on either side of the jumps.
  constexpr double either_side = 2.0;
  return std::max({rounding, steps_limited ? of_the_error * off_simulate : 0.0, either_side * off_rounding});
}

TestVector test_vector(const ExportedModel& exported, const Recording& motion) {
  Recording recording = motion;
  recording.start = counts_from_start(exported.model) ? Start::from_nothing : start_of(recording);
  recording.force.clear();
  recording.earlier.clear();  // exported code begins cold and as new
  ObjectiveOptions options;
  options.tolerance = exported.tolerance;
  const Target target = make_target(recording, options, false);
  const std::vector<double> wanted = predict(exported.model, exported.held, exported.terms, target);
  if (const auto time = diverges_at(wanted, recording)) {
    throw WorkError(fmt::format(
        "export: the force of the model does not stay finite on {} from {:g} s on, so that there is "
        "nothing to check an exported copy with; expected the motion of a recording that the model holds for",
        recording.file, *time));
  }
  Target seen = without_foresight(target);
  TestVector result;
  result.frequency = seen.frequency;
  result.samples = samples_of(seen.motion);
  result.corners = target.motion.beyond_corners.size();
  give_ahead(exported.drive_ahead(), seen.motion, result.samples);
  if (seen.preroll > 0) {
    result.lead_in = samples_of(seen.lead_in);
    give_ahead(exported.drive_ahead(), seen.lead_in, result.lead_in);
  }
  result.steps_limited = exported.substeps > 0 || exported.most_substeps != default_most_substeps;
  result.force = force_as_exported(exported, seen);
  if (const auto time = diverges_at(result.force, recording)) {
    const bool fixed = exported.substeps > 0;
    const int steps = fixed ? exported.substeps : exported.most_substeps;
    throw OptionError(
        (fixed ? Option::substeps : Option::most_substeps) +
        fmt::format(" {}: too few steps between two samples, the force does not stay finite on {} from {:g} s on; "
                    "expected {} or more{}",
                    steps, recording.file, *time, enough_steps(exported, seen, recording),
                    fixed ? ", or 0 for as many as the stiffness asks for" : ""));
  }
  const double peak = peak_of(wanted);
  if (peak > 0.0) {
    result.off_simulate = largest_apart(result.force, wanted) / peak;
    result.off_rounding = moved_by_rounding(exported, recording, options, result.force) / peak;
  }
  return result;
}

}  // namespace hysteron
