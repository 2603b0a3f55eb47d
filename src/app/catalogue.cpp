// hysteron list and describe: the catalogue.
#include "task/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/command.hpp"
#include "app/figure.hpp"
#include "app/result.hpp"
#include "app/values.hpp"
#include "core/error.hpp"
#include "core/unit_text.hpp"
#include "datasets/dataset.hpp"
#include "io/text.hpp"
#include "presets/preset.hpp"
#include "report/terminal.hpp"
#include "task/effect_card.hpp"

namespace hysteron::app {
namespace {

// Paragraphs, whose lines stand as the source's.
std::string flowing(std::string_view text) {
  std::string result;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t end = std::min(text.find("\n\n", from), text.size());
    std::string paragraph(text.substr(from, end - from));
    std::ranges::replace(paragraph, '\n', ' ');
    result += (result.empty() ? "" : "\n") + wrapped(paragraph);
    from = end + 2;
  }
  return result;
}

std::string source_text(std::string_view reference) { return wrapped("Source: " + std::string(reference), 2); }

void describe_preset(const Preset& preset) {
  fmt::print("{}\n{}", wrapped(fmt::format("{} (parameter set of {}): {}", preset.id, preset.model, preset.title), 2),
             source_text(preset.reference));
  if (preset.drive != PresetDrive::none) {
    fmt::print("Drive: {}, {:g} to {:g}\n", word_of(preset.drive), preset.drive_low, preset.drive_high);
  }
  fmt::print("{}\n", wrapped("Note: " + std::string(preset.note)));
  std::vector<std::vector<std::string>> rows;
  for (const PresetQuantity& quantity : preset.quantities) {
    rows.push_back({std::string(quantity.name), unit_text(std::string(quantity.unit)),
                    quantity.at != nullptr ? std::string(quantity.printed)
                                           : "not printed: --set " + std::string(quantity.name) + "=..."});
  }
  fmt::print("{}\nUse it: hysteron simulate --preset {} RECORDING --out FILE\n",
             table({"quantity", "unit", "value"}, rows), preset.id);
}

void describe_part(const Part& part, const std::string& kind) {
  fmt::print("{}\n", wrapped(fmt::format("{} ({}): {}", part.id, kind, part.title), 2));
  for (const std::string_view equation : part.equations) {
    fmt::print("  {}\n", equation);
  }
  fmt::print("\n{}\n", source_text(part.reference));
  std::vector<std::vector<std::string>> rows;
  for (const Parameter& card : part.parameters) {
    rows.push_back({std::string(card.name), unit_text(std::string(card.unit)), fmt::format("{:g}", card.box.lower),
                    fmt::format("{:g}", card.box.upper),
                    card.fixed ? fmt::format("fixed at {:g}", card.initial) : fmt::format("{:g}", card.initial),
                    std::string(card.meaning)});
  }
  fmt::print("{}", narrow_table({"parameter", "unit", "lower", "upper", "default", "meaning"}, rows));
  fmt::print("\n{}", wrapped("Bounds are for a device of 1 kN, 25 mm half stroke and 0.3 m/s; an identification scales "
                             "them to the recordings."));
  if (part.alternative) {
    fmt::print("\n`diagnose` tries it in place of another damper law.\n");
  }
  if (const std::string known = kind == "effect" ? effect_card_text(std::string(part.id)) : ""; !known.empty()) {
    fmt::print("\n{}", known);
  }
  rows.clear();
  for (const Preset* preset : presets_of(part.id)) {
    rows.push_back({std::string(preset->id), std::string(preset->title)});
  }
  if (!rows.empty()) {
    fmt::print("\n{}\nWhat they hold: hysteron describe PRESET\n", narrow_table({"published set", "what it is"}, rows));
  }
}

void describe_solver(const SolverEntry& entry) {
  const char* const kind = entry.members != nullptr ? "family of solvers" : "solver";
  fmt::print("{}\n{}\n{}\n", wrapped(fmt::format("{} ({}): {}", entry.id, kind, entry.title), 2),
             flowing(entry.description), source_text(entry.reference));
  std::vector<std::vector<std::string>> rows;
  for (const Setting& row : entry.settings) {
    rows.push_back({std::string(row.name), fmt::format("{:g}", row.value), fmt::format("{:g}", row.lower),
                    fmt::format("{:g}", row.upper), std::string(row.meaning)});
  }
  if (!rows.empty()) {
    fmt::print("{}", narrow_table({"setting", "default", "lower", "upper", "meaning"}, rows));
  }
}

// Another ending would promise another kind of picture.
void refuse_other_picture(const std::string& out) {
  const std::string ending = std::filesystem::path(out).extension().string();
  if (ending.empty() || lower_case(ending) == ".svg") return;
  throw InputError("--figure " + out + ": an SVG is written, and no " + ending + ", expected a name that ends in .svg");
}

std::string figure_of(const std::string& id) {
  if (const Part* model = find_model(id)) {
    return loop_figure(*model);
  }
  if (const SolverEntry* solver = find_solver(id)) {
    return convergence_figure(*solver);
  }
  throw InputError("--figure: '" + id + "' is neither a model nor a solver, see `hysteron list models`");
}

}  // namespace

void add_catalogue(CLI::App& program) {
  struct Options {
    std::string word;
    bool json = false;
    std::string figure;
  };
  auto list_options = std::make_shared<Options>();
  CLI::App* list = program.add_subcommand("list", "models, solvers, effects, datasets or tables there are");
  list->add_option("KIND", list_options->word, "models, solvers, effects, datasets or tables")
      ->check(one_of({"models", "solvers", "effects", "datasets", "tables"}));
  list->add_flag("--json", list_options->json, "JSON on standard output");
  list->footer("Example:\n  hysteron list models");
  take_common_options(*list);
  list->callback([list_options] {
    if (list_options->word.empty()) {
      throw InputError("list: of what, expected models, solvers, effects, datasets or tables");
    }
    if (list_options->json) {
      fmt::print("{}", json_text(catalogue_json(list_options->word)));
      return;
    }
    const std::vector<CatalogueRow> rows = catalogue_rows(list_options->word);
    if (rows.empty()) {
      fmt::print("none yet\n");
      return;
    }
    std::vector<std::vector<std::string>> cells;
    cells.reserve(rows.size());
    for (const CatalogueRow& row : rows) {
      cells.push_back({row.id, row.title});
    }
    fmt::print("{}", narrow_table({"id", "what it is"}, cells));
  });

  auto describe_options = std::make_shared<Options>();
  CLI::App* describe = program.add_subcommand(
      "describe", "one model, effect, solver, dataset or parameter set: equations, parameters, source");
  describe->add_option("NAME", describe_options->word, "an id of `hysteron list`")->required();
  CLI::Option* as_json = describe->add_flag("--json", describe_options->json, "JSON on standard output");
  describe
      ->add_option("--figure", describe_options->figure,
                   "instead, an SVG file: loops of a model, or convergence of a solver on the simulated damper; -: "
                   "standard output")
      ->excludes(as_json);
  describe->footer("Example:\n  hysteron describe bouc-wen\n  hysteron describe bouc-wen --figure bouc-wen.svg");
  take_common_options(*describe);
  describe->callback([describe_options] {
    const std::string& id = describe_options->word;
    if (!describe_options->figure.empty()) {
      refuse_other_picture(describe_options->figure);
      write_result(describe_options->figure, figure_of(id));
      return;
    }
    if (describe_options->json) {
      fmt::print("{}", json_text(description_json(id)));
    } else if (const Part* model = find_model(id)) {
      describe_part(*model, "model");
    } else if (const Part* effect = find_effect(id)) {
      describe_part(*effect, "effect");
    } else if (const SolverEntry* solver = find_solver(id)) {
      describe_solver(*solver);
    } else if (const SolverEntry* family = find_solver_family(id)) {
      describe_solver(*family);
    } else if (const Preset* preset = find_preset(id)) {
      describe_preset(*preset);
    } else if (const DatasetEntry* dataset = find_dataset(id)) {
      fmt::print("{}\n{}\n{}", wrapped(fmt::format("{} (dataset): {}", dataset->id, dataset->title), 2),
                 flowing(dataset->description), source_text(dataset->reference));
      if (!dataset->licence.empty()) fmt::print("Licence: {}\n", dataset->licence);
      fmt::print("As a folder: hysteron generate {} --out DIR\n", dataset->id);
    } else {
      static_cast<void>(description_json(id));  // says so, with the nearest name
    }
  });
}

}  // namespace hysteron::app
