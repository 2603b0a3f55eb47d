// What a model is asked that it was not fitted to tell.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "task/model_file.hpp"

namespace hysteron {

// A remark where parameters of a model file state no unit. `path` is the model's, as below.
std::vector<std::string> units_assumed(const StoredModel& stored, const std::string& path);

// A remark where recordings lack the drive that the laws of a model follow, which counts as zero.
std::vector<std::string> drive_assumed(const StoredModel& stored, const std::string& path,
                                       const std::vector<Recording>& recordings);

// These, those of impossible_laws, and remarks where drive, frequency or conditions (follow_conditions) lie beyond what
// the laws were fitted over by more than a tenth of that: a polynomial says nothing there. One line each for all
// recordings, of the one that is farthest out.
std::vector<std::string> guesses_of(const StoredModel& stored, const std::string& path,
                                    const std::vector<Recording>& recordings);

// Remarks where displacement, velocity or a drive that no law follows lie as far beyond those that the model was fitted
// on. The displacement is the damper's own: of a response, what was worked out.
std::vector<std::string> beyond_fitted(const StoredModel& stored, const std::string& path,
                                       const std::vector<Recording>& recordings);

// The same of laws and motion where a model file comes from a fit that held some of these recordings out.
std::vector<std::string> held_out_beyond_fitted(const nlohmann::json& model_file,
                                                const std::vector<Recording>& recordings,
                                                const std::vector<std::size_t>& held_out);

// Remarks where conditions are held (hold_conditions) at values as far beyond those that the laws were fitted over.
std::vector<std::string> held_beyond_fitted(const StoredModel& stored, const std::string& path,
                                            const std::map<std::string, ConditionNumber>& at);

// Of a model identified from the motion of a mass: InputError for a recording that it was identified from, whose force
// excites the mass; a remark for any other, whose force has to be the damper's own.
void refuse_excitation(const StoredModel& stored, const std::string& path, const std::vector<Recording>& recordings,
                       std::vector<std::string>& remarks);

}  // namespace hysteron
