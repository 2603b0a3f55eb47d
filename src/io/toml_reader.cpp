#include "io/toml_reader.hpp"

#include <algorithm>
#include <vector>

#include "core/error.hpp"
#include "core/suggest.hpp"
#include "io/text.hpp"

namespace hysteron {

void throw_toml_slip() { throw TomlSlip{}; }

void TomlReader::fail_at(int line, const std::string& message) const { throw InputError(file_, line, message); }

void TomlReader::fail(const toml::node& node, const std::string& message) const { fail_at(line_of(node), message); }

int TomlReader::line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

toml::table TomlReader::parse(const std::string& text, std::string_view schema) const {
  toml::table root;
  try {
    root = toml::parse(text);
  } catch (const TomlSlip&) {
    fail_at(0, "not valid TOML, expected TOML 1.0");
  } catch (const toml::parse_error& error) {
    std::string reason(error.description());
    std::ranges::replace(reason, '\n', ' ');
    fail_at(static_cast<int>(error.source().begin.line), "not valid TOML (" + reason + "), expected TOML 1.0");
  }
  const auto* stated = root.get("schema");
  if (stated == nullptr) fail_at(1, "no 'schema', expected schema = \"" + std::string(schema) + "\"");
  const std::string value = text_of(*stated, "schema");
  if (value != schema) fail(*stated, "unknown schema " + in_quotes(value) + ", expected " + in_quotes(schema));
  return root;
}

void TomlReader::check_keys(const toml::table& table, std::initializer_list<std::string_view> known,
                            const std::string& of) const {
  for (const auto& [key, node] : table) {
    if (std::ranges::find(known, key.str()) != known.end()) continue;
    std::vector<std::string> words;
    std::string expected;
    for (const auto name : known) {
      words.emplace_back(name);
      expected += (expected.empty() ? "" : ", ") + std::string(name);
    }
    fail_at(
        static_cast<int>(key.source().begin.line),
        "unknown key " + in_quotes(key.str()) + of + suggestion(key.str(), words) + ", expected one of " + expected);
  }
}

std::string TomlReader::text_of(const toml::node& node, const std::string& name) const {
  if (const auto* text = node.as_string()) return text->get();
  fail(node, "'" + name + "' is not text, expected a string in double quotes");
}

}  // namespace hysteron
