#include "task/result_file.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/message.hpp"
#include "io/file.hpp"
#include "io/format.hpp"
#include "io/mat5_writer.hpp"
#include "io/text.hpp"

namespace hysteron {
namespace {

std::string ending_of(const std::string& out) { return lower_case(std::filesystem::path(out).extension().string()); }

bool read_by_ending(const std::string& ending) {
  return std::ranges::any_of(formats(), [&](const InputFormat* format) {
    return std::ranges::find(format->endings, ending, &Ending::text) != format->endings.end();
  });
}

}  // namespace

void refuse_inputs(const std::string& out, const std::vector<std::string>& inputs) {
  const std::filesystem::path path(out);
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code)) return;
  const std::filesystem::path target = std::filesystem::weakly_canonical(path, code);
  for (const std::string& input : inputs) {
    const bool folder = std::filesystem::is_directory(input, code);
    const bool among = folder && std::filesystem::equivalent(target.parent_path(), input, code) &&
                       (read_by_ending(ending_of(out)) || target.filename() == "campaign.toml");
    if (among || (!folder && std::filesystem::equivalent(target, input, code))) {
      throw OptionError(Option::out + " " + out + ": " + (folder ? "is among the recordings of " + input : "is read") +
                        " and would be replaced, expected another file");
    }
  }
}

void refuse_foreign(const std::filesystem::path& folder, const std::map<std::string, std::string>& texts) {
  for (const auto& [name, text] : texts) {
    const std::filesystem::path path = folder / name;
    std::error_code code;
    if (!std::filesystem::is_regular_file(path, code)) continue;
    const std::string there = read_file(path);
    if (there == text || there.find("hysteron") != std::string::npos) continue;
    throw OptionError(Option::out + " " + folder.string() + ": " + name +
                      " is there and was not written by hysteron, expected another folder");
  }
}

void check_table(const std::string& out, const std::vector<std::string>& inputs) {
  const std::string ending = ending_of(out);
  const bool written = ending == ".csv" || ending == ".txt" || ending == ".mat";
  if (!written && read_by_ending(ending)) {
    throw OptionError(Option::out + " " + out + ": tables are not written as " + ending + ", expected .csv or .mat");
  }
  refuse_inputs(out, inputs);
}

std::string table_bytes(const std::string& out, const std::string& csv) {
  return ending_of(out) == ".mat" ? mat5_of_columns(csv) : csv;
}

}  // namespace hysteron
