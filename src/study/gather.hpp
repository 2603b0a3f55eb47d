// Stores beside a study's own: a study under mpirun has one in DIR/rank-K for every rank but the first, which writes to
// DIR itself. They are taken in when the study ends, and by the next call where it was killed.
#pragma once

#include <filesystem>
#include <vector>

#include "study/store.hpp"

namespace hysteron {

[[nodiscard]] std::filesystem::path rank_folder(const std::filesystem::path& folder, int rank);
// Those that are there, by rank.
[[nodiscard]] std::vector<std::filesystem::path> rank_folders(const std::filesystem::path& folder);

// Moves the runs of all rank folders into the study's store and removes the folders; says how many runs. A run that
// both hold with different results is an InputError, and so is a damaged store; nothing is removed then. Killed at any
// instant, every run is in one of the two or in both.
std::size_t absorb_ranks(Store& store, const std::filesystem::path& folder);

// The study's store as it would be after absorbing, for reading: a copy in memory where there are rank folders.
[[nodiscard]] Store open_gathered(const std::filesystem::path& folder);

}  // namespace hysteron
