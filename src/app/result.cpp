#include "app/result.hpp"

#include <cstdio>
#include <filesystem>

#include "app/command.hpp"
#include "io/mat5_writer.hpp"
#include "io/output.hpp"
#include "io/text.hpp"

namespace hysteron::app {

void write_result(const std::string& out, std::string_view bytes) {
  if (is_standard_output(out)) {
    std::fwrite(bytes.data(), 1, bytes.size(), stdout);
  } else {
    write_file_atomically(out, bytes);
  }
}

void write_table(const std::string& out, const std::string& csv) {
  const bool mat = lower_case(std::filesystem::path(out).extension().string()) == ".mat";
  write_result(out, mat ? mat5_of_columns(csv) : csv);
}

void say_beside(const std::string& out, std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), is_standard_output(out) ? stderr : stdout);
}

}  // namespace hysteron::app
