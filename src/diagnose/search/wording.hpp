// What the cards of effects say, in the words of the recordings at hand.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/joined.hpp"
#include "core/recording.hpp"

namespace hysteron {

// A text of a card (simulate/knowledge.hpp) for recordings with such a drive: of "[with|without]" the one or the other,
// a voltage in the place of a current.
std::string worded(std::string_view text, DriveKind drive);

// That of the first recording that has a drive.
DriveKind drive_kind_of(const std::vector<Recording>& recordings);

// An effect as it stands in a sentence; its id where nothing is known of it.
std::string title_of(std::string_view effect);

// "7 %"; what is less than all is never "100 %" but "over 99 %".
std::string percent(double share);

// A size in the unit that its number is short in, with its significant digits: "0.40 mm", "12 kN/m". A dimensionless
// one is the number alone.
std::string size_text(double value, const std::string& unit, int digits);

}  // namespace hysteron
