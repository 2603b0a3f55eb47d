#include "app/result.hpp"

#include <cstdio>

#include "app/command.hpp"
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

}  // namespace hysteron::app
