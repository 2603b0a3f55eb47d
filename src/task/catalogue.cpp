#include "task/catalogue.hpp"

#include "core/error.hpp"
#include "core/suggest.hpp"
#include "datasets/dataset.hpp"
#include "fit/solver.hpp"
#include "simulate/composite.hpp"
#include "study/reproduce.hpp"
#include "task/effect_card.hpp"

namespace hysteron {
namespace {

using nlohmann::json;

json card_json(const Parameter& card) {
  return {
      {"name", card.name},       {"symbol", card.symbol},
      {"unit", card.unit},       {"meaning", card.meaning},
      {"lower", card.box.lower}, {"upper", card.box.upper},
      {"default", card.initial}, {"scale", card.scale == Scale::linear ? "linear" : "log"},
      {"fixed", card.fixed},     {"role", card.role == PhysicalRole::none ? json(nullptr) : json(name_of(card.role))}};
}

json preset_json(const Preset& preset) {
  json quantities = json::array();
  for (const PresetQuantity& quantity : preset.quantities) {
    quantities.push_back({{"name", quantity.name},
                          {"unit", quantity.unit},
                          {"printed", quantity.at != nullptr ? json(quantity.printed) : json(nullptr)}});
  }
  json result = {{"kind", "preset"},
                 {"id", preset.id},
                 {"title", preset.title},
                 {"reference", preset.reference},
                 {"model", preset.model},
                 {"effects", std::vector<std::string>(preset.effects.begin(), preset.effects.end())},
                 {"drive", word_of(preset.drive)},
                 {"by_frequency", preset.by_frequency},
                 {"lag_s", preset.lag},
                 {"note", preset.note},
                 {"quantities", quantities}};
  if (preset.drive != PresetDrive::none) {
    result["drive_range"] = {preset.drive_low, preset.drive_high};
  }
  return result;
}

json part_json(const Part& part, const std::string& kind) {
  json cards = json::array();
  for (const Parameter& card : part.parameters) {
    cards.push_back(card_json(card));
  }
  json presets = json::array();
  for (const Preset* preset : presets_of(part.id)) {
    presets.push_back(preset_json(*preset));
  }
  json entry = {{"kind", kind},
                {"id", part.id},
                {"title", part.title},
                {"reference", part.reference},
                {"equations", std::vector<std::string>(part.equations.begin(), part.equations.end())},
                {"states", part.states},
                {"presets", presets},
                {"parameters", cards}};
  if (kind == "model") {
    entry["alternative"] = part.alternative;
  }
  if (kind == "effect") {
    entry.update(effect_card_json(std::string(part.id)));
  }
  return entry;
}

// "nlopt:*" for a member of the family, else null.
json family_of(const SolverEntry& entry) {
  const auto colon = entry.id.find(':');
  const SolverEntry* family = colon == std::string_view::npos ? nullptr : find_solver_family(entry.id.substr(0, colon));
  return family == nullptr ? json(nullptr) : json(family->id);
}

json solver_json(const SolverEntry& entry) {
  json settings = json::array();
  for (const Setting& row : entry.settings) {
    settings.push_back({{"name", row.name},
                        {"default", row.value},
                        {"lower", row.lower},
                        {"upper", row.upper},
                        {"meaning", row.meaning}});
  }
  return {{"kind", "solver"},
          {"id", entry.id},
          {"title", entry.title},
          {"reference", entry.reference},
          {"description", entry.description},
          {"uses_derivatives", entry.uses_derivatives},
          {"family", family_of(entry)},
          {"settings", settings}};
}

json dataset_json(const DatasetEntry& dataset) {
  return {{"kind", "dataset"},
          {"id", dataset.id},
          {"title", dataset.title},
          {"reference", dataset.reference},
          {"description", dataset.description},
          {"licence", dataset.licence.empty() ? json(nullptr) : json(dataset.licence)}};
}

}  // namespace

std::string_view word_of(PresetDrive drive) {
  return drive == PresetDrive::current ? "current" : drive == PresetDrive::voltage ? "voltage" : "none";
}

std::vector<const Preset*> presets_of(std::string_view model) {
  std::vector<const Preset*> result;
  for (const Preset* preset : preset_catalogue()) {
    if (preset->model == model) {
      result.push_back(preset);
    }
  }
  return result;
}

std::vector<CatalogueRow> catalogue_rows(const std::string& kind) {
  std::vector<CatalogueRow> rows;
  const auto add = [&](std::string_view id, std::string_view title, std::string_view reference) {
    rows.push_back({std::string(id), std::string(title), std::string(reference)});
  };
  if (kind == "models" || kind == "effects") {
    for (const Part* part : kind == "models" ? model_catalogue() : effect_catalogue()) {
      add(part->id, part->title, part->reference);
    }
  } else if (kind == "solvers") {
    for (const SolverEntry* entry : solver_catalogue()) {
      add(entry->id, entry->title, entry->reference);
    }
  } else if (kind == "datasets") {
    for (const DatasetEntry* entry : dataset_catalogue()) {
      add(entry->id, entry->title, entry->reference);
    }
  } else if (kind == "tables") {
    for (const PublishedTable& table : published_tables()) {
      add(table.id, table.title, table.source);
    }
  }
  return rows;
}

json catalogue_json(const std::string& kind) {
  json result = json::array();
  for (const CatalogueRow& row : catalogue_rows(kind)) {
    json entry = {{"id", row.id}, {"title", row.title}, {"reference", row.reference}};
    if (kind == "effects") {
      entry.update(effect_card_json(row.id));
    }
    result.push_back(std::move(entry));
  }
  return result;
}

std::vector<std::string> describable_ids() {
  std::vector<std::string> known;
  for (const char* kind : {"models", "effects", "solvers", "datasets"}) {
    for (const CatalogueRow& row : catalogue_rows(kind)) {
      known.push_back(row.id);
    }
  }
  for (const Preset* preset : preset_catalogue()) {
    known.emplace_back(preset->id);
  }
  return known;
}

json description_json(const std::string& id) {
  if (const Part* model = find_model(id)) return part_json(*model, "model");
  if (const Part* effect = find_effect(id)) return part_json(*effect, "effect");
  if (const SolverEntry* solver = find_solver(id)) return solver_json(*solver);
  if (const SolverEntry* family = find_solver_family(id)) return solver_json(*family);
  if (const Preset* preset = find_preset(id)) return preset_json(*preset);
  if (const DatasetEntry* dataset = find_dataset(id)) return dataset_json(*dataset);
  if (find_published_table(id) != nullptr) {
    throw InputError("'" + id + "' is a published table, which `hysteron reproduce " + id + "` makes again");
  }
  throw InputError("nothing is called '" + id + "'" + suggestion(id, describable_ids()) +
                   ", see `hysteron list models`");
}

}  // namespace hysteron
