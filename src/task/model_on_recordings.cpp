// A stored model beside recordings or numbers: the conditions that its laws follow, and what would make its force
// another.
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/message.hpp"
#include "core/suggest.hpp"
#include "io/conditions.hpp"
#include "io/value_hash.hpp"
#include "task/model_file.hpp"
#include "task/rate.hpp"

namespace hysteron {

std::optional<double> clock_since(const std::vector<Recording>& recordings) {
  std::optional<double> since;
  for (const Recording& recording : recordings) {
    const auto clock = std::ranges::find(recording.conditions, clock_condition, &ConditionChannel::name);
    if (clock == recording.conditions.end() || clock->values.size() != 1 || !recording.started) return std::nullopt;
    const double zero = *recording.started - clock->values.front();
    constexpr double rounding = 1e-3;  // s
    if (since && std::fabs(zero - *since) > rounding) return std::nullopt;
    since = since.value_or(zero);
  }
  return since;
}

bool StoredModel::follows_frequency() const {
  return std::ranges::any_of(terms, [](const Term& term) { return term.frequency_power > 0; });
}

std::vector<std::string> conditions_of(const std::vector<const StoredModel*>& models) {
  std::set<std::string> result;
  for (const StoredModel* model : models) {
    for (const ConditionRange& condition : model->conditions) result.insert(condition.name);
  }
  return {result.begin(), result.end()};
}

namespace {

// What --at gives but none of these names.
void refuse_others(const std::map<std::string, ConditionNumber>& values, const std::vector<std::string>& followed) {
  for (const auto& [name, number] : values) {
    if (std::ranges::find(followed, name) != followed.end()) continue;
    std::string expected;
    for (const std::string& one : followed) {
      expected += (expected.empty() ? "" : &one == &followed.back() ? " or " : ", ") + one;
    }
    throw OptionError(Option::at + ": no parameter of the model follows '" + name + "'" + suggestion(name, followed) +
                      ", expected " +
                      (expected.empty() ? "no " + Option::at + ", since they follow nothing that it gives" : expected));
  }
}

// What the motion and its drive give all along is no number, though parameters follow it.
void refuse_number_for(const std::string& name, bool followed, const std::map<std::string, ConditionNumber>& values,
                       const std::string& why) {
  if (!followed || !values.contains(name)) return;
  throw OptionError(Option::at + ": the " + name + " " + why + ", expected no number for it");
}

// Terms that followed `from` and now follow `to`, which holds them all.
void reorder(StoredModel& stored, const std::vector<ConditionRange>& to) {
  for (Term& term : stored.terms) {
    std::vector<int> powers(to.size(), 0);
    for (std::size_t c = 0; c < term.condition_powers.size(); ++c) {
      const auto at = std::ranges::find(to, stored.conditions[c].name, &ConditionRange::name);
      powers[static_cast<std::size_t>(at - to.begin())] = term.condition_powers[c];
    }
    term.condition_powers = std::move(powers);
  }
  stored.conditions = to;
}

// Laws in the clock count from `since`, as that of the recordings does: (clock + later)^k, multiplied out.
void count_clock_from(StoredModel& stored, double since) {
  const auto clock = std::ranges::find(stored.conditions, clock_condition, &ConditionRange::name);
  const auto c = static_cast<std::size_t>(clock - stored.conditions.begin());
  const double later = since - *stored.clock_since;
  const std::vector<Term> terms = std::move(stored.terms);
  stored.terms.clear();
  for (const Term& term : terms) {
    const int power = c < term.condition_powers.size() ? term.condition_powers[c] : 0;
    double factor = term.value;  // binomial coefficient and power of `later`
    for (int k = power; k >= 0; --k) {
      Term part = term;
      part.value = factor;
      if (power > 0) part.condition_powers[c] = k;
      const auto same = std::ranges::find_if(stored.terms, [&](const Term& other) {
        return other.parameter == part.parameter && other.same_powers(part);
      });
      if (same == stored.terms.end()) {
        stored.terms.push_back(part);
      } else {
        same->value += part.value;
      }
      factor *= later * k / (power - k + 1);
    }
  }
  clock->low -= later;
  clock->high -= later;
  stored.clock_since = since;
}

void refuse_other_unit(const ConditionRange& condition, const std::string& unit, const Message& where) {
  if (!unit.empty() && !condition.unit.empty() && unit != condition.unit) {
    throw OptionError(where + ": the " + condition.name + " is in '" + unit + "', expected '" + condition.unit +
                      "' as the model has it");
  }
}

}  // namespace

void refuse_unfollowed(const std::vector<const StoredModel*>& models,
                       const std::map<std::string, ConditionNumber>& values) {
  std::vector<std::string> followed = conditions_of(models);
  refuse_number_for("frequency", std::ranges::any_of(models, &StoredModel::follows_frequency), values,
                    "that parameters follow is the motion's own");
  for (const auto& [drive, name] : {std::pair{DriveKind::current, "current"}, {DriveKind::voltage, "voltage"}}) {
    if (std::ranges::find(models, drive, &StoredModel::drive) != models.end()) followed.emplace_back(name);
  }
  refuse_others(values, followed);
}

void follow_conditions(StoredModel& stored, const std::vector<Recording>& recordings) {
  if (recordings.empty()) return;
  const std::vector<ConditionChannel>& first = recordings.front().conditions;
  for (const Recording& recording : recordings) {
    for (const ConditionRange& condition : stored.conditions) {
      const auto here = std::ranges::find(recording.conditions, condition.name, &ConditionChannel::name);
      if (here == recording.conditions.end()) {
        throw InputError(recording.file + ": read without the " + condition.name +
                         ", which parameters of the model follow, expected a column or a number for it");
      }
      refuse_other_unit(condition, here->unit, recording.file);
      if (here->unit != condition.unit) {
        const auto in = [](const std::string& unit) { return unit.empty() ? "has no unit" : "is in '" + unit + "'"; };
        throw InputError(recording.file + ": the " + condition.name + " " + in(here->unit) + ", and " +
                         in(condition.unit) + " in the model, expected a unit in both or in neither");
      }
    }
    if (!std::ranges::equal(recording.conditions, first, {}, &ConditionChannel::name, &ConditionChannel::name)) {
      throw InputError(recording.file + ": other conditions than " + recordings.front().file +
                       ", expected the same in all recordings");
    }
  }
  if (const auto since = stored.clock_since ? clock_since(recordings) : std::nullopt) count_clock_from(stored, *since);
  std::vector<ConditionRange> all;
  for (const ConditionChannel& channel : first) {
    const auto own = std::ranges::find(stored.conditions, channel.name, &ConditionRange::name);
    all.push_back(own == stored.conditions.end() ? ConditionRange{channel.name, channel.unit, 0.0, 0.0} : *own);
  }
  reorder(stored, all);
}

void hold_conditions(StoredModel& stored, const std::map<std::string, ConditionNumber>& values,
                     const std::string& command) {
  std::vector<double> at;
  for (const ConditionRange& condition : stored.conditions) {
    const auto found = values.find(condition.name);
    if (found == values.end()) {
      throw OptionError(command + ": parameters follow the " + condition.name + ", expected its value by " +
                        Option::at + " \"" + condition.name + "=NUMBER" +
                        (condition.unit.empty() ? "" : " " + condition.unit) + "\"");
    }
    refuse_other_unit(condition, found->second.unit, Option::at);
    at.push_back(found->second.value);
  }
  for (const auto& [name, followed] : {std::pair{"current", stored.drive == DriveKind::current},
                                       {"voltage", stored.drive == DriveKind::voltage},
                                       {"frequency", stored.follows_frequency()}}) {
    refuse_number_for(name, followed, values, "stays an input of the exported model");
  }
  refuse_others(values, conditions_of({&stored}));
  if (stored.conditions.empty()) return;
  std::vector<Term> held;
  for (Term& term : stored.terms) {
    for (std::size_t c = 0; c < term.condition_powers.size(); ++c) {
      for (int k = 0; k < term.condition_powers[c]; ++k) term.value *= at[c];
    }
    term.condition_powers.clear();
    const auto same = std::ranges::find_if(
        held, [&](const Term& other) { return other.parameter == term.parameter && other.same_powers(term); });
    if (same == held.end()) {
      held.push_back(std::move(term));
    } else {
      same->value += term.value;
    }
  }
  stored.terms = std::move(held);
  stored.conditions.clear();
}

bool was_fitted_on(const StoredModel& stored, const Recording& recording) {
  return stored.fitted_on.contains(recording.sha256) ||
         (!stored.fitted_values.empty() && stored.fitted_values.contains(sha256_of_values(recording)));
}

void check_rate(const StoredModel& stored, const std::vector<Recording>& recordings) {
  std::vector<bool> may_act(stored.held.size(), false);
  for (const Term& term : stored.terms) {
    may_act[term.parameter] = may_act[term.parameter] || term.value != 0.0;
  }
  require_no_rate(stored.model, may_act, stored.follows_frequency(), recordings, "a recording with time");
}

void check_drive(const StoredModel& stored, const std::string& path, const Recording& recording) {
  if (stored.drive == DriveKind::none || stored.drive == recording.drive_kind) return;
  if (recording.drive_kind == DriveKind::none) return;
  const auto word = [](DriveKind kind) { return std::string(kind == DriveKind::voltage ? "voltage" : "current"); };
  throw InputError(recording.file, 0,
                   "records a " + word(recording.drive_kind) + ", expected a " + word(stored.drive) +
                       ": parameters of " + path + " follow the " + word(stored.drive));
}

}  // namespace hysteron
