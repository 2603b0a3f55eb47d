// Arguments of the package's functions, checked by Python's side, as the boxes take them.
#pragma once

#include <pybind11/pybind11.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "fit/objective.hpp"
#include "recordings.hpp"

namespace hysteron::python {

using WithRoles = std::vector<std::pair<RecordingPointer, std::string>>;

// By name, all of them given.
class Options {
 public:
  explicit Options(const pybind11::dict& values) : values_(values) {}
  template <class T>
  [[nodiscard]] T get(const char* name) const {
    return values_[name].cast<T>();
  }
  [[nodiscard]] bool given(const char* name) const { return !values_[name].is_none(); }

 private:
  const pybind11::dict& values_;
};

ObjectiveOptions objective_of(const Options& options);

// Contents of files by name.
pybind11::dict bytes_of(const std::map<std::string, std::string>& files);

}  // namespace hysteron::python
