#include "datasets/support/shipped.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "datasets/dataset.hpp"
#include "io/campaign.hpp"
#include "io/file.hpp"

namespace hysteron {

namespace fs = std::filesystem;

const DatasetEntry* find_dataset(std::string_view id) {
  const auto catalogue = dataset_catalogue();
  const auto found = std::ranges::find_if(catalogue, [&](const DatasetEntry* entry) { return entry->id == id; });
  return found == catalogue.end() ? nullptr : *found;
}

namespace {

std::vector<fs::path>& further_places() {
  static std::vector<fs::path> places;
  return places;
}

}  // namespace

void look_beside(const fs::path& folder) { further_places().push_back(folder); }

fs::path shipped_folder(std::string_view id) {
  const fs::path name(id);
  std::vector<fs::path> places;
  if (const char* folder = std::getenv("HYSTERON_DATASETS"); folder != nullptr && *folder != '\0') {
    places.push_back(fs::path(folder) / name);
  } else {
    std::error_code unknown;
    const fs::path program = fs::read_symlink("/proc/self/exe", unknown).parent_path();
    const fs::path share = fs::path("share") / "hysteron" / "datasets" / name;
    for (const fs::path& beside : further_places()) places.push_back(beside / share);
    places.push_back(program / share);
    places.push_back(program.parent_path() / share);
  }
  std::string looked;
  for (const fs::path& place : places) {
    std::error_code error;
    if (fs::is_regular_file(place / shipped_checksums, error)) return place;
    looked += (looked.empty() ? "" : " and ") + place.string();
  }
  throw InputError("the recordings of dataset '" + std::string(id) + "' are missing: looked in " + looked +
                   ", expected them where the program was built or installed, or in the folder of HYSTERON_DATASETS");
}

Campaign load_shipped(std::string_view id) {
  const fs::path folder = shipped_folder(id);
  const fs::path sums = folder / shipped_checksums;
  std::map<std::string, std::string> expected;
  std::istringstream lines(read_file(sums));
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const auto gap = line.find("  ");
    if (gap != 64) throw InputError(sums.string(), number, "not a line of sha256sum, expected DIGEST  FILE");
    expected[line.substr(gap + 2)] = line.substr(0, gap);
  }
  Campaign campaign = load_campaign({folder.string()});
  for (const Recording& recording : campaign.recordings) {
    const auto listed = expected.find(recording.file);
    if (listed == expected.end()) {
      throw InputError((folder / recording.file).string() + ": not a recording of dataset '" + std::string(id) +
                       "', expected those of " + sums.string());
    }
    if (listed->second != recording.sha256) {
      throw InputError((folder / recording.file).string() + ": sha256 " + recording.sha256 +
                       ", expected that of the shipped recording, " + listed->second);
    }
    expected.erase(listed);
  }
  if (!expected.empty()) {
    throw InputError((folder / expected.begin()->first).string() + ": the recording is missing, expected all of " +
                     sums.string());
  }
  return campaign;
}

}  // namespace hysteron
