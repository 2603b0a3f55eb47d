// Gives every file of the folders named to a target, without libFuzzer and with any compiler: what was found once stays
// fixed. An input that ends the process, or takes longer than ten seconds, is named.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "target.hpp"

namespace {

constexpr unsigned longest = 10;  // s

std::array<char, 4096> current{};

extern "C" void name_input(int signal) {
  static_cast<void>(!write(STDERR_FILENO, current.data(), std::strlen(current.data())));
  static_cast<void>(!write(STDERR_FILENO, "\n", 1));
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

int main(int count, char** words) {
  for (const int signal : {SIGABRT, SIGALRM, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) std::signal(signal, name_input);
  std::size_t inputs = 0;
  for (int k = 1; k < count; ++k) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(words[k])) files.push_back(entry.path());
    std::ranges::sort(files);
    for (const auto& file : files) {
      std::snprintf(current.data(), current.size(), "at the input %s", file.c_str());
      std::ifstream stream(file, std::ios::binary);
      const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
      alarm(longest);
      LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
      alarm(0);
      ++inputs;
    }
  }
  std::printf("%zu inputs\n", inputs);
  return inputs > 0 ? 0 : 1;
}
