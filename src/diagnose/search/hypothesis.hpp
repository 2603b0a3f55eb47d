// A damper law with its extensions, and what may join it.
#pragma once

#include <string>
#include <vector>

#include "diagnose/search/extension.hpp"

namespace hysteron {

struct Hypothesis {
  std::string model;
  std::vector<std::string> effects;
  std::vector<std::string> richer;  // parameters of the model whose polynomial in the drive has one more order

  bool operator==(const Hypothesis&) const = default;
};

Hypothesis with(const Hypothesis& what, const Extension& extension);
Hypothesis without(const Hypothesis& what, const Extension& extension);
bool contains(const Hypothesis& what, const Extension& extension);
// The same parts, whatever their order of discovery.
bool same_parts(const Hypothesis& a, const Hypothesis& b);
// Effects, and richer laws each once with all their orders.
std::vector<Extension> extensions_of(const Hypothesis& what);

}  // namespace hysteron
