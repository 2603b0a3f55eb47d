// The sealed answers: a file whose hash is published before any diagnosis and checked before the answers are read.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace hysteron::challenge {

// Writes answers.sealed and seal.sha256 into the folder; returns the hash, 64 hexadecimal digits.
std::string seal(const nlohmann::json& answers, const std::filesystem::path& folder);

// The answers; an InputError when a file is missing or the hash is not that of the answers. `published`: a hash to
// hold against, empty for the one in seal.sha256.
[[nodiscard]] nlohmann::json open_seal(const std::filesystem::path& folder, const std::string& published = {});

}  // namespace hysteron::challenge
