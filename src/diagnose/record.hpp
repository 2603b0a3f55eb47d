// diagnosis.json, as the public contract states it.
#pragma once

#include <nlohmann/json.hpp>

#include "diagnose/diagnose.hpp"

namespace hysteron {

nlohmann::json diagnosis_json(const Diagnosis& diagnosis);

}  // namespace hysteron
