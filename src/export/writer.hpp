// Straight-line code written out in C99 or Python.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "export/equations.hpp"

namespace hysteron {

enum class Language { c, python };

// Shortest digits that read back to the same number, as a floating-point literal of both languages.
std::string literal(double value);

// A parameter's name as an identifier of both languages: p_NAME.
std::string parameter_identifier(const Parameter& parameter);

struct Statements {
  std::vector<std::string> lines;  // definitions of temporaries, without indentation
  struct Result {
    ArgumentNumber target;
    std::string expression;
  };
  std::vector<Result> results;
  std::vector<ArgumentNumber> used;  // inputs that occur
};
Statements write_statements(const Function& function, std::span<const Parameter> parameters, Language language);

}  // namespace hysteron
