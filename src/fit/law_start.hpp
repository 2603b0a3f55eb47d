// Where a fit with effects begins: at what the law reaches without them. Random starts of a model with effects mostly
// end in optima of their own, and a fit with an effect would be worse than one without it.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "fit/identify.hpp"

namespace hysteron {

struct LawStart {
  std::vector<double> point;    // unit coordinates of the layout with the effects, these at their initial values
  std::size_t evaluations = 0;  // spent on the law
};

// A descent of the law from many starts with at most a quarter of the budget. Without effects, with no parameter of the
// law searched, or where its simulation never stays finite: the initial values of `layout`, and nothing spent.
LawStart start_at_law(const Layout& layout, const std::string& model, const DataScale& scale,
                      const std::vector<const Recording*>& recordings, const IdentifyOptions& options,
                      const std::function<bool(const RunResult&)>& observe);

}  // namespace hysteron
