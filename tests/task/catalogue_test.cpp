#include "task/catalogue.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "task/json_text.hpp"

namespace hysteron {
namespace {

TEST(Catalogue, EverythingListedIsDescribedAsJson) {
  for (const std::string kind : {"models", "solvers", "effects", "datasets"}) {
    const std::vector<CatalogueRow> rows = catalogue_rows(kind);
    EXPECT_FALSE(rows.empty()) << kind;
    for (const CatalogueRow& row : rows) {
      EXPECT_EQ(nlohmann::json::parse(json_text(description_json(row.id))).at("id"), row.id);
    }
  }
}

}  // namespace
}  // namespace hysteron
