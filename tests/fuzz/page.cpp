// report.html of an earlier diagnosis, whose data `report` takes over. The data of a page of these data are the same.
#include <nlohmann/json.hpp>

#include "report/html.hpp"
#include "target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hysteron;
  const nlohmann::json found = data_of_page(std::string(fuzz::text_of(data, size)));
  if (found.is_null()) return 0;
  const nlohmann::json once = data_of_page(fit_report_html(found));
  fuzz::require(once.is_object(), "a page holds its data");
  fuzz::require(data_of_page(fit_report_html(once)) == once, "data that went through a page stay what they are");
  return 0;
}
