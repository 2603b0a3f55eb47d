// Numbers as messages print them.
#pragma once

#include <cstdio>
#include <string>

namespace hysteron {

// Three significant digits: "0.00123", "1e+04".
inline std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace hysteron
