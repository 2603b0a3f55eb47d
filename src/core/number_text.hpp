// Numbers as messages print them.
#pragma once

#include <cstdio>
#include <string>

namespace hysteron {

// Significant digits, three unless said: "0.00123", "1e+04".
inline std::string number_text(double value, int digits = 3) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

}  // namespace hysteron
