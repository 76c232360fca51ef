// Contacts, energies and settings of simulations <-> Python, for the bindings that simulate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bind_scene.hpp"

#include "tumble/step/step_report.hpp"
#include "tumble/step/time_step.hpp"
#include "tumble/trajectory/trajectory.hpp"

namespace tumble::python {

// "exact" or "fast", and the sweeps of the latter. Raises ValueError.
StepSettings as_step_settings(const py::handle& solver, const py::handle& num_sweeps);

// A whole number in [low, high], from 1 on. Raise ValueError.
int as_whole_number(const py::handle& object, const char* field, int low, int high);
int as_positive_count(const py::handle& object, const char* field);

// A field of a struct of `size` bytes, for numpy.
struct Field {
  const char* name;
  const char* format;
  std::size_t offset;
};
py::dtype dtype_of(std::span<const Field> fields, std::size_t size);

// One row for each contact, in the order given; read-only.
py::array to_numpy(std::span<const StepContacts> steps, double step_size);

// Rows of eight named energies, in the memory of `owner` if there is one, which they keep alive; read-only.
py::array to_numpy(std::span<const EnergyLedger> rows, const py::handle& owner = {});

inline py::array read_only(py::array array) {
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

}  // namespace tumble::python
