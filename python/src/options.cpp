#include "options.hpp"

#include "fit/weighting.hpp"

namespace hysteron::python {

ObjectiveOptions objective_of(const Options& options) {
  ObjectiveOptions objective;
  objective.normalisation = normalisation_of(options.get<std::string>("normalisation"));
  objective.weighting = weighting_of(options.get<std::string>("weighting"));
  objective.tolerance = options.get<double>("tolerance");
  objective.threads = options.get<int>("threads");
  return objective;
}

pybind11::dict bytes_of(const std::map<std::string, std::string>& files) {
  pybind11::dict result;
  for (const auto& [name, content] : files) result[pybind11::str(name)] = pybind11::bytes(content);
  return result;
}

}  // namespace hysteron::python
