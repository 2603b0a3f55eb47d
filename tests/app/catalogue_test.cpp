// What the program says of its catalogue.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "app/narrow.hpp"
#include "app/program_fixture.hpp"

namespace hysteron {
namespace {

using nlohmann::json;
using testing::expect_narrow;
using testing::Outcome;
using testing::Program;

using Catalogue = Program;

// The descriptions as JSON are those of task/catalogue.hpp: one of each kind goes through the program.
TEST_F(Catalogue, EverythingIsListedAndDescribedInNarrowLines) {
  for (const std::string kind : {"models", "solvers", "effects", "datasets", "tables"}) {
    expect_narrow(run({"list", kind}), kind);
    const Outcome listed = run({"list", kind, "--json"});
    ASSERT_EQ(listed.status, 0) << listed.err;
    const json rows = json::parse(listed.out);
    ASSERT_TRUE(rows.is_array());
    std::set<std::string> ids;
    for (const json& row : rows) {
      const auto id = row.at("id").get<std::string>();
      EXPECT_TRUE(ids.insert(id).second) << id << " twice";
      EXPECT_FALSE(row.at("title").get<std::string>().empty()) << id;
    }
    if (kind == "tables") continue;
    ASSERT_FALSE(ids.empty()) << kind;
    for (const std::string& id : ids) {
      const Outcome described = run({"describe", id});
      expect_narrow(described, id);
      EXPECT_NE(described.out.find(id), std::string::npos);
      EXPECT_EQ(described.out.find("N/A"), std::string::npos) << id << ": newtons per ampere are not 'N/A'";
    }
    const Outcome card = run({"describe", *ids.begin(), "--json"});
    ASSERT_EQ(card.status, 0) << card.err;
    EXPECT_EQ(json::parse(card.out).at("id"), *ids.begin());
  }
}

}  // namespace
}  // namespace hysteron
