// Motion of a mass on a stored model: `hysteron respond`.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "respond/respond.hpp"
#include "respond/signal.hpp"
#include "task/excites.hpp"
#include "task/model_file.hpp"

namespace hysteron {

// The column of the model's own force in what `respond` writes, beside that of the force on the mass.
inline constexpr std::string_view damper_force = "damper force";

struct ResponseRequest {
  double mass = 1.0;       // kg
  double stiffness = 0.0;  // N/m, of a spring beside the model
  double damping = 0.0;    // N s/m, of a dashpot beside it
  Excites excitation = Excites::what_is_recorded;
  Interpolation interpolation = Interpolation::cubic;  // of the excitation between its samples
  int periods = 0;                                     // that the excitation is repeated for; 0: it is not
  double frequency = std::nan("");                     // Hz, for parameters that follow it; NaN: the dominant one
  double drive = std::nan("");                         // A or V; NaN: the recording's
  RespondOptions respond;
};

struct MassResponse {
  std::vector<std::string> names;            // with units, as in the table
  std::vector<std::vector<double>> columns;  // one a name, of one length
  double largest_displacement = 0.0;         // m, relative to the base
  double largest_force = 0.0;                // N, of the model
  bool base = false;                         // moved, in place of a force on the mass

  [[nodiscard]] std::string csv() const;  // as the command writes it: the names, then a row a sample
};

// `recording` holds time and a force on the mass or a base (or displacement); `path` is the model's in messages;
// `remarks` are of what the model is asked beyond what it was fitted on. Throws InputError where the excitation is
// missing or not the one asked for, and as require_response does, WorkError where the motion runs away or is stopped.
MassResponse response_to(StoredModel stored, const std::string& path, Recording recording,
                         const ResponseRequest& request, std::vector<std::string>& remarks);

}  // namespace hysteron
