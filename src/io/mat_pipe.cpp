#include "io/mat_pipe.hpp"

#include <cstdint>
#include <cstring>
#include <utility>

namespace hysteron {
namespace {

class Writer {
 public:
  explicit Writer(std::string& bytes) : bytes_(bytes) {}

  template <class T>
  void number(T value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void text(std::string_view value) {
    number(value.size());
    bytes_ += value;
  }
  void variable(const MatVariable& v) {
    text(v.name);
    number(v.kind);
    number(v.complex);
    number(v.damaged);
    number(v.rows);
    number(v.columns);
    number(v.values.size());
    bytes_.append(reinterpret_cast<const char*>(v.values.data()), v.values.size() * sizeof(double));
    text(v.text);
    number(v.fields.size());
    for (const auto& [name, value] : v.fields) {
      text(name);
      number(value.has_value());
      text(value.value_or(""));
    }
  }

 private:
  std::string& bytes_;
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  [[nodiscard]] bool at_end() const { return bytes_.empty(); }
  template <class T>
  T number() {
    T value{};
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  bool flag() { return number<unsigned char>() != 0; }
  std::string text() { return std::string(take(number<std::size_t>())); }
  MatVariable variable() {
    MatVariable v;
    v.name = text();
    const auto kind = number<std::uint8_t>();
    if (kind > static_cast<std::uint8_t>(MatVariable::Kind::other)) wrong();
    v.kind = static_cast<MatVariable::Kind>(kind);
    v.complex = flag();
    v.damaged = flag();
    v.rows = number<std::size_t>();
    v.columns = number<std::size_t>();
    const auto count = number<std::size_t>();
    if (count > bytes_.size() / sizeof(double)) wrong();
    if (v.columns != 0 && (count % v.columns != 0 || count / v.columns != v.rows)) wrong();
    if (v.columns == 0 && count != 0) wrong();
    v.values.resize(count);
    if (count > 0) std::memcpy(v.values.data(), take(count * sizeof(double)).data(), count * sizeof(double));
    v.text = text();
    const auto fields = number<std::size_t>();
    for (std::size_t i = 0; i < fields; ++i) {
      MatVariable::Field field{text(), {}};
      const bool there = flag();
      std::string value = text();
      if (there) field.second = std::move(value);
      v.fields.push_back(std::move(field));
    }
    return v;
  }

 private:
  [[noreturn]] static void wrong() { throw MatDamage("the file cannot be read, it is damaged"); }
  std::string_view take(std::size_t count) {
    if (count > bytes_.size()) wrong();
    const std::string_view result = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return result;
  }
  std::string_view bytes_;
};

}  // namespace

void append_piped(std::string& bytes, const MatVariable& variable) { Writer(bytes).variable(variable); }

std::vector<MatVariable> read_piped(std::string_view bytes) {
  std::vector<MatVariable> variables;
  for (Reader reader(bytes); !reader.at_end();) variables.push_back(reader.variable());
  return variables;
}

}  // namespace hysteron
