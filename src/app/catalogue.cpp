// hysteron list and describe: the catalogue.
#include <fmt/format.h>

#include <memory>

#include "app/command.hpp"
#include "core/error.hpp"
#include "core/suggest.hpp"
#include "datasets/dataset.hpp"
#include "report/terminal.hpp"
#include "study/reproduce.hpp"

namespace hysteron::app {
namespace {

using nlohmann::json;

struct Row {
  std::string id;
  std::string title;
  std::string reference;
};

std::vector<Row> rows_of(const std::string& kind) {
  std::vector<Row> rows;
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

json card_json(const Parameter& card) {
  return {{"name", card.name},   {"symbol", card.symbol}, {"unit", card.unit},       {"meaning", card.meaning},
          {"lower", card.lower}, {"upper", card.upper},   {"default", card.initial},
          {"scale", card.scale == Scale::linear ? "linear" : "log"}, {"fixed", card.fixed}};
}

void describe_part(const Part& part, const std::string& kind, bool as_json) {
  if (as_json) {
    json cards = json::array();
    for (const Parameter& card : part.parameters) {
      cards.push_back(card_json(card));
    }
    fmt::print("{}", json_text({{"kind", kind},
                                {"id", part.id},
                                {"title", part.title},
                                {"reference", part.reference},
                                {"equations", std::vector<std::string>(part.equations.begin(), part.equations.end())},
                                {"states", part.states},
                                {"parameters", cards}}));
    return;
  }
  fmt::print("{} ({}): {}\n\n", part.id, kind, part.title);
  for (const std::string_view equation : part.equations) {
    fmt::print("  {}\n", equation);
  }
  fmt::print("\nSource: {}\n\n", part.reference);
  std::vector<std::vector<std::string>> rows;
  for (const Parameter& card : part.parameters) {
    rows.push_back({std::string(card.name), std::string(card.unit), fmt::format("{:g}", card.lower),
                    fmt::format("{:g}", card.upper),
                    card.fixed ? fmt::format("fixed at {:g}", card.initial) : fmt::format("{:g}", card.initial),
                    std::string(card.meaning)});
  }
  fmt::print("{}", table({"parameter", "unit", "lower", "upper", "default", "meaning"}, rows));
  fmt::print(
      "\nBounds are for a device of 1 kN, 25 mm half stroke and 0.3 m/s; an identification scales them to the recordings.\n");
}

void describe_solver(const SolverEntry& entry, bool as_json) {
  if (as_json) {
    json settings = json::array();
    for (const Setting& row : entry.settings) {
      settings.push_back({{"name", row.name}, {"default", row.value}, {"lower", row.lower}, {"upper", row.upper},
                          {"meaning", row.meaning}});
    }
    fmt::print("{}", json_text({{"kind", "solver"}, {"id", entry.id}, {"title", entry.title},
                                {"reference", entry.reference}, {"description", entry.description},
                                {"uses_derivatives", entry.uses_derivatives}, {"settings", settings}}));
    return;
  }
  fmt::print("{} (solver): {}\n\n{}\n\nSource: {}\n\n", entry.id, entry.title, entry.description, entry.reference);
  std::vector<std::vector<std::string>> rows;
  for (const Setting& row : entry.settings) {
    rows.push_back({std::string(row.name), fmt::format("{:g}", row.value), fmt::format("{:g}", row.lower),
                    fmt::format("{:g}", row.upper), std::string(row.meaning)});
  }
  if (!rows.empty()) {
    fmt::print("{}", table({"setting", "default", "lower", "upper", "meaning"}, rows));
  }
}

}  // namespace

void add_catalogue(CLI::App& program) {
  struct Options {
    std::string word;
    bool json = false;
  };
  auto list_options = std::make_shared<Options>();
  CLI::App* list = program.add_subcommand("list", "models, solvers, effects, datasets or tables there are");
  list->add_option("KIND", list_options->word, "models, solvers, effects, datasets or tables")
      ->required()
      ->check(CLI::IsMember({"models", "solvers", "effects", "datasets", "tables"}));
  list->add_flag("--json", list_options->json, "JSON on standard output");
  list->footer("Example:\n  hysteron list models");
  list->callback([list_options] {
    const std::vector<Row> rows = rows_of(list_options->word);
    if (list_options->json) {
      json result = json::array();
      for (const Row& row : rows) {
        result.push_back({{"id", row.id}, {"title", row.title}, {"reference", row.reference}});
      }
      fmt::print("{}", json_text(result));
      return;
    }
    if (rows.empty()) {
      fmt::print("none yet\n");
      return;
    }
    std::vector<std::vector<std::string>> cells;
    for (const Row& row : rows) {
      cells.push_back({row.id, row.title});
    }
    fmt::print("{}", table({"id", "what it is"}, cells));
  });

  auto describe_options = std::make_shared<Options>();
  CLI::App* describe = program.add_subcommand("describe", "one model, effect, solver or dataset: equations, parameters, source");
  describe->add_option("NAME", describe_options->word, "an id of `hysteron list`")->required();
  describe->add_flag("--json", describe_options->json, "JSON on standard output");
  describe->footer("Example:\n  hysteron describe bouc-wen");
  describe->callback([describe_options] {
    const std::string& id = describe_options->word;
    if (const Part* model = find_model(id)) {
      describe_part(*model, "model", describe_options->json);
    } else if (const Part* effect = find_effect(id)) {
      describe_part(*effect, "effect", describe_options->json);
    } else if (const SolverEntry* solver = find_solver(id)) {
      describe_solver(*solver, describe_options->json);
    } else if (const DatasetEntry* dataset = find_dataset(id)) {
      if (describe_options->json) {
        fmt::print("{}", json_text({{"kind", "dataset"}, {"id", dataset->id}, {"title", dataset->title},
                                    {"reference", dataset->reference}, {"description", dataset->description}}));
      } else {
        fmt::print("{} (dataset): {}\n\n{}\n\nSource: {}\nMake it: hysteron generate {} --out DIR\n", dataset->id,
                   dataset->title, dataset->description, dataset->reference, dataset->id);
      }
    } else {
      std::vector<std::string> known;
      for (const char* kind : {"models", "effects", "solvers", "datasets"}) {
        for (const Row& row : rows_of(kind)) {
          known.push_back(row.id);
        }
      }
      throw InputError("nothing is called '" + id + "'" + suggestion(id, known) + ", see `hysteron list models`");
    }
  });
}

}  // namespace hysteron::app
