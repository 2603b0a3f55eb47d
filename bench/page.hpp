// Where the programs of this folder write what they found.
#pragma once

#include <fmt/format.h>

#include <string>

#include "io/output.hpp"

namespace hysteron::bench {

// Into the file `page`, or on standard output where it is empty.
inline void write_page(const std::string& page, const std::string& text) {
  if (page.empty()) {
    fmt::print("{}", text);
  } else {
    write_file_atomically(page, text);
  }
}

}  // namespace hysteron::bench
