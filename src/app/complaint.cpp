#include "app/complaint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "app/mistyped.hpp"

namespace hysteron::app {
namespace {

std::string number(std::size_t count) { return count == 1 ? "one" : std::to_string(count); }
std::string are(std::size_t count) { return count == 1 ? "is" : "are"; }

// What an option takes, as --help says it first.
std::string expected_of(const CLI::Option& option) {
  const std::string text = option.get_description();
  return text.substr(0, text.find(';'));
}

// "MODEL: one is expected, 2 were given: a, b".
std::string miscounted(const std::string& name, std::size_t least, std::size_t most,
                       const std::vector<std::string>& given) {
  const bool few = given.size() < least;
  const std::string bound = least == most ? "" : few ? "at least " : "at most ";
  const std::size_t wanted = few ? least : most;
  return fmt::format("{}: {}{} {} expected, {} {} given: {}", name, bound, number(wanted), are(wanted),
                     number(given.size()), given.size() == 1 ? "was" : "were", fmt::join(given, ", "));
}

// The option whose name opens a message of the parser.
const CLI::Option* opening(const CLI::App& command, std::string_view message) {
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (message.starts_with(name) && message.size() > name.size() &&
        (message[name.size()] == ':' || message[name.size()] == ' ')) {
      return option;
    }
  }
  return nullptr;
}

std::optional<std::string> missing_in(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_required() && option->count() == 0) {
      return fmt::format("{}: {} is missing, expected {}", command.get_name(), option->get_name(),
                         expected_of(*option));
    }
  }
  return std::nullopt;
}

std::optional<std::string> mismatch_in(const CLI::App& command, std::string_view message) {
  const CLI::Option* option = opening(command, message);
  if (option == nullptr) return std::nullopt;
  const std::vector<std::string>& given = option->results();
  if (given.empty()) return fmt::format("{}: no value is given, expected {}", option->get_name(), expected_of(*option));
  return miscounted(option->get_name(), static_cast<std::size_t>(std::max(0, option->get_items_expected_min())),
                    static_cast<std::size_t>(option->get_items_expected_max()), given);
}

// Words that no option takes and no positional has room for.
std::optional<std::string> too_many_for(const CLI::App& command) {
  const std::vector<std::string> extra = command.remaining();
  if (extra.empty()) return std::nullopt;
  const CLI::Option* last = nullptr;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) last = option;
  }
  if (last == nullptr) {
    return fmt::format("{}: '{}' is not expected, it takes options alone", command.get_name(), extra.front());
  }
  std::vector<std::string> given = last->results();
  given.insert(given.end(), extra.begin(), extra.end());
  return miscounted(last->get_name(), 1, static_cast<std::size_t>(last->get_items_expected_max()), given);
}

// "A requires B" and "A excludes B" of the parser; "{}" of `expected` is B.
std::optional<std::string> paired(std::string_view message, std::string_view verb, std::string_view expected) {
  const std::size_t at = message.find(verb);
  if (at == std::string_view::npos) return std::nullopt;
  return fmt::format("{}: expected {}", message.substr(0, at),
                     fmt::format(fmt::runtime(expected), message.substr(at + verb.size())));
}

std::optional<std::string> in_own_words(const CLI::App& command, const CLI::ParseError& error) {
  const std::string_view message = error.what();
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
    if (auto words = missing_in(command)) return words;
    return command.get_parent() == nullptr ? std::optional<std::string>("no command is given, expected one")
                                           : std::nullopt;
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) return mismatch_in(command, message);
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) return too_many_for(command);
  if (dynamic_cast<const CLI::RequiresError*>(&error) != nullptr) return paired(message, " requires ", "{} beside it");
  if (dynamic_cast<const CLI::ExcludesError*>(&error) != nullptr)
    return paired(message, " excludes ", "no {} beside it");
  if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) {
    for (const CLI::Option* option : command.get_options()) {
      if (option->count() > 0 && message.find(" " + option->get_name() + " ") != std::string_view::npos) {
        return fmt::format("{}: '{}' is not what it takes, expected {}", option->get_name(),
                           fmt::join(option->results(), ", "), expected_of(*option));
      }
    }
  }
  return std::nullopt;
}

}  // namespace

std::string complaint(const CLI::App& program, const CLI::ParseError& error) {
  const std::vector<CLI::App*> typed = program.get_subcommands();
  std::string words = in_own_words(typed.empty() ? program : *typed.front(), error).value_or(error.what());
  std::ranges::replace(words, '\n', ' ');
  return words + " (" + see_help(program) + ")";
}

}  // namespace hysteron::app
