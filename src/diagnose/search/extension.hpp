// What one hypothesis has more than another: a physical effect, or parameters whose law in the drive has more orders.
#pragma once

#include <string>
#include <vector>

namespace hysteron {

struct Extension {
  std::string effect;                   // empty for a richer law
  std::vector<std::string> parameters;  // of a richer law: one order more for each time a parameter is listed

  bool operator==(const Extension&) const = default;
  [[nodiscard]] bool is_law() const { return effect.empty(); }
};

inline Extension effect_extension(std::string id) { return {std::move(id), {}}; }
inline Extension law_extension(std::vector<std::string> parameters) { return {{}, std::move(parameters)}; }

// Whether the effect of this id shares its force with what is below and takes part of the motion; no id does not.
bool in_series(const std::string& effect);

// As printed and recorded: the effect's id, or "law:PARAMETER,...".
std::string name_of(const Extension& extension);

}  // namespace hysteron
