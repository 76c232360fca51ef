// The extension module tumble._output: trajectories into files. Apart from tumble._core, which must be imported before,
// as it needs cairo and other libraries, which not every machine has. Public face: save of Trajectory and of
// drop.Record.
#include <filesystem>
#include <stdexcept>
#include <string>

#include "without_gil.hpp"
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "tumble/output/field.hpp"
#include "tumble/output/npz.hpp"
#include "tumble/output/trajectory_fields.hpp"
#include "tumble/output/write.hpp"

namespace tumble::python {
namespace {

namespace py = pybind11;

// Paths are in the bytes of the file system; `page` is needed for an .html alone.
output::WriteOptions as_options(const std::string& format, int width, int height, double speed,
                                const std::string& page) {
  return {true, format, width, height, speed, page};
}

void save(const Trajectory& trajectory, bool has_contacts, const std::string& path, const std::string& format,
          int width, int height, double speed, const std::string& page) {
  const output::WriteOptions options = as_options(format, width, height, speed, page);
  if (!has_contacts && output::contact_use(path, options) == output::ContactUse::all) {
    throw std::invalid_argument("contacts: were not kept; simulate with contacts=True");
  }
  without_gil([&] { output::write_trajectory(trajectory, path, options); });
}

void save_record(const std::string& npz, const std::string& path, const std::string& format, int width, int height,
                 double speed, const std::string& page) {
  const output::WriteOptions options = as_options(format, width, height, speed, page);
  without_gil([&] { output::write_record(output::parse_record_npz(npz, "record"), path, options); });
}

}  // namespace
}  // namespace tumble::python

PYBIND11_MODULE(_output, module) {
  using namespace pybind11::literals;
  using namespace tumble;
  module.doc() = "Compiled part of tumble; see save of tumble.Trajectory and of tumble.drop.Record.";
  module.attr("mode_names") = output::names_of_codes<ContactMode>(static_cast<int>(output::k_contact_modes.size()));
  module.attr("status_names") = output::names_of_codes<LcpStatus>(static_cast<int>(k_lcp_statuses.size()));
  module.def("save", &python::save, "trajectory"_a, "has_contacts"_a, "path"_a, "format"_a, "width"_a, "height"_a,
             "speed"_a, "page"_a);
  module.def("save_record", &python::save_record, "npz"_a, "path"_a, "format"_a, "width"_a, "height"_a, "speed"_a,
             "page"_a);
}
