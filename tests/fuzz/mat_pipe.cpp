// What the process that reads MAT files of 7.3 gives back, which may have gone wrong in any way. What is taken, written
// again, is read as the same.
#include "io/mat_pipe.hpp"

#include "target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hysteron;
  std::vector<MatVariable> variables;
  if (!fuzz::taken<MatDamage>([&] { variables = read_piped(fuzz::text_of(data, size)); })) return 0;
  std::string once;
  for (const MatVariable& variable : variables) append_piped(once, variable);
  std::string twice;
  for (const MatVariable& variable : read_piped(once)) append_piped(twice, variable);
  fuzz::require(once == twice, "written and read again it is the same");
  return 0;
}
