#include "export/names.hpp"

#include <algorithm>
#include <cctype>
#include <span>
#include <vector>

#include "core/error.hpp"
#include "core/joined.hpp"
#include "core/message.hpp"

namespace hysteron {
namespace {

// Keywords that begin with a letter; those of C23, C++20, Python 3.13 and Modelica 3.6, the last with its built-in
// types and variable.
constexpr std::string_view of_c[] = {
    "alignas",  "alignof", "auto",   "bool",          "break",  "case",          "char",    "const",    "constexpr",
    "continue", "default", "do",     "double",        "else",   "enum",          "extern",  "false",    "float",
    "for",      "goto",    "if",     "inline",        "int",    "long",          "nullptr", "register", "restrict",
    "return",   "short",   "signed", "sizeof",        "static", "static_assert", "struct",  "switch",   "thread_local",
    "true",     "typedef", "typeof", "typeof_unqual", "union",  "unsigned",      "void",    "volatile", "while"};
constexpr std::string_view of_cpp[] = {
    "alignas",     "alignof",   "and",        "and_eq",    "asm",      "auto",         "bitand",
    "bitor",       "bool",      "break",      "case",      "catch",    "char",         "char8_t",
    "char16_t",    "char32_t",  "class",      "compl",     "concept",  "const",        "consteval",
    "constexpr",   "constinit", "const_cast", "continue",  "co_await", "co_return",    "co_yield",
    "decltype",    "default",   "delete",     "do",        "double",   "dynamic_cast", "else",
    "enum",        "explicit",  "export",     "extern",    "false",    "float",        "for",
    "friend",      "goto",      "if",         "inline",    "int",      "long",         "mutable",
    "namespace",   "new",       "noexcept",   "not",       "not_eq",   "nullptr",      "operator",
    "or",          "or_eq",     "private",    "protected", "public",   "register",     "reinterpret_cast",
    "requires",    "return",    "short",      "signed",    "sizeof",   "static",       "static_assert",
    "static_cast", "struct",    "switch",     "template",  "this",     "thread_local", "throw",
    "true",        "try",       "typedef",    "typeid",    "typename", "union",        "unsigned",
    "using",       "virtual",   "void",       "volatile",  "wchar_t",  "while",        "xor",
    "xor_eq"};
constexpr std::string_view of_python[] = {"False",  "None",   "True",    "and",      "as",       "assert", "async",
                                          "await",  "break",  "class",   "continue", "def",      "del",    "elif",
                                          "else",   "except", "finally", "for",      "from",     "global", "if",
                                          "import", "in",     "is",      "lambda",   "nonlocal", "not",    "or",
                                          "pass",   "raise",  "return",  "try",      "while",    "with",   "yield"};
constexpr std::string_view of_modelica[] = {
    "Boolean",     "Clock",     "Integer",    "Real",      "String",   "algorithm", "and",          "annotation",
    "assert",      "block",     "break",      "class",     "connect",  "connector", "constant",     "constrainedby",
    "der",         "discrete",  "each",       "else",      "elseif",   "elsewhen",  "encapsulated", "end",
    "enumeration", "equation",  "expandable", "extends",   "external", "false",     "final",        "flow",
    "for",         "function",  "if",         "import",    "impure",   "in",        "initial",      "inner",
    "input",       "loop",      "model",      "not",       "operator", "or",        "outer",        "output",
    "package",     "parameter", "partial",    "protected", "public",   "pure",      "record",       "redeclare",
    "replaceable", "return",    "stream",     "then",      "time",     "true",      "type",         "when",
    "while",       "within"};
// A file of that name beside the code would be taken for what the code includes or imports.
constexpr std::string_view used_by_the_code[] = {"cg_sfun", "fmi2",  "fmu",    "math",   "simstruc", "simulink",
                                                 "stddef",  "stdio", "stdlib", "string", "sys",      "time"};

struct Words {
  std::string_view language;
  std::span<const std::string_view> words;
};
constexpr Words languages[] = {{"C", of_c}, {"C++", of_cpp}, {"Python", of_python}, {"Modelica", of_modelica}};

}  // namespace

std::string identifier(std::string_view text) {
  std::string result;
  for (const char letter : text) {
    result += std::isalnum(static_cast<unsigned char>(letter)) != 0 ? letter : '_';
  }
  // What begins with an underscore belongs to compilers.
  if (result.empty() || std::isalpha(static_cast<unsigned char>(result[0])) == 0) {
    result.insert(0, "m_");
  }
  return result;
}

void refuse_name(Option option, const std::string& name) {
  if (name != identifier(name)) {
    throw OptionError(option + ": '" + name +
                      "' is not an identifier, expected a letter, then letters, digits and underscores");
  }
  const Message instead =
      option == Option::name ? Message("expected another name") : "expected another file or " + Option::name + " NAME";
  std::vector<std::string_view> own;
  for (const Words& one : languages) {
    if (std::ranges::find(one.words, name) != one.words.end()) own.push_back(one.language);
  }
  if (!own.empty()) {
    throw OptionError(option + ": '" + name + "' is a word of " + joined(own, " and ") + ", " + instead);
  }
  if (std::ranges::find(used_by_the_code, name) != std::end(used_by_the_code)) {
    throw OptionError(option + ": '" + name + "' is a file or module that exported code uses, " + instead);
  }
}

}  // namespace hysteron
