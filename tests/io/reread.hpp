// What is said of a recording when it is written to a file and read.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "io/csv.hpp"

namespace hysteron::testing {

// The remarks of this key.
inline std::vector<std::string> said_of(const Recording& recording, const std::string& key) {
  std::string text = "time [s],displacement [m],force [N]\n";
  for (std::size_t n = 0; n < recording.size(); ++n) {
    text += fmt::format("{:.9g},{:.9g},{:.9g}\n", recording.time[n], recording.displacement[n], recording.force[n]);
  }
  std::vector<std::string> said;
  ReadOptions options;
  options.remark = [&](const Remark& remark) {
    if (remark.key == key) said.push_back(remark.text.plain());
  };
  (void)parse_csv(text, "r.csv", options);
  return said;
}

}  // namespace hysteron::testing
