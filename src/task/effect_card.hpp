// What is known of an effect (simulate/knowledge.hpp), for `list` and `describe`.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace hysteron {

// {"family": {"id", "title"}, "shows", "acts", "needs": [..], "related": [{"id", "how"}, ..], "experiment",
// "rig_cause"}; null where the card of an effect does not say it.
nlohmann::json effect_card_json(const std::string& effect);

// The same in lines that begin with what they say; empty for an effect of which nothing is known.
std::string effect_card_text(const std::string& effect);

}  // namespace hysteron
