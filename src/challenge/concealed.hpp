// A campaign whose truth is concealed: device, law, excitation, effects and their sizes, noise, all drawn from a seed.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "challenge/absorption.hpp"
#include "challenge/chain.hpp"
#include "challenge/effects.hpp"
#include "challenge/levels.hpp"

namespace hysteron::challenge {

struct HiddenTruth {
  std::string id;
  std::string form;    // "effect/form"; of a foreign cause its id
  double share = 0.0;  // RMS of the change of force in the recording it changes most, over the campaign's peak
  double strength = 0.0;
  std::vector<TrueParameter> parameters;
  // What a re-fit of the law's parameters cannot take up, to first order, as NRMSE: over all recordings together, and
  // recording by recording. detectability: its energy over the variance of the noise (per independent sample).
  double change_nrmse = 0.0;
  double left_nrmse = 0.0;
  double left_nrmse_single = 0.0;
  double detectability = 0.0;
  double power_over_strongest = 1.0;  // change_nrmse^2 over that of the strongest effect of the catalogue
  bool excited = true;
};

struct Concealed {
  std::string name;  // campaign-0001
  Task task;
  Design design = Design::sines;
  Physics physics;
  std::string told_model;  // as in campaign.toml
  std::vector<std::string> told_by_current;
  std::vector<std::string> acceptable;  // names that are no mistake beside the true ones
  std::vector<HiddenTruth> truths;
  Forces left;                // change of force by all truths that a re-fit of the law does not take up, N
  std::vector<double> peaks;  // of the recordings' forces without the truths, N
  Excitation excitation;
  Chain chain;
  std::string disturbance;  // of a negative control
  std::vector<Measured> recordings;
  Range range;
  int decimation = 8;
  bool roles_given = true;
  bool drive_is_voltage = false;
  bool drive_given = true;
  bool velocity_given = false;
};

[[nodiscard]] Concealed make_concealed(const Task& task, std::uint64_t seed);

// Writes the recordings and campaign.toml into the folder; nothing in it tells the answer.
void write_recordings(const Concealed& concealed, const std::string& folder, std::uint64_t seed);

// The answer: everything that was drawn, and the noise floor of each recording.
[[nodiscard]] nlohmann::json answer_of(const Concealed& concealed);

}  // namespace hysteron::challenge
