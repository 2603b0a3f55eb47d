#include "diagnose/shown.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "diagnose/judge/speaking.hpp"
#include "diagnose/search/wording.hpp"

namespace hysteron {
namespace {

bool speaks_by_itself(const Signature& row) { return speaks({&row, loudness(row)}); }

// Whether a contrast no longer shows among others, or can no longer be taken.
bool no_longer_shows(const Signature& row, const std::vector<Signature>& others) {
  const auto at = std::ranges::find(others, row.id, &Signature::id);
  return at == others.end() || !shows({&*at, loudness(*at)});
}

// Those that speak, for none of the names and, where a name is more than a suggestion, of what the augmented model
// still leaves: one effect may show in several contrasts.
std::vector<const Signature*> untold(const std::vector<Signature>& signatures, const std::vector<Named>& names,
                                     const std::vector<Signature>& left) {
  const bool named = std::ranges::any_of(names, [](const Named& row) { return row.grade <= Grade::supported; });
  std::vector<const Signature*> result;
  for (const Signature& row : signatures) {
    if (named && no_longer_shows(row, left)) continue;
    const bool told = std::ranges::any_of(row.speaks_for, [&](const std::string& effect) {
      return std::ranges::find(names, effect, &Named::id) != names.end();
    });
    if (!told && speaks_by_itself(row)) {
      result.push_back(&row);
    }
  }
  std::ranges::stable_sort(result, std::greater{}, [](const Signature* row) { return loudness(*row); });
  return result;
}

std::string phrase_of(const Signature& row, const std::string& more) {
  return fmt::format("{}, {} ({}{})", row.what, size_text(row.value, row.unit, 2), recordings_text(row), more);
}

// Of a contrast over the square of the drive, whatever that is in.
constexpr std::string_view per_square = " per drive squared";

void name_unit(std::vector<Signature>& signatures, std::string_view square) {
  for (Signature& row : signatures) {
    if (row.unit.ends_with(per_square)) {
      row.unit.resize(row.unit.size() - per_square.size());
      row.unit.append("/").append(square);
    }
  }
}

}  // namespace

std::string recordings_text(const Signature& row) {
  return row.of_all ? fmt::format("one value of all {} recordings", row.recordings)
                    : fmt::format("{:.0f} of {} recordings",
                                  std::round(row.consistency * static_cast<double>(row.recordings)), row.recordings);
}

void name_units(Evidence& evidence, DriveKind drive) {
  if (drive == DriveKind::none) {
    return;
  }
  const std::string_view square = drive == DriveKind::voltage ? "V^2" : "A^2";
  name_unit(evidence.signatures, square);
  name_unit(evidence.signatures_left, square);
  for (Candidate& candidate : evidence.candidates) {
    name_unit(candidate.signatures, square);
  }
  for (Evidence& asked : evidence.behind_asked) {
    name_units(asked, drive);
  }
}

std::string sentence_of_contrasts(const Evidence& evidence, const std::vector<Named>& names) {
  const bool replaced = !evidence.behind_asked.empty();
  const Evidence& asked = replaced ? evidence.behind_asked.front() : evidence;
  std::vector<std::string> phrases;
  for (const Signature* row : untold(asked.signatures, names, evidence.signatures_left)) {
    phrases.push_back(phrase_of(*row, replaced && no_longer_shows(*row, evidence.signatures)
                                          ? "; absent with " + evidence.model
                                          : std::string{}));
  }
  std::string text;
  if (!phrases.empty()) {
    text = fmt::format("Whatever the cause, the residual of {} shows: {}.", asked.model, fmt::join(phrases, "; "));
  }
  phrases.clear();
  for (const Signature* row : untold(evidence.signatures, names, evidence.signatures_left)) {
    const auto before = std::ranges::find(asked.signatures, row->id, &Signature::id);
    if (replaced && (before == asked.signatures.end() || !speaks_by_itself(*before))) {
      phrases.push_back(phrase_of(*row, {}));
    }
  }
  if (!phrases.empty()) {
    text += fmt::format("{} residual of {} {}shows: {}.", text.empty() ? "Whatever the cause, the" : " The",
                        evidence.model, text.empty() ? "" : "also ", fmt::join(phrases, "; "));
  }
  return text;
}

}  // namespace hysteron
