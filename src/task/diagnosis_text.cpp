#include "task/diagnosis_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/error.hpp"
#include "core/printable.hpp"
#include "core/probability_text.hpp"
#include "diagnose/search/alias.hpp"
#include "io/file.hpp"
#include "io/json_reader.hpp"
#include "report/terminal.hpp"

namespace hysteron {
namespace {

using nlohmann::json;

constexpr std::size_t most_pairs_printed = 8;

struct Incomplete {};  // a table of the record lacks entries

const json& list_of(const json& record, const char* name) {
  static const json empty = json::array();
  const auto at = record.find(name);
  return at == record.end() || at->is_null() ? empty : *at;
}

std::string text_of(const json& record, const char* name) { return printable(record.value(name, std::string{})); }

// An entry of a list.
std::string item(const std::string& text) { return wrapped("- " + text, 2); }

// Of a record without a summary of its own.
std::string names_of(const json& record) {
  std::string names;
  for (const json& effect : list_of(record, "effects")) {
    names += (names.empty() ? "" : ", ") + text_of(effect, "id");
  }
  return names.empty() ? "Nothing is named." : "Named: " + names + ".";
}

std::string summary_text(const json& record) {
  std::string paragraph;
  for (const json& sentence : list_of(record, "summary")) {
    paragraph += (paragraph.empty() ? "" : " ") + printable(sentence.get<std::string>());
  }
  return wrapped(paragraph.empty() ? names_of(record) : paragraph);
}

std::string number_in(const json& record, const char* name) {
  const auto at = record.find(name);
  return at == record.end() || at->is_null() ? "-" : format_number(at->get<double>(), 4);
}

std::string errors_text(const json& record) {
  const json& base = record.at("baseline");
  const json& augmented = record.at("augmented");
  const std::string law = text_of(base, "model");
  const std::string instead = text_of(augmented, "model");
  const std::string method = text_of(base, "noise_floor_method");
  return table({"model", "NRMSE fit", "NRMSE held out"},
               {{law, number_in(base, "nrmse_fit"), number_in(base, "nrmse_heldout")},
                {instead.empty() || instead == law ? "augmented" : "augmented " + instead,
                 number_in(augmented, "nrmse_fit"), number_in(augmented, "nrmse_heldout")},
                {"noise floor" + (method.empty() ? "" : " (" + method + ")"), number_in(base, "noise_floor_nrmse"),
                 number_in(base, "noise_floor_heldout_nrmse")}});
}

std::string names_text(const json& record) {
  std::string text;
  for (const char* list : {"effects", "suggestions"}) {
    for (const json& effect : list_of(record, list)) {
      const bool of_set = !list_of(effect, "indistinguishable_from").empty();
      text += "\n" + item(fmt::format("{} ({}{}): {}", effect.contains("grade") ? text_of(effect, "grade") : "named",
                                      probability_text(effect.value("confidence", 0.0)),
                                      of_set ? " that it is one of these" : "", text_of(effect, "sentence")));
      if (!text_of(effect, "experiment").empty()) {
        text += "  " + wrapped("decided by: " + text_of(effect, "experiment"), 2);
      }
      if (effect.contains("rig_cause") && effect["rig_cause"].is_string()) {
        text += "  " + wrapped("may also come from outside the damper: " + text_of(effect, "rig_cause"), 2);
      }
    }
  }
  return text;
}

std::string places_text(const std::string& title, const json& places) {
  std::string text = places.empty() ? "" : "\n" + title + " (each recording weighs the same):\n";
  for (const json& place : places) {
    text +=
        item(fmt::format("{}: {:.0f} % of the misfit in {:.0f} % of the samples", text_of(place, "where"),
                         100.0 * place.value("share_of_misfit", 0.0), 100.0 * place.value("share_of_samples", 0.0)));
  }
  return text;
}

std::string hidden_text(const json& record) {
  std::string text;
  for (const json& row : list_of(record, "not_observable")) {
    if (row.contains("reason")) {
      text += item(text_of(row, "id") + ": " + text_of(row, "reason"));
    }
  }
  return text.empty() ? text : "\nnot observable in these recordings:\n" + text;
}

std::string alike_text(const json& record) {
  if (!record.contains("alias_map")) {
    return {};
  }
  const json& map = record["alias_map"];
  const AliasMap alias{map.at("effects"), map.at("cosine")};
  const auto too_short = [&](const auto& rows) { return rows.size() < alias.effects.size(); };
  if (too_short(alias.cosine) || std::ranges::any_of(alias.cosine, too_short)) throw Incomplete{};
  const std::vector<AlikePair> pairs = alike_pairs(alias);
  if (pairs.empty()) {
    return {};
  }
  std::string text =
      "\n" + wrapped(fmt::format("look alike in these recordings, beside what {} imitates (cosine; all in "
                                 "the report):",
                                 text_of(record.at("baseline"), "model")));
  for (std::size_t k = 0; k < std::min(pairs.size(), most_pairs_printed); ++k) {
    text +=
        fmt::format("- {} and {}: {:.3f}\n", printable(pairs[k].effect), printable(pairs[k].other), pairs[k].cosine);
  }
  if (pairs.size() > most_pairs_printed) {
    text += fmt::format("- and {} more pairs above {}\n", pairs.size() - most_pairs_printed, alike_from);
  }
  return text;
}

std::string diagnosis_text(const json& record) {
  std::string text = fmt::format("verdict: {}\n{}\n", text_of(record, "verdict"), summary_text(record));
  text += errors_text(record);
  text += names_text(record);
  text += places_text("where the base model's misfit sits", list_of(record, "locations"));
  text += places_text("where the augmented model's misfit sits", list_of(record.at("augmented"), "locations"));
  text += hidden_text(record);
  text += alike_text(record);
  text += "\n" + wrapped("next experiment: " + text_of(record, "next_experiment"));
  for (const json& note : list_of(record, "notes")) {
    text += wrapped("note: " + printable(note.get<std::string>()), 2);
  }
  for (const json& warning : list_of(record, "warnings")) {
    text += wrapped("warning: " + printable(warning.get<std::string>()), 2);
  }
  return text;
}

}  // namespace

std::string diagnosis_text(const json& record, const std::string& path) {
  const auto wrong = [&] {
    return InputError(path, 0,
                      "a field is missing or of another type than " + text_of(record, "schema") +
                          " has, expected the file as `hysteron diagnose` wrote it");
  };
  try {
    return diagnosis_text(record);
  } catch (const json::exception&) {
    throw wrong();
  } catch (const Incomplete&) {
    throw wrong();
  }
}

json read_diagnosis(const std::string& path) { return parse_diagnosis(read_file(path), path); }

json parse_diagnosis(std::string_view text, const std::string& path) {
  json record = parse_json(text, path, "expected a diagnosis.json of `hysteron diagnose`");
  if (!record.is_object() || !record.contains("schema") || !record["schema"].is_string()) {
    throw InputError(path, 0, "no schema, expected \"hysteron.diagnosis/2\" or \"hysteron.diagnosis/1\"");
  }
  if (record["schema"] != "hysteron.diagnosis/2" && record["schema"] != "hysteron.diagnosis/1") {
    throw InputError(path, 0,
                     "schema " + printable(record["schema"].dump(-1, ' ', true)) +
                         " is not known to this version, expected \"hysteron.diagnosis/2\" or "
                         "\"hysteron.diagnosis/1\"");
  }
  return record;
}

}  // namespace hysteron
