#include "diagnose/search/hypothesis.hpp"

#include <algorithm>
#include <iterator>

#include "simulate/part.hpp"

namespace hysteron {

bool in_series(const std::string& effect) {
  const Part* part = find_effect(effect);
  return part != nullptr && part->in_series();
}

std::string name_of(const Extension& extension) {
  if (!extension.is_law()) {
    return extension.effect;
  }
  std::string text;
  for (const std::string& parameter : extension.parameters) {
    text += (text.empty() ? "law:" : ",") + parameter;
  }
  return text;
}

Hypothesis with(const Hypothesis& what, const Extension& extension) {
  Hypothesis result = what;
  if (extension.is_law()) {
    std::ranges::copy(extension.parameters, std::back_inserter(result.richer));
  } else {
    result.effects.push_back(extension.effect);
  }
  return result;
}

Hypothesis without(const Hypothesis& what, const Extension& extension) {
  Hypothesis result = what;
  if (!extension.is_law()) {
    std::erase(result.effects, extension.effect);
    // A parameter that goes takes its law along.
    std::erase_if(result.richer, [&](const std::string& name) { return name.starts_with(extension.effect + "."); });
  }
  for (const std::string& parameter : extension.parameters) {
    const auto found = std::ranges::find(result.richer, parameter);
    if (found != result.richer.end()) {
      result.richer.erase(found);
    }
  }
  return result;
}

bool contains(const Hypothesis& what, const Extension& extension) {
  if (!extension.is_law()) {
    return std::ranges::find(what.effects, extension.effect) != what.effects.end();
  }
  return std::ranges::all_of(extension.parameters, [&](const std::string& parameter) {
    return std::ranges::find(what.richer, parameter) != what.richer.end();
  });
}

bool same_parts(const Hypothesis& a, const Hypothesis& b) {
  return a.model == b.model && std::ranges::is_permutation(a.effects, b.effects) &&
         std::ranges::is_permutation(a.richer, b.richer);
}

std::vector<Extension> extensions_of(const Hypothesis& what) {
  std::vector<Extension> parts;
  for (const std::string& effect : what.effects) {
    parts.push_back(effect_extension(effect));
  }
  std::vector<std::string> seen;
  for (const std::string& name : what.richer) {
    if (std::ranges::find(seen, name) == seen.end()) {
      seen.push_back(name);
      parts.push_back(law_extension(
          std::vector<std::string>(static_cast<std::size_t>(std::ranges::count(what.richer, name)), name)));
    }
  }
  return parts;
}

}  // namespace hysteron
