// The ends of an interval as text: two numbers that are not one must not read as one.
#pragma once

#include <functional>
#include <string>
#include <utility>

namespace hysteron {

// `text(value, digits)` of both ends, with `fewest` digits, or as many more as tell them apart.
std::pair<std::string, std::string> interval_ends(double low, double high, int fewest,
                                                  const std::function<std::string(double value, int digits)>& text);

}  // namespace hysteron
