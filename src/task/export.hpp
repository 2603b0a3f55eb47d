// An identified model for use elsewhere: `hysteron export`.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/recording.hpp"
#include "export/exported.hpp"
#include "io/channels.hpp"
#include "task/model_file.hpp"

namespace hysteron {

struct ExportRequest {
  std::string to;    // c, fmu, simulink, modelica or python
  std::string out;   // folder, or the main file by its ending; empty or -: nowhere, paths are names alone
  std::string name;  // identifier in the code; empty: of the file or the law
  double tolerance = 1e-4;
  int most_substeps = default_most_substeps;
  int substeps = 0;  // always so many; 0: as many as the stiffness asks for
};

struct ModelExport {
  std::string folder;                        // that holds the files, empty: here
  std::map<std::string, std::string> files;  // by path below the folder
  std::string note;                          // how to use them, and what few steps cost in accuracy, in lines
};

// `motion` is what the test vector replays, of a recording; none: a motion of 10 mm and a drive about 0.5. `at` gives
// values of the conditions that laws follow, `path` is the model's in messages; `remarks` are of what the model is
// asked beyond what it was fitted on. Throws InputError for a wrong word or name, for what cannot be exported, for a
// motion with another drive than the model's, and where a file that hysteron did not write would be replaced, WorkError
// where there is no force to check a copy with.
ModelExport export_model(StoredModel stored, const std::string& path, const std::map<std::string, ConditionNumber>& at,
                         const std::optional<Recording>& motion, const ExportRequest& request,
                         std::vector<std::string>& remarks);

// Writes the files, making folders, and returns their paths in order.
std::vector<std::string> write_export(const ModelExport& model);

}  // namespace hysteron
