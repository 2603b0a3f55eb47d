// What `hysteron fit` works out: one parameter set over the recordings of a campaign, and the records of it.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "compare/criteria.hpp"
#include "core/message.hpp"
#include "fit/identify.hpp"
#include "fit/two_stage.hpp"
#include "respond/refine.hpp"
#include "task/excites.hpp"

namespace hysteron {

struct FitRequest {
  std::string model;         // empty: the campaign's
  IdentifyOptions identify;  // once objective.stopped says so, the fit ends with what it has
  bool two_stages = false;   // also the laws through the values of conditions fitted freely
  std::optional<Rig> rig;    // given: the recordings are of a mass on the damper; whether on a base is found out
  Excites excitation = Excites::what_is_recorded;  // of that mass
};

// A campaign that can be fitted as asked.
struct FitData {
  Campaign campaign;                 // of the damper alone
  std::vector<Recording> responses;  // the motion under the force on the mass, with a rig
  std::string model;
  std::vector<std::string> remarks;  // on what the responses were taken for
};
// Throws InputError for what cannot be fitted, before any work: unusable recordings, wrong names, laws that
// two stages need, a model that cannot respond or depends on a rate that is not recorded. Parameter laws that the
// request does not give are the campaign's, which it is given.
FitData fit_data(Campaign campaign, FitRequest& request);

struct FitResult {
  Identification identification;
  std::optional<TwoStage> two_stages = {};
  std::optional<ResponseFit> response = {};
  std::optional<ResidualFacts> residual = {};  // of the fitted recordings, of what was fitted: force or motion
  std::vector<Score> scores = {};              // of every recording
  std::vector<bool> held_out = {};             // likewise, in the check of the solvers or by its role
  bool interrupted = false;
  std::string diverged = {};               // recordings on which the fitted model does not stay finite; empty: none
  std::vector<std::string> warnings = {};  // `remarks` first
  Message drive_hint = "";                 // among the warnings in plain words; empty: none
  nlohmann::json model_file = {};          // model.json
  nlohmann::json fit_file = {};            // fit.json
  nlohmann::json page = {};                // for fit_report_html
};

// Told of every answer to a solver: the stage, what its cost is the NRMSE of (empty: the force), the run so far. False
// ends the stage.
using FitProgress = std::function<bool(const std::string& stage, const std::string& of, const RunResult& run)>;

// `remarks` of the recordings are warnings of the result, `command` is what it can be made again by. Throws InputError
// and WorkError as identify does.
FitResult fit_campaign(const FitData& data, const FitRequest& request, const std::vector<std::string>& remarks,
                       const std::string& command, const FitProgress& progress);

}  // namespace hysteron
