#include "task/effect_card.hpp"

#include <fmt/format.h>

#include <vector>

#include "diagnose/search/relatives.hpp"
#include "diagnose/search/wording.hpp"
#include "report/terminal.hpp"

namespace hysteron {
namespace {

using nlohmann::json;

std::string_view words_of(Acts acts) {
  switch (acts) {
    case Acts::by_place:
      return "by the place of the rod";
    case Acts::at_ends:
      return "near the ends of the motion only";
    case Acts::everywhere:
      break;
  }
  return "everywhere in the stroke";
}

std::string_view words_of(Need need) {
  switch (need) {
    case Need::drive:
      return "a recorded current or voltage";
    case Need::changing_drive:
      return "a current or voltage that changes within a recording";
    case Need::returning_drive:
      return "a current or voltage that rises and falls within a recording";
    case Need::three_drive_levels:
      return "three levels of current or voltage";
    case Need::velocity:
      return "a measured velocity";
    case Need::lagging_velocity:
      return "a measured velocity that lags or leads the slope of the displacement";
  }
  return "";
}

std::vector<std::string> needs_of(const Knowledge& known) {
  std::vector<std::string> result;
  for (const Need need : known.needs) {
    result.emplace_back(words_of(need));
  }
  return result;
}

json or_null(std::string_view text) { return text.empty() ? json(nullptr) : json(worded(text, DriveKind::current)); }

}  // namespace

json effect_card_json(const std::string& effect) {
  const Knowledge& known = knowledge_of(effect);
  json related = json::array();
  for (const Relation& row : relations_of(effect)) {
    related.push_back({{"id", row.id}, {"how", or_null(row.how)}});
  }
  json told_by = json::array();
  for (const ContrastSense& row : known.contrasts) {
    const ContrastCard& card = card_of(row.contrast);
    told_by.push_back({{"id", card.id}, {"what", card.what}, {"unit", card.unit}, {"sign", sign_of(row.sense)}});
  }
  return {{"family",
           known.family.id.empty() ? json(nullptr) : json{{"id", known.family.id}, {"title", known.family.title}}},
          {"shows", or_null(known.shows)},
          {"acts", words_of(known.acts)},
          {"needs", needs_of(known)},
          {"related", related},
          {"contrasts", told_by},
          {"experiment", or_null(known.experiment)},
          {"rig_cause", or_null(known.rig_cause)}};
}

std::string effect_card_text(const std::string& effect) {
  const Knowledge& known = knowledge_of(effect);
  std::string text;
  if (!known.family.id.empty()) {
    text += wrapped(fmt::format("Family: {}, {}", known.family.id, known.family.title), 2);
  }
  if (!known.shows.empty()) {
    text += wrapped("It shows: " + worded(known.shows, DriveKind::current), 2);
  }
  std::vector<std::string> told_by;
  for (const ContrastSense& row : known.contrasts) {
    const std::string_view sign = row.sense == Sense::positive   ? " (> 0)"
                                  : row.sense == Sense::negative ? " (< 0)"
                                                                 : "";
    told_by.push_back(fmt::format("{}{}", card_of(row.contrast).what, sign));
  }
  if (!told_by.empty()) {
    text += wrapped(fmt::format("Shown by: {}", fmt::join(told_by, "; ")), 2);
  }
  std::vector<std::string> related;
  for (const Relation& row : relations_of(effect)) {
    related.push_back(row.id + (row.how.empty() ? "" : " (" + row.how + ")"));
  }
  if (!related.empty()) {
    text += wrapped(fmt::format("Related effects: {}", fmt::join(related, ", ")), 2);
  }
  if (text.empty()) {
    return text;
  }
  text += fmt::format("Acts: {}\n", words_of(known.acts));
  text += wrapped(
      "Inputs needed: motion and force" + (known.needs.empty() ? "" : ", " + joined(needs_of(known), " and ")), 2);
  if (!known.experiment.empty()) {
    text += wrapped("Told apart by: " + worded(known.experiment, DriveKind::current), 2);
  }
  if (!known.rig_cause.empty()) {
    text += wrapped(
        fmt::format("May also come from outside the damper: {}", worded(known.rig_cause, DriveKind::current)), 2);
  }
  return text;
}

}  // namespace hysteron
