// Published parameter sets: what a source prints, in its own symbols and units, and how it becomes parameters of a
// model.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hysteron {

// A printed quantity as a function of the drive (A or V) and the frequency (Hz).
struct PresetQuantity {
  std::string_view name;     // as in the source, letters spelt out
  std::string_view unit;     // in which `at` answers
  std::string_view printed;  // number or formula as printed; empty: the source does not print it
  double (*at)(double drive, double frequency) = nullptr;  // nullptr: not printed, the user must say
};

enum class PresetDrive { none, current, voltage };

// The file presets/NAME_WITH_UNDERSCORES.cpp defines `extern const Preset preset_NAME...`.
struct Preset {
  std::string_view id;
  std::string_view title;
  std::string_view reference;
  std::string_view model;
  std::span<const std::string_view> effects;
  PresetDrive drive = PresetDrive::none;
  double drive_low = 0.0;  // range of the source's experiments
  double drive_high = 0.0;
  bool by_frequency = false;
  double lag = 0.0;       // s, first-order lag of the drive; 0: none
  std::string_view note;  // doubts about print and units, and what was done about them
  std::span<const PresetQuantity> quantities;
  // Model parameters, then those of the effects, in the order of the cards; SI units.
  std::vector<double> (*parameters)(std::span<const double> quantities) = nullptr;
};

std::span<const Preset* const> preset_catalogue();
// nullptr when there is none.
const Preset* find_preset(std::string_view id);

// Exact response of u' = (drive - u) / lag to a drive linear between the samples, settled at the start.
std::vector<double> lagged(const std::vector<double>& time, const std::vector<double>& drive, double lag);

}  // namespace hysteron
