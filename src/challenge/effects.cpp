#include "challenge/effects.hpp"

#include "challenge/effect_list.hpp"
#include "core/error.hpp"
#include "core/suggest.hpp"

namespace hysteron::challenge {
namespace {

const Effects& list() {
  static const Effects effects = [] {
    Effects all;
    add_parallel(all);
    add_fluid(all);
    add_slow(all);
    add_series(all);
    add_electric(all);
    add_chain(all);
    add_foreign(all);
    return all;
  }();
  return effects;
}

}  // namespace

std::span<const HiddenEffect> hidden_effects() { return list(); }

const HiddenEffect& hidden_effect(std::string_view id) {
  for (const HiddenEffect& effect : list()) {
    if (effect.id == id) return effect;
  }
  std::vector<std::string> known;
  for (const HiddenEffect& effect : list()) known.emplace_back(effect.id);
  throw InputError("unknown effect '" + std::string(id) + "'" + suggestion(id, known) +
                   ", expected one that the challenge lists");
}

FormOf hidden_form(std::string_view id) {
  for (const HiddenEffect& effect : list()) {
    for (const HiddenForm& form : effect.forms) {
      if (form.id == id) return {&effect, &form};
    }
  }
  std::vector<std::string> known;
  for (const HiddenEffect& effect : list()) {
    for (const HiddenForm& form : effect.forms) known.emplace_back(form.id);
  }
  throw InputError("unknown form '" + std::string(id) + "'" + suggestion(id, known) +
                   ", expected one that the challenge lists");
}

}  // namespace hysteron::challenge
