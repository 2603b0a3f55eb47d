// What readers of TOML files with a schema share: every complaint is an InputError with the file and the line.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

#include "io/toml.hpp"

namespace hysteron {

class TomlReader {
 public:
  // The path as the user gave it: it opens every message.
  explicit TomlReader(const std::filesystem::path& path) : file_(path.string()) {}

  [[nodiscard]] const std::string& file() const { return file_; }

  // The table of a text whose key `schema` must read exactly so.
  [[nodiscard]] toml::table parse(const std::string& text, std::string_view schema) const;

  [[noreturn]] void fail_at(int line, const std::string& message) const;
  [[noreturn]] void fail(const toml::node& node, const std::string& message) const;
  [[nodiscard]] static int line_of(const toml::node& node);

  // Refuses keys other than `known`; `of` says of what in the message, such as " of a model", or nothing.
  void check_keys(const toml::table& table, std::initializer_list<std::string_view> known, const std::string& of) const;

  // The value of a node, `name` being its key in the message. Empty text is text.
  [[nodiscard]] std::string text_of(const toml::node& node, const std::string& name) const;

 private:
  std::string file_;
};

}  // namespace hysteron
