#include "app/result.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "app/command.hpp"
#include "core/error.hpp"
#include "io/file.hpp"
#include "io/format.hpp"
#include "io/mat5_writer.hpp"
#include "io/output.hpp"
#include "io/text.hpp"

namespace hysteron::app {
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
  if (is_standard_output(out) || !std::filesystem::is_regular_file(path, code)) return;
  const std::filesystem::path target = std::filesystem::weakly_canonical(path, code);
  for (const std::string& input : inputs) {
    const bool folder = std::filesystem::is_directory(input, code);
    const bool among = folder && std::filesystem::equivalent(target.parent_path(), input, code) &&
                       (read_by_ending(ending_of(out)) || target.filename() == "campaign.toml");
    if (among || (!folder && std::filesystem::equivalent(target, input, code))) {
      throw InputError("--out " + out + ": " + (folder ? "is among the recordings of " + input : "is read") +
                       " and would be replaced, expected another file");
    }
  }
}

void refuse_foreign(const std::filesystem::path& folder, const std::map<std::string, std::string>& files) {
  for (const auto& [name, text] : files) {
    const std::filesystem::path path = folder / name;
    std::error_code code;
    if (!std::filesystem::is_regular_file(path, code)) continue;
    const std::string there = read_file(path);
    if (there == text || there.find("hysteron") != std::string::npos) continue;
    throw InputError("--out " + folder.string() + ": " + name +
                     " is there and was not written by hysteron, expected another folder");
  }
}

void check_table(const std::string& out, const std::vector<std::string>& inputs) {
  const std::string ending = ending_of(out);
  const bool written = ending == ".csv" || ending == ".txt" || ending == ".mat";
  if (!written && read_by_ending(ending)) {
    throw InputError("--out " + out + ": tables are not written as " + ending + ", expected .csv or .mat");
  }
  refuse_inputs(out, inputs);
}

void write_result(const std::string& out, std::string_view bytes) {
  if (is_standard_output(out)) {
    std::fwrite(bytes.data(), 1, bytes.size(), stdout);
  } else {
    write_file_atomically(out, bytes);
  }
}

void write_table(const std::string& out, const std::string& csv) {
  write_result(out, ending_of(out) == ".mat" ? mat5_of_columns(csv) : csv);
}

void say_beside(const std::string& out, std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), is_standard_output(out) ? stderr : stdout);
}

}  // namespace hysteron::app
