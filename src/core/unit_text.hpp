// Units as people write them. Stored units of a parameter law are those of its parameter over the drive's, "N/A", which
// reads as "not available".
#pragma once

#include <string>
#include <string_view>

#include "core/recording.hpp"

namespace hysteron {

// As stored, of the term of a parameter that is multiplied by these powers of drive and frequency: "N/m", "N/m/A/A/Hz".
std::string term_unit(std::string_view unit, int drive_power, int frequency_power, DriveKind drive);

// As stored, of a term multiplied by a power of something in the unit `by`: "N/Pa/Pa", "N/(m/s)"; without a unit of
// that, as it was.
std::string unit_over(std::string_view unit, std::string_view by, int power);

// "N/A" -> "N A^-1", "N s/m/Pa/Pa" -> "N s m^-1 Pa^-2", as the pages have it; a unit divided once and not by a drive,
// and one with a power that is no whole number, as it is.
std::string unit_text(const std::string& unit);

// What stands behind "per" for a power of a condition: "°C", "Pa^2", "(l/min)^2"; without a unit "unit of valve".
std::string per_text(std::string_view unit, std::string_view condition, int power);

}  // namespace hysteron
