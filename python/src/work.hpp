#pragma once

#include <pybind11/pybind11.h>

namespace hysteron::python {

void add_work(pybind11::module_& module);

}  // namespace hysteron::python
