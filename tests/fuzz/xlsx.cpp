// Recordings as workbooks. An input that is no zip archive is the XML of a sheet, behind a NUL of its texts, and behind
// another of its styles: a checksum would keep the fuzzer away from what is in an archive.
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
  const std::size_t styles = end < bytes.size() ? std::min(bytes.find('\0', end + 1), bytes.size()) : end;
  auto parts = testing::workbook_parts({{"Test", ""}});
  for (auto& [path, content] : parts) {
    if (path == "xl/worksheets/sheet1.xml") content = bytes.substr(0, end);
    if (path != "xl/_rels/workbook.xml.rels") continue;
    const auto relate = [&text = content](const std::string& id, const std::string& type) {
      const std::string relation =
          "<Relationship Id=\"" + id + "\" Type=\"x/" + type + "\" Target=\"" + id + ".xml\"/>";
      text.insert(text.find("</Relationships>"), relation);
    };
    if (end < bytes.size()) relate("texts", "sharedStrings");
    if (styles < bytes.size()) relate("styles", "styles");
  }
  if (end < bytes.size()) parts.emplace_back("xl/texts.xml", bytes.substr(end + 1, styles - end - 1));
  if (styles < bytes.size()) parts.emplace_back("xl/styles.xml", bytes.substr(styles + 1));
  fuzz::read_as("xlsx", testing::zip_of(parts));
  return 0;
}
