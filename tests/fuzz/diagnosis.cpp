// diagnosis.json as `report` reads it. What is taken gives a text that commands no terminal, and a page.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "report/html.hpp"
#include "target.hpp"
#include "task/diagnosis_text.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hysteron;
  fuzz::taken([&] {
    const nlohmann::json record = parse_diagnosis(fuzz::text_of(data, size), "diagnosis.json");
    const std::string text = diagnosis_text(record, "diagnosis.json");
    fuzz::require(std::ranges::none_of(text, [](char c) { return c == '\x1b' || c == '\r' || c == '\b'; }),
                  "the text commands no terminal");
    const std::string page = fit_report_html({{"title", "Diagnosis"}, {"diagnosis", record}});
    fuzz::require(data_of_page(page).at("diagnosis").at("schema") == record.at("schema"), "the page holds the record");
  });
  return 0;
}
