#include "study/stored_plan.hpp"

#include <initializer_list>
#include <set>

#include "core/error.hpp"
#include "io/json_reader.hpp"

namespace hysteron {
namespace {

using nlohmann::json;

constexpr auto expected = "expected the plan as `hysteron bench` stores it";

class PlanChecker {
 public:
  PlanChecker(const json& plan, const std::string& store) : plan_(plan), store_(store) {}

  void run() const {
    if (!plan_.is_object()) wrong("is no object");
    if (plan_.value("schema", json(nullptr)) != "hysteron.plan/1") wrong("is not of the schema hysteron.plan/1");
    texts(plan_, {"title", "normalisation", "weighting", "start"});
    numbers(plan_, {"tolerance", "tie"});
    if (plan_.contains("equivalence")) numbers(plan_, {"equivalence"});
    for (const char* name : {"targets", "target_nrmse"}) {
      for (const json& value : list(name)) {
        if (!value.is_number()) wrong(std::string("has no number in ") + name);
      }
    }
    wholes("budgets");
    wholes("seeds");
    for (const json& solver : list("solvers")) texts(solver, {"label"});
    for (const json& problem : list("problems")) {
      texts(problem, {"label", "model", "data"});
      whole(problem, "dimension");
      if (problem.contains("box")) ranges(problem.at("box"));
    }
    check_runs();
  }

 private:
  [[noreturn]] void wrong(const std::string& what) const {
    throw InputError(store_, 0, "the plan of the study " + what + ", " + expected);
  }

  [[nodiscard]] const json& list(const char* name) const {
    const auto at = plan_.find(name);
    if (at == plan_.end() || !at->is_array()) wrong(std::string("has no list of ") + name);
    return *at;
  }

  void ranges(const json& box) const {
    for (const json& range : box) {
      if (!box.is_object() || !range.is_array() || range.size() != 2 || !range[0].is_number() ||
          !range[1].is_number()) {
        wrong("has a box whose ranges are no pairs of numbers");
      }
    }
  }

  void texts(const json& object, std::initializer_list<const char*> names) const {
    for (const char* name : names) {
      if (!object.is_object() || !object.contains(name) || !object.at(name).is_string()) {
        wrong(std::string("lacks a text '") + name + "'");
      }
    }
  }

  void numbers(const json& object, std::initializer_list<const char*> names) const {
    for (const char* name : names) {
      if (!object.contains(name) || !object.at(name).is_number()) wrong(std::string("lacks a number '") + name + "'");
    }
  }

  std::uint64_t whole(const json& object, const char* name) const {
    if (!object.contains(name) || !object.at(name).is_number_unsigned()) {
      wrong(std::string("lacks a whole number '") + name + "'");
    }
    return object.at(name).get<std::uint64_t>();
  }

  // Whole numbers, each once, at least one.
  void wholes(const char* name) const {
    std::set<std::uint64_t> seen;
    for (const json& value : list(name)) {
      if (!value.is_number_unsigned() || !seen.insert(value.get<std::uint64_t>()).second) {
        wrong(std::string("has ") + name + " that are not whole numbers, each once");
      }
    }
    if (seen.empty()) wrong(std::string("has no ") + name);
  }

  // Every problem at every budget with every seed by every solver, in this order.
  void check_runs() const {
    const json& runs = list("runs");
    const json& budgets = list("budgets");
    const json& seeds = list("seeds");
    const std::size_t problems = list("problems").size();
    const std::size_t solvers = list("solvers").size();
    // No product: it may be larger than a whole number.
    std::size_t k = 0;
    for (std::size_t p = 0; p < problems; ++p) {
      for (const json& budget : budgets) {
        for (const json& seed : seeds) {
          for (std::size_t s = 0; s < solvers; ++s, ++k) {
            if (k >= runs.size()) wrong("lacks runs");
            const json& run = runs.at(k);
            texts(run, {"key"});
            if (whole(run, "problem") != p || whole(run, "solver") != s ||
                run.value("budget", json(nullptr)) != budget || run.value("seed", json(nullptr)) != seed) {
              wrong("names run " + std::to_string(k + 1) + " otherwise than its lists");
            }
          }
        }
      }
    }
    if (k != runs.size()) wrong("has more runs than its lists");
  }

  const json& plan_;
  const std::string& store_;
};

}  // namespace

json parse_plan(const std::string& text, const std::string& store) {
  json plan = parse_json(text, store, expected);
  PlanChecker(plan, store).run();
  return plan;
}

}  // namespace hysteron
