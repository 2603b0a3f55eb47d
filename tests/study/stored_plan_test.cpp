// The plan of a store: what is worked out from it takes its numbers as they are.
#include "study/stored_plan.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "io/temporary_folder.hpp"

namespace hysteron {
namespace {

using nlohmann::json;

json plan() {
  return {{"schema", "hysteron.plan/1"},
          {"title", "t"},
          {"normalisation", "max-abs"},
          {"weighting", "pooled"},
          {"start", "random"},
          {"tolerance", 1e-4},
          {"tie", 0.01},
          {"targets", {1.01}},
          {"target_nrmse", json::array()},
          {"budgets", {10}},
          {"seeds", {1, 2}},
          {"solvers", {{{"label", "pso"}}}},
          {"problems", {{{"label", "p"}, {"model", "m"}, {"data", "d"}, {"dimension", 2}}}},
          {"runs",
           {{{"key", "a"}, {"problem", 0}, {"solver", 0}, {"budget", 10}, {"seed", 1}},
            {{"key", "b"}, {"problem", 0}, {"solver", 0}, {"budget", 10}, {"seed", 2}}}}};
}

TEST(StoredPlan, AWholeOneIsTaken) { EXPECT_EQ(parse_plan(plan().dump(), "out"), plan()); }

TEST(StoredPlan, OneThatPointsAtWhatIsNotThereIsRefused) {
  const auto changed = [](const char* pointer, const json& value) {
    json one = plan();
    one[json::json_pointer(pointer)] = value;
    return one.dump();
  };
  json twice = plan();
  twice["runs"].push_back(twice["runs"][1]);
  json fewer = plan();
  fewer["runs"].erase(1);
  for (const std::string& text :
       {changed("/runs/0/problem", 7), changed("/runs/0/solver", -1), changed("/runs/1/seed", 1),
        changed("/runs/1/budget", nullptr), changed("/runs/0/key", 3), changed("/budgets", json::array()),
        changed("/budgets", {10, 10}), changed("/seeds", {1, 2, 3}), changed("/problems/0/dimension", 1.5),
        changed("/solvers/0", "pso"), changed("/targets", {"x"}), changed("/tie", nullptr), changed("/schema", 1),
        twice.dump(), fewer.dump(), std::string("[]"), std::string("{"), std::string(100000, '[')}) {
    const std::string said = testing::message_of<InputError>([&] { static_cast<void>(parse_plan(text, "out")); });
    EXPECT_TRUE(said.starts_with("out") && said.find("expected the plan as") != std::string::npos)
        << text.substr(0, 200) << ": " << said;
  }
}

}  // namespace
}  // namespace hysteron
