// A recorded column that no model uses (a temperature, a pressure) and that the parameters of the damper law follow.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "diagnose/by_recording.hpp"

namespace hysteron {

struct ColumnTold {
  struct Change {
    std::string parameter;
    std::string meaning;  // "yield force"; may be empty
    std::string unit;     // of the change; empty: a share of the parameter
    double value = 0.0;   // from the least to the largest of the column
  };
  std::string name;  // as in the file, with its unit
  double low = 0.0;
  double high = 0.0;
  double together = 0.0;  // NRMSE to first order: parameters common to all recordings, and affine in the column
  double along = 0.0;
  double chance = 1.0;
  std::vector<Change> changes;  // what takes off most comes first
};
// `base` is of the damper law alone on all recordings of the bench. Nothing where the parameters follow no such column.
std::optional<ColumnTold> unused_column(const Workbench& bench, const ByRecording& base);
std::string sentence_of(const ColumnTold& column);
nlohmann::json column_json(const ColumnTold& column);

}  // namespace hysteron
