// XML of strangers, read in pieces with bounds: no document type, so no entities of its own, no nesting deeper than 64,
// nothing between two marks longer than 1 MiB.
#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hysteron {

// What is wrong with the text, without the name of its file.
class XmlDamage : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Name and value, names as written, "r:id".
using XmlAttributes = std::vector<std::pair<std::string_view, std::string_view>>;

// The value of an attribute, empty where it is not there. A prefix of the file's own, as in "r:id", is named "*:id".
[[nodiscard]] std::string_view attribute(const XmlAttributes& attributes, std::string_view name);

// What is told of a text as it is read. Names of elements come without a prefix. What they throw ends the reading.
struct XmlEvents {
  std::function<void(std::string_view name, const XmlAttributes& attributes)> begin;
  std::function<void(std::string_view name)> end;
  std::function<void(std::string_view text)> text;  // in pieces
};

class XmlReader {
 public:
  explicit XmlReader(XmlEvents events);
  ~XmlReader();
  XmlReader(const XmlReader&) = delete;
  XmlReader& operator=(const XmlReader&) = delete;
  // The next piece of the text. Throws XmlDamage and what an event throws.
  void add(std::string_view piece);
  // That the text is complete.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace hysteron
