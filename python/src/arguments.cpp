#include "arguments.hpp"

#include <algorithm>
#include <cctype>
#include <regex>

namespace hysteron::python {

std::string with_mappings(const std::string& message) {
  // CHANNEL="COLUMN" behind the argument is an entry of its dictionary.
  static const std::regex mapping("\\bcolumns ([^ =]+)=(\"[^\"]*\"|[^ ,;]+)");
  std::string result;
  auto from = message.cbegin();
  for (std::smatch found; std::regex_search(from, message.cend(), found, mapping); from = found.suffix().first) {
    const std::string column = found[2].str();
    result += found.prefix().str() + "columns={\"" + found[1].str() +
              "\": " + (column.starts_with('"') ? column : '"' + column + '"') + "}";
  }
  return result + std::string(from, message.cend());
}

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
