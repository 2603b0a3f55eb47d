// Units of columns, "NAME [UNIT]", and the stored units of parameters.
#include "io/units.hpp"

#include <algorithm>
#include <cmath>

#include "core/unit_text.hpp"
#include "io/channels.hpp"
#include "io/text.hpp"
#include "target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace hysteron;
  const std::string text(fuzz::text_of(data, size));
  for (int k = 0; k < quantity_count; ++k) {
    const auto quantity = static_cast<Quantity>(k);
    const auto unit = find_unit(quantity, text);
    const bool parsed = fuzz::taken([&] { static_cast<void>(parse_unit(quantity, text, "input.csv", 1)); });
    fuzz::require(parsed == unit.has_value(), "both ways to look for a unit find the same");
    if (!unit) continue;
    fuzz::require(std::isfinite(unit->factor) && unit->factor > 0.0, "a unit is a positive factor");
    fuzz::require(std::fabs(unit->from_si(unit->to_si(1.0)) - 1.0) < 1e-12, "there and back is where it began");
    for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
      if (text.find(open) != std::string::npos) continue;
      const Column column = split_column("name " + (open + text) + close);
      fuzz::require(column.name == "name" && column.unit == trimmed(text), "a column is split into name and unit");
    }
  }
  const std::string shown = unit_text(text);
  fuzz::require(shown.size() <= 4 * text.size() + 8, "the text of a unit is not much longer than the unit");
  fuzz::require(unit_text("N s/m" + text + "/A").ends_with("A^-1") || text.find_first_of("/^)") != std::string::npos,
                "a law in the current is by its powers");
  return 0;
}
