// Datasets that ship with the program: simulated ones, small and deterministic, and recordings of measured dampers in
// folders of their own (datasets/ID), which stand beside the program (support/shipped.hpp).
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
  // The recordings; those of a measured device are the same for every stream. Throws InputError where these are missing
  // or altered.
  Campaign (*generate)(const Stream& stream) = nullptr;
  // Of a measured device, empty for a simulated one; the text of the licence is a file of the folder.
  std::string_view licence = {};
  // The force is that on a mass on the damper, not the damper's: for `fit --response`, not for a study.
  bool response = false;
};

std::span<const DatasetEntry* const> dataset_catalogue();
// nullptr when there is none.
const DatasetEntry* find_dataset(std::string_view id);

}  // namespace hysteron
