#pragma once

#include <pybind11/pybind11.h>

namespace hysteron::python {

// What is done with a model once it is identified.
void add_use(pybind11::module_& module);

}  // namespace hysteron::python
