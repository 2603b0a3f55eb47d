// Recordings as workbooks. An input that is no zip archive is the XML of a sheet, or, behind a NUL, of its texts: a
// checksum would keep the fuzzer away from what is in an archive.
#include "../io/measuring_files.hpp"
#include "recording_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hysteron;
  const std::string_view bytes = fuzz::text_of(data, size);
  if (bytes.starts_with("PK") || bytes.starts_with("\xD0\xCF")) {
    fuzz::read_as("xlsx", bytes);
    return 0;
  }
  const std::size_t end = std::min(bytes.find('\0'), bytes.size());
  auto parts = testing::workbook_parts({{"Test", ""}});
  for (auto& [path, content] : parts) {
    if (path == "xl/worksheets/sheet1.xml") content = bytes.substr(0, end);
    if (end < bytes.size() && path == "xl/_rels/workbook.xml.rels") {
      const std::string relation = "<Relationship Id=\"t\" Type=\"x/sharedStrings\" Target=\"texts.xml\"/>";
      content.insert(content.find("</Relationships>"), relation);
    }
  }
  if (end < bytes.size()) parts.emplace_back("xl/texts.xml", bytes.substr(end + 1));
  fuzz::read_as("xlsx", testing::zip_of(parts));
  return 0;
}
