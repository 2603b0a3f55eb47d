// What `hysteron diagnose` works out beside the diagnosis itself: its records.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/recording.hpp"
#include "diagnose/diagnose.hpp"

namespace hysteron {

// Fills in what is not given from the campaign, the law bouc-wen at last. Throws InputError for what cannot be
// diagnosed, before any work: unusable recordings, wrong names.
void check_diagnosis(const Campaign& campaign, DiagnoseOptions& options);

struct DiagnosisRecords {
  nlohmann::json diagnosis_file;  // diagnosis.json
  nlohmann::json model_file;      // model.json, the augmented model
  nlohmann::json page;            // for fit_report_html
};
// `remarks` of the recordings are its warnings, `command` is what it can be made again by. `done` is told the share of
// the work that is done.
DiagnosisRecords records_of(const Diagnosis& diagnosis, const Campaign& campaign, const DiagnoseOptions& options,
                            const std::vector<std::string>& remarks, const std::string& command,
                            const std::function<void(double share)>& done = {});

}  // namespace hysteron
