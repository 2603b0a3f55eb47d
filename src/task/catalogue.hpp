// The catalogue as records: what `hysteron list` and `hysteron describe` write with --json.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "presets/preset.hpp"

namespace hysteron {

struct CatalogueRow {
  std::string id;
  std::string title;
  std::string reference;
};
// Of models, solvers, effects, datasets or tables; empty for another word.
std::vector<CatalogueRow> catalogue_rows(const std::string& kind);
// The same rows, with what is known of effects.
nlohmann::json catalogue_json(const std::string& kind);

// Whatever description_json takes but families of solvers.
std::vector<std::string> describable_ids();
// One model, effect, solver, family of solvers, parameter set or dataset. Throws InputError, with the nearest name,
// where nothing is called so.
nlohmann::json description_json(const std::string& id);

// Published parameter sets of a model.
std::vector<const Preset*> presets_of(std::string_view model);
std::string_view word_of(PresetDrive drive);

}  // namespace hysteron
