// What the targets share. Each is one function of libFuzzer, LLVMFuzzerTestOneInput, on a reader of files of strangers.
// The reader takes the input or refuses it with the error that its header names; anything else it throws, what a
// sanitizer reports and a property that does not hold end the process, which is a finding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "core/error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace hysteron::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// Whether the input was taken; `Refusal` says that it was not.
template <class Refusal = InputError, class Work>
bool taken(const Work& work) {
  try {
    work();
    return true;
  } catch (const Refusal& refusal) {
    if (*refusal.what() == '\0') std::abort();
    return false;
  }
}

inline void require(bool holds, const char* property) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", property);
  std::abort();
}

}  // namespace hysteron::fuzz
