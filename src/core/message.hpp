// Messages that name what a caller can give, as its bounds or its model. The command line calls that an option, another
// caller an argument: the message says which it is, and who prints it says how it is called there.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/error.hpp"

namespace hysteron {

enum class Option {
  at,
  bounds,
  budget,
  by,
  by_current,
  by_frequency,
  column,
  drive,
  effects,
  excitation,
  fix,
  group,
  interpolation,
  keep_samples,
  laws,
  model,
  most_substeps,
  name,
  normalisation,
  out,
  set,
  skip,
  solver,
  stages,
  substeps,
  to,
  tolerance,
  weighting,
  without_time,
};

// "by-current": words with hyphens between them.
std::string_view name_of(Option option);
std::span<const Option> all_options();

// A line of text in which some words are options.
class Message {
 public:
  Message(std::string text) { parts_.emplace_back(std::move(text)); }  // NOLINT(google-explicit-constructor)
  Message(const char* text) : Message(std::string(text)) {}            // NOLINT(google-explicit-constructor)
  Message(Option option) { parts_.emplace_back(option); }              // NOLINT(google-explicit-constructor)

  Message& operator+=(Message more);

  [[nodiscard]] bool empty() const { return plain().empty(); }
  // Options by what they are: "by current".
  [[nodiscard]] std::string plain() const;
  // Options as `called` has them.
  [[nodiscard]] std::string with(std::string (*called)(Option)) const;

 private:
  std::vector<std::variant<std::string, Option>> parts_;
};

Message operator+(Message a, const Message& b);
Message operator+(Message a, Option b);
Message operator+(Option a, const Message& b);

// An InputError that names options; what() is its message in plain words.
class OptionError : public InputError {
 public:
  explicit OptionError(const Message& message) : InputError(message.plain()), message_(message) {}
  OptionError(const std::string& file, int line, const Message& message)
      : OptionError(Message(InputError(file, line, "").what()) + message) {}

  [[nodiscard]] const Message& message() const { return message_; }

 private:
  Message message_;
};

}  // namespace hysteron
