// The compiled part of the Python package hysteron; the package's own files are what users call.
#include <pybind11/pybind11.h>

#include "arguments.hpp"
#include "core/error.hpp"
#include "core/message.hpp"
#include "recordings.hpp"
#include "use.hpp"
#include "work.hpp"

PYBIND11_MODULE(_hysteron, module) {
  namespace py = pybind11;
  module.doc() = "compiled part of the package hysteron";
  module.attr("version") = HYSTERON_VERSION;
  static const auto input_error = py::register_exception<hysteron::InputError>(module, "InputError", PyExc_ValueError);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const hysteron::OptionError& error) {
      PyErr_SetString(input_error.ptr(), error.message().with(hysteron::python::argument_name).c_str());
    } catch (const hysteron::InputError& error) {
      PyErr_SetString(input_error.ptr(), hysteron::python::with_arguments(error.what()).c_str());
    }
  });
  py::register_exception<hysteron::WorkError>(module, "WorkError", PyExc_RuntimeError);
  hysteron::python::add_recordings(module);
  hysteron::python::add_use(module);
  hysteron::python::add_work(module);
}
