// The error of a user's file or command line: reported in one line, exit status 2.
#pragma once

#include <stdexcept>
#include <string>

namespace hysteron {

// what() reads "FILE:LINE: what is wrong, what was expected" (line 0 and an empty file are left out).
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  InputError(const std::string& file, int line, const std::string& message)
      : std::runtime_error(file + (line > 0 ? ":" + std::to_string(line) : std::string{}) + ": " + message) {}
};

// The work itself failed although the input was fine: exit status 1.
class WorkError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace hysteron
