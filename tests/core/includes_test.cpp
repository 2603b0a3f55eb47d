// Includes go one way: each folder of the sources names the folders it may include, and no others are included.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace {

namespace fs = std::filesystem;

using Allowed = std::map<std::string, std::set<std::string>>;

const Allowed& allowed() {
  static const Allowed table = {
      {"src/core", {}},
      {"src/scalar", {}},
      {"src/io", {"core"}},
      {"src/simulate", {"core", "scalar"}},
      {"models", {"simulate", "scalar"}},
      {"models/effects", {"models", "simulate", "scalar"}},
      {"src/fit", {"core", "scalar", "simulate"}},
      {"src/check", {"core", "fit", "io"}},
      {"src/external", {"core", "fit"}},
      {"algorithms", {"algorithms/support", "core", "fit"}},
      {"src/diagnose/signal", {"core", "fit", "io", "simulate"}},
      {"src/diagnose/residual", {"core", "diagnose/signal", "fit", "io"}},
      {"src/diagnose/judge", {"core"}},
      {"src/diagnose/search",
       {"core", "diagnose/judge", "diagnose/residual", "diagnose/signal", "fit", "io", "simulate"}},
      {"src/diagnose",
       {"core", "diagnose/judge", "diagnose/residual", "diagnose/search", "diagnose/signal", "fit", "io"}},
      {"src/challenge", {"core", "io"}},
      {"src/report", {"core"}},
      {"src/compare", {"core"}},
      {"src/respond", {"core", "fit", "io"}},
      {"src/export", {"core", "fit", "io", "scalar", "simulate"}},
      {"src/plugin", {"core", "fit", "simulate"}},
      {"presets", {"presets/support"}},
      {"datasets", {"core", "datasets/support", "io", "presets/support", "simulate"}},
      {"src/study",
       {"check", "core", "datasets", "datasets/support", "external", "fit", "io", "presets/support", "report",
        "simulate"}},
      {"src/task",
       {"check", "compare", "core", "datasets", "diagnose", "diagnose/search", "export", "fit", "io", "presets",
        "report", "respond", "simulate", "study"}},
  };
  return table;
}

std::string folder_of(const std::string& include) {
  const std::size_t slash = include.rfind('/');
  return slash == std::string::npos ? std::string{} : include.substr(0, slash);
}

TEST(Includes, GoOneWay) {
  const fs::path root = HYSTERON_SOURCE_DIR;
  std::size_t seen = 0;
  for (const auto& [folder, includes] : allowed()) {
    const std::string own = folder.starts_with("src/") ? folder.substr(4) : folder;
    for (const fs::directory_entry& entry : fs::directory_iterator(root / folder)) {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") {
        continue;
      }
      std::ifstream file(entry.path());
      const std::string opening = "#include \"";
      for (std::string line; std::getline(file, line);) {
        if (!line.starts_with(opening)) {
          continue;
        }
        const std::string of = folder_of(line.substr(opening.size(), line.rfind('"') - opening.size()));
        ++seen;
        EXPECT_TRUE(of == own || includes.contains(of))
            << entry.path().string() << " includes from " << of << ", which " << folder << " may not";
      }
    }
  }
  EXPECT_GT(seen, 500U);
}

// Two classes of one name in one namespace are one to the linker, whatever they hold: it keeps one copy of what both
// generate, and the other class is destroyed by it.
TEST(Names, OfClassesInHeadersAreTheirOwn) {
  const std::regex opening("namespace ([A-Za-z_:]+) \\{");
  const std::regex definition("(struct|class|enum class) ([A-Z][A-Za-z0-9]*)( final)?( : [^;]*)? \\{.*");
  std::map<std::string, std::string> seen;
  for (const char* folder : {"src", "models", "algorithms", "datasets", "presets"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(fs::path(HYSTERON_SOURCE_DIR) / folder)) {
      if (entry.path().extension() != ".hpp") continue;
      std::ifstream file(entry.path());
      std::string space;
      for (std::string line; std::getline(file, line);) {
        std::smatch match;
        if (std::regex_match(line, match, opening)) space = match[1];
        if (!std::regex_match(line, match, definition)) continue;
        const auto [other, fresh] = seen.emplace(space + "::" + match[2].str(), entry.path().string());
        EXPECT_TRUE(fresh) << other->first << " in " << other->second << " and " << entry.path();
      }
    }
  }
  EXPECT_GT(seen.size(), 200U);
}

}  // namespace
