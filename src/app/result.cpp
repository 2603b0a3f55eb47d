#include "app/result.hpp"

#include <cstdio>

#include "app/command.hpp"
#include "core/error.hpp"
#include "io/output.hpp"

namespace hysteron::app {

void write_result(const std::string& out, std::string_view bytes) {
  if (is_standard_output(out)) {
    std::fwrite(bytes.data(), 1, bytes.size(), stdout);
  } else {
    write_file_atomically(out, bytes);
  }
}

void write_table(const std::string& out, const std::string& csv) { write_result(out, table_bytes(out, csv)); }

void say_beside(const std::string& out, std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), is_standard_output(out) ? stderr : stdout);
}

void refuse_other_results(const std::filesystem::path& folder, std::string_view own) {
  struct Result {
    const char* file;
    const char* what;
  };
  static constexpr Result results[] = {{"fit.json", "a fit"},
                                       {"diagnosis.json", "a diagnosis"},
                                       {"compare.json", "a comparison"},
                                       {"store.sqlite", "a study"},
                                       {"seal.sha256", "a challenge"}};
  std::error_code ignored;
  if (std::filesystem::exists(folder / own, ignored)) return;
  for (const auto& [file, what] : results) {
    if (!std::filesystem::exists(folder / file, ignored)) continue;
    throw InputError("--out " + folder.string() + ": holds " + what + " (" + file +
                     "), whose report.html would be replaced, expected another folder");
  }
}

void warn_or_refuse_other_results(const std::filesystem::path& folder, std::string_view own, std::string_view other) {
  std::error_code ignored;
  if (std::filesystem::exists(folder / own, ignored) || !std::filesystem::exists(folder / other, ignored)) {
    refuse_other_results(folder, own);
    return;
  }
  warn_of({"--out " + folder.string() + ": " + std::string(other) +
           " there is of an earlier command, whose model.json and report.html are replaced"});
}

void refuse_data_folder(const std::filesystem::path& folder, const std::vector<std::string>& data) {
  for (const std::string& word : data) {
    const std::filesystem::path path(word);
    std::error_code ignored;
    const std::filesystem::path from = std::filesystem::is_directory(path, ignored) ? path
                                       : path.has_parent_path()                     ? path.parent_path()
                                                                                    : std::filesystem::path(".");
    if (!std::filesystem::equivalent(folder, from, ignored)) continue;
    throw InputError("--out " + folder.string() + ": the recordings are in this folder, and tables written there " +
                     "would be read as such, expected another folder");
  }
}

}  // namespace hysteron::app
