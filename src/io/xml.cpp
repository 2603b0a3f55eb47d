#include "io/xml.hpp"

#include <expat.h>

#include <exception>
#include <new>

namespace hysteron {
namespace {

constexpr int deepest = 64;
constexpr std::size_t longest_mark = std::size_t{1} << 20U;

std::string_view without_prefix(std::string_view name) {
  const auto colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

}  // namespace

struct XmlReader::State {
  XmlEvents events;
  XML_Parser parser = nullptr;
  std::exception_ptr failure;
  XmlAttributes attributes;
  int depth = 0;
  std::size_t fed = 0;

  // Nothing is thrown through the library, which is C.
  template <class Work>
  void guarded(const Work& work) noexcept {
    if (failure) return;
    try {
      work();
    } catch (...) {
      failure = std::current_exception();
      XML_StopParser(parser, XML_FALSE);
    }
  }

  static State& of(void* data) { return *static_cast<State*>(data); }

  static void on_begin(void* data, const XML_Char* name, const XML_Char** pairs) {
    State& state = of(data);
    state.guarded([&] {
      if (++state.depth > deepest) throw XmlDamage("elements nested deeper than 64");
      state.attributes.clear();
      for (; *pairs != nullptr; pairs += 2) state.attributes.emplace_back(pairs[0], pairs[1]);
      if (state.events.begin) state.events.begin(without_prefix(name), state.attributes);
    });
  }
  static void on_end(void* data, const XML_Char* name) {
    State& state = of(data);
    state.guarded([&] {
      --state.depth;
      if (state.events.end) state.events.end(without_prefix(name));
    });
  }
  static void on_text(void* data, const XML_Char* text, int count) {
    State& state = of(data);
    state.guarded([&] {
      if (state.events.text) state.events.text({text, static_cast<std::size_t>(count)});
    });
  }
  static void on_doctype(void* data, const XML_Char* /*name*/, const XML_Char* /*system*/, const XML_Char* /*open*/,
                         int /*internal*/) {
    of(data).guarded([] { throw XmlDamage("a document type"); });
  }

  void parse(std::string_view piece, bool last) {
    const XML_Status status = XML_Parse(parser, piece.data(), static_cast<int>(piece.size()), last ? 1 : 0);
    if (failure) std::rethrow_exception(failure);
    if (status != XML_STATUS_OK) {
      const XML_Error error = XML_GetErrorCode(parser);
      if (error == XML_ERROR_NO_MEMORY) throw std::bad_alloc();
      throw XmlDamage(std::string(XML_ErrorString(error)) + " in line " +
                      std::to_string(XML_GetCurrentLineNumber(parser)));
    }
    fed += piece.size();
    const XML_Index at = XML_GetCurrentByteIndex(parser);
    if (!last && at >= 0 && fed - static_cast<std::size_t>(at) > longest_mark) {
      throw XmlDamage("a mark of more than 1 MiB");
    }
  }
};

std::string_view attribute(const XmlAttributes& attributes, std::string_view name) {
  const bool any_prefix = name.starts_with("*:");
  for (const auto& [own, value] : attributes) {
    if (any_prefix ? own.find(':') != std::string_view::npos && without_prefix(own) == name.substr(2) : own == name) {
      return value;
    }
  }
  return {};
}

XmlReader::XmlReader(XmlEvents events) : state_(std::make_unique<State>()) {
  state_->events = std::move(events);
  state_->parser = XML_ParserCreate(nullptr);
  if (state_->parser == nullptr) throw std::bad_alloc();
  // One key for the library's hash tables, so that reading is the same each time.
  XML_SetHashSalt(state_->parser, 0x68797374);
  XML_SetUserData(state_->parser, state_.get());
  XML_SetElementHandler(state_->parser, State::on_begin, State::on_end);
  XML_SetCharacterDataHandler(state_->parser, State::on_text);
  XML_SetStartDoctypeDeclHandler(state_->parser, State::on_doctype);
}

XmlReader::~XmlReader() { XML_ParserFree(state_->parser); }

void XmlReader::add(std::string_view piece) {
  constexpr std::size_t at_once = std::size_t{1} << 16U;
  for (; !piece.empty(); piece.remove_prefix(std::min(at_once, piece.size()))) {
    state_->parse(piece.substr(0, at_once), false);
  }
}

void XmlReader::finish() { state_->parse({}, true); }

}  // namespace hysteron
