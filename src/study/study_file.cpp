#include "study/study_file.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>

#include "core/error.hpp"
#include "core/suggest.hpp"
#include "datasets/dataset.hpp"
#include "fit/projection.hpp"
#include "fit/solver.hpp"
#include "io/campaign_file.hpp"
#include "io/file.hpp"
#include "io/text.hpp"
#include "io/toml_reader.hpp"
#include "simulate/composite.hpp"

namespace hysteron {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view schema = "hysteron.study/1";
constexpr std::int64_t most_seeds = 100000;
constexpr std::int64_t largest_budget = 1000000000;

template <class Catalogue>
std::vector<std::string> ids_of(const Catalogue& catalogue) {
  std::vector<std::string> ids;
  for (const auto* entry : catalogue) ids.emplace_back(entry->id);
  return ids;
}

class Parser : private TomlReader {
 public:
  explicit Parser(const fs::path& path) : TomlReader(path), path_(path) {}

  Study run(const std::string& text) {
    const toml::table root = parse(text, schema);
    check_keys(root,
               {"schema", "title", "models", "model", "data", "solvers", "solver", "budgets", "seeds", "targets",
                "target_nrmse", "tie", "equivalence", "start", "normalisation", "weighting", "tolerance"},
               "");
    Study study;
    study.file = file();
    study.title = path_.stem().string();
    if (const auto* node = root.get("title")) study.title = word_of(*node, "title");
    read_models(root, study);
    read_data(root, study);
    read_solvers(root, study);
    study.budgets = budgets_of(required(root, "budgets", "budgets = 10000"));
    study.seeds = seeds_of(required(root, "seeds", "seeds = 31"));
    if (const auto* node = root.get("targets")) study.targets = numbers_of(*node, "targets", 1.0, 1e6);
    if (const auto* node = root.get("target_nrmse")) study.target_nrmse = numbers_of(*node, "target_nrmse", 1e-12, 1e6);
    if (const auto* node = root.get("tie")) study.tie = number_of(*node, "tie", 0.0, 0.5);
    if (const auto* node = root.get("equivalence")) study.equivalence = number_of(*node, "equivalence", 0.0, 0.5);
    if (const auto* node = root.get("tolerance"))
      study.objective.tolerance = number_of(*node, "tolerance", 1e-10, 1e-2);
    if (const auto* node = root.get("start")) {
      const std::string word = word_of(*node, "start");
      if (word != "random" && word != "card")
        fail(*node, "unknown start " + in_quotes(word) + ", expected 'random' or 'card'");
      study.start = word == "card" ? StartPoint::card : StartPoint::random;
    }
    if (const auto* node = root.get("normalisation")) {
      try {
        study.objective.normalisation = normalisation_of(word_of(*node, "normalisation"));
      } catch (const InputError&) {
        fail(*node, "unknown normalisation " + in_quotes(word_of(*node, "normalisation")) +
                        ", expected max-abs, range, std or mean-abs");
      }
    }
    if (const auto* node = root.get("weighting")) {
      const std::string word = word_of(*node, "weighting");
      if (word != "per-recording" && word != "pooled") {
        fail(*node, "unknown weighting " + in_quotes(word) + ", expected 'per-recording' or 'pooled'");
      }
      study.objective.weighting = word == "pooled" ? Weighting::pooled : Weighting::per_recording;
    }
    return study;
  }

 private:
  [[nodiscard]] const toml::node& required(const toml::table& table, const std::string& key,
                                           const std::string& example) const {
    const auto* node = table.get(key);
    if (node == nullptr) fail_at(1, "no '" + key + "', expected for example " + example);
    return *node;
  }

  // A value as it is written, for messages; lists and tables by their kind.
  static std::string said(const toml::node& node) {
    if (const auto* text = node.as_string()) return in_quotes(text->get());
    if (const auto* whole = node.as_integer()) return std::to_string(whole->get());
    if (const auto* number = node.as_floating_point()) return brief(number->get());
    if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
    if (const auto* list = node.as_array()) return list->empty() ? "an empty list" : "a list";
    return node.is_table() ? "a table" : "a time";
  }

  // Text that is not empty.
  [[nodiscard]] std::string word_of(const toml::node& node, const std::string& name) const {
    if (!node.is_string() || node.as_string()->get().empty()) {
      fail(node, "'" + name + "' is " + said(node) + ", expected text in double quotes");
    }
    return node.as_string()->get();
  }

  [[nodiscard]] bool truth_of(const toml::node& node, const std::string& name) const {
    if (!node.is_boolean()) fail(node, "'" + name + "' is " + said(node) + ", expected true or false");
    return node.as_boolean()->get();
  }

  [[nodiscard]] const toml::table& table_of(const toml::node& node, const std::string& name,
                                            const std::string& example) const {
    const auto* table = node.as_table();
    if (table == nullptr) fail(node, "'" + name + "' is " + said(node) + ", expected for example " + example);
    return *table;
  }

  [[nodiscard]] double number_of(const toml::node& node, const std::string& name, double low, double high) const {
    const auto value = node.value<double>();
    if (!node.is_number() || !value || !(*value >= low) || !(*value <= high)) {
      fail(node, "'" + name + "' is " + said(node) + ", expected a number from " + brief(low) + " to " + brief(high));
    }
    return *value;
  }

  static std::string brief(double value) {
    std::string text = std::to_string(value);
    if (std::fabs(value) >= 1e6 || (value != 0.0 && std::fabs(value) < 1e-4)) {
      char buffer[32];
      std::snprintf(buffer, sizeof buffer, "%g", value);
      return buffer;
    }
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text;
  }

  [[nodiscard]] std::int64_t whole_of(const toml::node& node, const std::string& name, std::int64_t low,
                                      std::int64_t high) const {
    // 1e4 is a whole number too; where a double no longer holds them all it is not taken for one.
    constexpr double exact = 9007199254740992.0;
    const auto* number = node.as_floating_point();
    const bool written =
        number != nullptr && std::fabs(number->get()) <= exact && std::floor(number->get()) == number->get();
    const std::optional<std::int64_t> value = written             ? static_cast<std::int64_t>(number->get())
                                              : node.is_integer() ? node.value<std::int64_t>()
                                                                  : std::nullopt;
    if (!value || *value < low || *value > high) {
      fail(node, "'" + name + "' is " + said(node) + ", expected a whole number from " + std::to_string(low) + " to " +
                     std::to_string(high));
    }
    return *value;
  }

  [[nodiscard]] const toml::array& array_of(const toml::node& node, const std::string& name,
                                            const std::string& example) const {
    const auto* array = node.as_array();
    if (array == nullptr || array->empty())
      fail(node, "'" + name + "' is " + said(node) + ", expected for example " + example);
    return *array;
  }

  [[nodiscard]] std::vector<double> numbers_of(const toml::node& node, const std::string& name, double low,
                                               double high) const {
    std::vector<double> result;
    for (const auto& element : array_of(node, name, name + " = [1.01, 1.1]")) {
      result.push_back(number_of(element, name, low, high));
    }
    return result;
  }

  [[nodiscard]] std::vector<std::string> texts_of(const toml::node& node, const std::string& name) const {
    if (node.is_string()) return {word_of(node, name)};
    std::vector<std::string> result;
    for (const auto& element : array_of(node, name, name + " = [\"...\"]")) result.push_back(word_of(element, name));
    return result;
  }

  [[nodiscard]] std::vector<std::size_t> budgets_of(const toml::node& node) const {
    std::vector<std::size_t> result;
    const auto add = [&](const toml::node& one) {
      const auto value = static_cast<std::size_t>(whole_of(one, "budgets", 1, largest_budget));
      if (std::ranges::find(result, value) != result.end())
        fail(one, "budget " + std::to_string(value) + " is given twice, expected each once");
      result.push_back(value);
    };
    if (node.is_number()) {
      add(node);
    } else {
      for (const auto& element : array_of(node, "budgets", "budgets = [1000, 10000]")) add(element);
    }
    std::ranges::sort(result);
    return result;
  }

  [[nodiscard]] std::vector<std::uint64_t> seeds_of(const toml::node& node) const {
    std::vector<std::uint64_t> result;
    if (node.is_integer()) {
      const auto count = whole_of(node, "seeds", 1, most_seeds);
      for (std::int64_t seed = 1; seed <= count; ++seed) result.push_back(static_cast<std::uint64_t>(seed));
      return result;
    }
    std::set<std::uint64_t> seen;
    for (const auto& element : array_of(node, "seeds", "seeds = 31, which means 1 to 31, or seeds = [1, 2, 3]")) {
      const auto seed =
          static_cast<std::uint64_t>(whole_of(element, "seeds", 0, std::numeric_limits<std::int64_t>::max()));
      if (!seen.insert(seed).second)
        fail(element, "seed " + std::to_string(seed) + " is given twice, expected each once");
      result.push_back(seed);
    }
    return result;
  }

  [[nodiscard]] std::map<std::string, int> orders_of(const toml::node& node, const std::string& name) const {
    std::map<std::string, int> result;
    for (const auto& [key, value] : table_of(node, name, name + " = { alpha = 1 }")) {
      result[std::string(key.str())] = static_cast<int>(whole_of(value, std::string(key.str()), 0, highest_order));
    }
    return result;
  }

  // "bouc-wen+offset-force" or a table.
  [[nodiscard]] ModelSpec model_of(const toml::node& node) const {
    ModelSpec spec;
    spec.line = line_of(node);
    if (node.is_string()) {
      std::string rest = word_of(node, "models");
      spec.label = rest;
      for (std::size_t plus = rest.find('+'); !rest.empty(); plus = rest.find('+')) {
        const std::string word = rest.substr(0, plus);
        (spec.model.empty() ? spec.model : spec.effects.emplace_back()) = word;
        rest = plus == std::string::npos ? "" : rest.substr(plus + 1);
      }
    } else {
      const auto* table = node.as_table();
      if (table == nullptr) fail(node, "a model is " + said(node) + ", expected for example \"bouc-wen+offset-force\"");
      check_keys(*table, {"id", "label", "effects", "by_current", "by_frequency", "fix", "bounds"}, " of a model");
      const auto* id = table->get("id");
      if (id == nullptr) fail(node, "a model without 'id', expected for example id = \"bouc-wen\"");
      spec.model = word_of(*id, "id");
      spec.label = spec.model;
      if (const auto* effects = table->get("effects")) spec.effects = texts_of(*effects, "effects");
      for (const std::string& effect : spec.effects) spec.label += "+" + effect;
      if (const auto* label = table->get("label")) spec.label = word_of(*label, "label");
      if (const auto* orders = table->get("by_current")) spec.layout.by_current = orders_of(*orders, "by_current");
      if (const auto* orders = table->get("by_frequency"))
        spec.layout.by_frequency = orders_of(*orders, "by_frequency");
      if (const auto* fix = table->get("fix")) {
        for (const auto& [key, value] : table_of(*fix, "fix", "fix = { n = 1.0 }")) {
          spec.layout.fix[std::string(key.str())] = number_of(value, std::string(key.str()), -1e300, 1e300);
        }
      }
      if (const auto* bounds = table->get("bounds")) {
        for (const auto& [key, value] : table_of(*bounds, "bounds", "bounds = { k0 = [-1e4, 1e4] }")) {
          const auto* pair = value.as_array();
          if (pair == nullptr || pair->size() != 2) {
            fail(value, "the bounds of '" + std::string(key.str()) + "' are " +
                            (pair == nullptr ? said(value) : std::to_string(pair->size()) + " in number") +
                            ", expected [LOWER, UPPER] in SI units");
          }
          const double low = number_of(*pair->get(0), std::string(key.str()), -1e300, 1e300);
          const double high = number_of(*pair->get(1), std::string(key.str()), -1e300, 1e300);
          if (!(low < high))
            fail(value, "the bounds of '" + std::string(key.str()) + "' are " + brief(low) + " and " + brief(high) +
                            ", expected LOWER below UPPER");
          spec.layout.bounds[std::string(key.str())] = {low, high};
        }
      }
    }
    const auto models = ids_of(model_catalogue());
    if (std::ranges::find(models, spec.model) == models.end()) {
      fail(node,
           "unknown model " + in_quotes(spec.model) + suggestion(spec.model, models) + ", see `hysteron list models`");
    }
    const auto effects = ids_of(effect_catalogue());
    for (const std::string& effect : spec.effects) {
      if (std::ranges::find(effects, effect) == effects.end()) {
        fail(node,
             "unknown effect " + in_quotes(effect) + suggestion(effect, effects) + ", see `hysteron list effects`");
      }
    }
    return spec;
  }

  template <class Spec, class Make>
  void read_list(const toml::table& root, const std::string& plural, const std::string& single,
                 const std::string& example, std::vector<Spec>& into, const Make& make) const {
    if (const auto* node = root.get(plural)) {
      for (const auto& element : array_of(*node, plural, example)) into.push_back(make(element));
    }
    if (const auto* node = root.get(single); node != nullptr && plural != single) {
      for (const auto& element : array_of(*node, single, "[[" + single + "]]")) into.push_back(make(element));
    }
    if (into.empty()) fail_at(1, "no '" + plural + "', expected for example " + example);
    std::set<std::string> seen;
    for (const Spec& spec : into) {
      if (!seen.insert(spec.label).second) {
        fail_at(spec.line, in_quotes(spec.label) + " is listed twice in " + plural + ", expected different labels");
      }
    }
  }

  void read_models(const toml::table& root, Study& study) const {
    read_list(root, "models", "model", "models = [\"bouc-wen\"]", study.models,
              [&](const toml::node& node) { return model_of(node); });
  }

  void read_data(const toml::table& root, Study& study) const {
    read_list(
        root, "data", "data", "[[data]] with dataset = \"rd8040-twin\" or recordings = [\"FOLDER\"]", study.data,
        [&](const toml::node& node) {
          const auto* table = node.as_table();
          if (table == nullptr) fail(node, "'data' is " + said(node) + ", expected [[data]]");
          check_keys(*table, {"dataset", "recordings", "label", "seed", "only", "validate", "each"}, " of [[data]]");
          DataSpec spec;
          spec.line = line_of(node);
          const auto* dataset = table->get("dataset");
          const auto* recordings = table->get("recordings");
          if ((dataset == nullptr) == (recordings == nullptr)) {
            fail(node, std::string("[[data]] has ") + (dataset == nullptr ? "neither" : "both") +
                           ", expected either dataset = \"ID\" or recordings = [\"FILE OR FOLDER\"]");
          }
          if (dataset != nullptr) {
            spec.dataset = word_of(*dataset, "dataset");
            spec.label = spec.dataset;
            const auto known = ids_of(dataset_catalogue());
            if (std::ranges::find(known, spec.dataset) == known.end()) {
              fail(*dataset, "unknown dataset " + in_quotes(spec.dataset) + suggestion(spec.dataset, known) +
                                 ", see `hysteron list datasets`");
            }
            if (find_dataset(spec.dataset)->response) {
              fail(*dataset, "dataset " + in_quotes(spec.dataset) +
                                 " holds the force on a mass, not on a damper, expected another one; it is for "
                                 "identification from a response");
            }
          } else {
            spec.paths_line = line_of(*recordings);
            for (const std::string& name : texts_of(*recordings, "recordings")) {
              const fs::path path(name);
              spec.paths.push_back(path.is_absolute() ? path.string() : (path_.parent_path() / path).string());
            }
            // Never the whole path: a label must not tell where on a machine the data lie.
            fs::path first = fs::path(spec.paths.front()).lexically_normal();
            spec.label = (first.has_filename() ? first.filename() : first.parent_path().filename()).string();
          }
          if (const auto* value = table->get("label")) spec.label = word_of(*value, "label");
          if (const auto* value = table->get("seed")) {
            if (dataset == nullptr) {
              fail(*value, "'seed' is the noise of a shipped dataset, expected none beside recordings");
            }
            spec.seed =
                static_cast<std::uint64_t>(whole_of(*value, "seed", 0, std::numeric_limits<std::int64_t>::max()));
          }
          if (const auto* value = table->get("only")) spec.only = texts_of(*value, "only");
          if (const auto* value = table->get("validate")) spec.validate = texts_of(*value, "validate");
          if (const auto* value = table->get("each")) {
            spec.each = truth_of(*value, "each");
            if (spec.each && !spec.validate.empty()) {
              fail(*value,
                   "'each' makes every recording a problem, so that 'validate' has none to judge by, expected one "
                   "of the two");
            }
          }
          return spec;
        });
  }

  void read_solvers(const toml::table& root, Study& study) const {
    read_list(root, "solvers", "solver", "solvers = [\"pso\", \"cma-es\"]", study.solvers, [&](const toml::node& node) {
      SolverSpec spec;
      spec.line = line_of(node);
      const toml::table* settings = nullptr;
      if (node.is_string()) {
        spec.id = word_of(node, "solvers");
        spec.label = spec.id;
      } else {
        const auto* table = node.as_table();
        if (table == nullptr) fail(node, "a solver is " + said(node) + ", expected for example \"pso\"");
        check_keys(*table, {"id", "label", "settings", "project"}, " of a solver");
        const auto* id = table->get("id");
        if (id == nullptr) fail(node, "a solver without 'id', expected for example id = \"pso\"");
        spec.id = word_of(*id, "id");
        spec.label = spec.id;
        if (const auto* value = table->get("project")) {
          spec.project = truth_of(*value, "project");
          if (spec.project) spec.label += " (projected)";
        }
        if (const auto* label = table->get("label")) spec.label = word_of(*label, "label");
        if (const auto* value = table->get("settings")) {
          settings = &table_of(*value, "settings", "settings = { population = 100 }");
        }
      }
      const SolverEntry* entry = find_solver(spec.id);
      if (entry == nullptr) {
        fail(node, "unknown solver " + in_quotes(spec.id) + suggestion(spec.id, ids_of(solver_catalogue())) +
                       ", see `hysteron list solvers`");
      }
      if (spec.project) {
        if (const std::string why = projection_refusal(*entry); !why.empty()) fail(node, "'project': " + why);
      }
      if (settings != nullptr) {
        for (const auto& [key, value] : *settings) {
          const std::string name(key.str());
          const auto row =
              std::ranges::find(entry->settings, name, [](const Setting& one) { return std::string(one.name); });
          if (row == entry->settings.end()) {
            std::vector<std::string> known;
            for (const Setting& one : entry->settings) known.emplace_back(one.name);
            fail(value, "solver " + in_quotes(spec.id) + " has no setting " + in_quotes(name) +
                            suggestion(name, known) + ", see `hysteron describe " + spec.id + "`");
          }
          spec.settings[name] = number_of(value, name, row->lower, row->upper);
        }
      }
      return spec;
    });
  }

  fs::path path_;
};

}  // namespace

Study read_study_file(const fs::path& path) { return parse_study_file(read_file(path), path); }

Study parse_study_file(const std::string& text, const fs::path& path) { return Parser(path).run(text); }

}  // namespace hysteron
