// The stages of a challenge over a folder. Every stage keeps what an earlier call finished.
//   OUT/settings.json, OUT/campaign-NNNN/...      the concealed campaigns
//   OUT/answers.sealed, OUT/seal.sha256           before any diagnosis
//   OUT/diagnoses/campaign-NNNN/diagnosis.json    what the diagnosis wrote
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "challenge/levels.hpp"

namespace hysteron::challenge {

// Diagnoses the recordings of a folder into another one and leaves diagnosis.json there; what it throws is kept as the
// reason of a failed diagnosis.
using Diagnose = std::function<void(const std::filesystem::path& data, const std::filesystem::path& out)>;

struct Steps {
  int jobs = 1;
  std::function<bool()> interrupted = [] { return false; };
  std::function<void(const std::string& stage, double share, const std::string& detail)> progress =
      [](const std::string&, double, const std::string&) {};
};

// Makes and seals; returns the hash. With the same settings as an earlier call nothing is made again; with others it
// is an InputError. WorkError when interrupted.
std::string make_all(const std::filesystem::path& out, const std::vector<Task>& tasks, std::uint64_t seed,
                     const Steps& steps);

// Diagnoses every campaign that has no diagnosis.json yet; returns how many failed.
int diagnose_all(const std::filesystem::path& out, const Diagnose& diagnose, const Steps& steps);

// Whether a campaign's diagnosis, in its folder, was done or failed.
[[nodiscard]] bool was_reached(const std::filesystem::path& diagnosis);

// Opens the seal, holding it against `hash` (empty: the one of seal.sha256), and scores what was diagnosed or failed:
// challenge.json's content, with "not_diagnosed" counting the rest. With a choice only campaigns that hold one of its
// forms or foreign causes, and none of those left out.
[[nodiscard]] nlohmann::json score_all(const std::filesystem::path& out, const std::string& hash,
                                       const FormChoice& choice = {});

}  // namespace hysteron::challenge
