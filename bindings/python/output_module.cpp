// The extension module tumble._output: trajectories into files. Apart from tumble._core, which must be imported before,
// as it needs cairo and other libraries, which not every machine has. Public face: Trajectory.save.
#include <filesystem>
#include <stdexcept>
#include <string>

#include <pybind11/pybind11.h>

#include "tumble/output/write.hpp"

namespace tumble::python {
namespace {

namespace py = pybind11;

// `path` in the bytes of the file system. Raises ValueError for what the caller can mend, OSError for what the machine
// refuses.
void save(const Trajectory& trajectory, const std::string& path, const std::string& format, int width, int height,
          double speed, bool has_contacts) {
  const output::WriteOptions options{true, format, width, height, speed};
  if (!has_contacts && output::contact_use(path, options) == output::ContactUse::all) {
    throw std::invalid_argument("contacts: were not kept; simulate with contacts=True");
  }
  std::string failure;
  {
    const py::gil_scoped_release without_gil;
    try {
      output::write_trajectory(trajectory, path, options);
    } catch (const std::runtime_error& error) {
      failure = error.what();
    }
  }
  if (failure.empty()) return;
  PyErr_SetString(PyExc_OSError, failure.c_str());
  throw py::error_already_set();
}

}  // namespace
}  // namespace tumble::python

PYBIND11_MODULE(_output, module) {
  using namespace pybind11::literals;
  module.doc() = "Compiled part of tumble; see tumble.Trajectory.save.";
  module.def("save", &tumble::python::save, "trajectory"_a, "path"_a, "format"_a, "width"_a, "height"_a, "speed"_a,
             "has_contacts"_a);
}
