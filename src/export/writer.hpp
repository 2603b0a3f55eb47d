// Straight-line code written out in C99, Python or Modelica.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "export/equations.hpp"

namespace hysteron {

enum class Language { c, python, modelica };

// Shortest digits that read back to the same number, as a floating-point literal of all languages.
std::string literal(double value);

// A parameter's name as an identifier of both languages: p_NAME.
std::string parameter_identifier(const Parameter& parameter);

struct Statements {
  std::vector<std::string> lines;  // definitions of temporaries, without indentation
  std::vector<std::string> names;  // of the temporaries, one a line
  struct Result {
    ArgumentNumber target;
    std::string expression;
  };
  std::vector<Result> results;
  std::vector<ArgumentNumber> used;  // inputs that occur
};
Statements write_statements(const Function& function, std::span<const Parameter> parameters, Language language);
// Modelica, with names of the caller's: of the inputs, and what follows the number of a temporary;
// `assign` is = or :=.
Statements write_modelica(const Function& function, const std::function<std::string(const ArgumentNumber&)>& name_of,
                          const std::string& behind_temporaries, const std::string& assign);

}  // namespace hysteron
