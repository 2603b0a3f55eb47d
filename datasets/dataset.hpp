// Datasets that ship with the program: simulated, small, deterministic.
#pragma once

#include <span>
#include <string_view>

#include "core/random.hpp"
#include "core/recording.hpp"

namespace hysteron {

struct DatasetEntry {
  std::string_view id;
  std::string_view title;
  std::string_view reference;
  std::string_view description;  // what, units, truth, noise
  Campaign (*generate)(const Stream& stream) = nullptr;
};

std::span<const DatasetEntry* const> dataset_catalogue();
const DatasetEntry* find_dataset(std::string_view id);

}  // namespace hysteron
