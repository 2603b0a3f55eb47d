#include "arguments.hpp"

#include <algorithm>
#include <cctype>

namespace hysteron::python {

std::string argument_name(Option option) {
  if (option == Option::column) return "columns";
  std::string name(name_of(option));
  std::ranges::replace(name, '-', '_');
  return name;
}

std::string with_arguments(const std::string& message) {
  std::string result;
  const auto in_option = [](char c) { return c == '-' || std::islower(static_cast<unsigned char>(c)) != 0; };
  for (std::size_t n = 0; n < message.size();) {
    const bool begins = message.compare(n, 2, "--") == 0 && n + 2 < message.size() &&
                        std::islower(static_cast<unsigned char>(message[n + 2])) != 0;
    if (!begins) {
      result += message[n++];
      continue;
    }
    std::size_t end = n + 2;
    while (end < message.size() && in_option(message[end])) ++end;
    std::string name = message.substr(n + 2, end - n - 2);
    std::ranges::replace(name, '-', '_');
    result += name == "column" ? "columns" : name;
    n = end;
  }
  return result;
}

}  // namespace hysteron::python
