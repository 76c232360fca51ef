// Work that other Python threads need not wait for.
#pragma once

#include <stdexcept>
#include <string>

#include <pybind11/pybind11.h>

namespace tumble::python {

// Calls work(), which must not touch Python. Raises ValueError for what the caller can mend (std::invalid_argument),
// OSError for what the machine refuses (std::runtime_error).
template <class Work>
void without_gil(Work work) {
  std::string failure;
  {
    const pybind11::gil_scoped_release released;
    try {
      work();
    } catch (const std::runtime_error& error) {
      failure = error.what();
    }
  }
  if (failure.empty()) return;
  PyErr_SetString(PyExc_OSError, failure.c_str());
  throw pybind11::error_already_set();
}

}  // namespace tumble::python
