#include "export/exported.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <set>

#include "core/error.hpp"
#include "fit/objective.hpp"
#include "fit/start.hpp"

namespace hysteron {

std::string ExportedModel::title() const {
  std::string text(model.law->title);
  for (const Part* effect : model.effects) {
    text += ", " + std::string(effect->id);
  }
  return text;
}

bool ExportedModel::follows_drive() const {
  return std::ranges::any_of(terms, [](const Term& term) { return term.drive_power > 0; });
}

bool ExportedModel::follows_frequency() const {
  return std::ranges::any_of(terms, [](const Term& term) { return term.frequency_power > 0; });
}

std::string identifier(std::string_view text) {
  std::string result;
  for (const char letter : text) {
    result += std::isalnum(static_cast<unsigned char>(letter)) != 0 ? letter : '_';
  }
  if (result.empty() || std::isdigit(static_cast<unsigned char>(result[0])) != 0) {
    result.insert(0, "m_");
  }
  return result;
}

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
  for (const ExportedLink& link : result) {
    if (!link.equations.recall) {
      continue;
    }
    for (const Term& term : exported.terms) {
      if (term.parameter == link.parameter && term.drive_power + term.frequency_power == 0 && term.value < 0.0) {
        throw InputError("export: " + std::string(link.part->id) +
                         " leads the recorded drive, which a step at a time does not know; expected " +
                         std::string(link.part->parameters[0].name) + " >= 0 or no parameter that follows the drive");
      }
    }
  }
  return result;
}

Recording motion_for_testing() {
  constexpr double rate = 500.0;
  constexpr double duration = 1.4;
  constexpr double amplitude = 0.01;
  constexpr double rise = 0.3;
  constexpr double w = 2.0 * std::numbers::pi * 1.7;
  Recording recording;
  recording.file = "test motion";
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
    double slope = 0.0;
    if (n < motion.intervals.size()) {
      slope = motion.intervals[n].v[1] / motion.intervals[n].length;
    } else if (n > 0) {
      slope = cubic_slope(motion.intervals[n - 1].v, 1.0) / motion.intervals[n - 1].length;
    }
    result.push_back({motion.time[n], motion.x[n], motion.v[n], slope, motion.a[n], motion.jerk[n],
                      motion.drive.empty() ? 0.0 : motion.drive[n]});
  }
  return result;
}

}  // namespace

TestVector test_vector(const ExportedModel& exported, const Recording& motion) {
  Recording recording = motion;
  recording.start = start_of(recording);
  recording.force.clear();
  ObjectiveOptions options;
  options.tolerance = exported.tolerance;
  const Target target = make_target(recording, options);
  TestVector result;
  result.frequency = target.frequency;
  result.samples = samples_of(target.motion);
  if (target.preroll > 0) {
    result.lead_in = samples_of(target.lead_in);
  }
  result.force = predict(exported.model, exported.held, exported.terms, target);
  return result;
}

}  // namespace hysteron
