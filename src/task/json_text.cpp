#include "task/json_text.hpp"

namespace hysteron {

std::string json_text(const nlohmann::json& value) {
  // Names are made UTF-8 where they come in; a finished result is not lost for one that was forgotten.
  return value.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace hysteron
