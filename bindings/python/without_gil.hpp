// Work that other Python threads need not wait for.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include <pybind11/pybind11.h>

namespace tumble::python {

[[noreturn]] inline void raise_os_error(const std::string& text) {
  PyErr_SetString(PyExc_OSError, text.c_str());
  throw pybind11::error_already_set();
}

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
  if (!failure.empty()) raise_os_error(failure);
}

// For loops that run without the GIL and call it now and then: raises what Ctrl-C raises, and calls progress(how far),
// unless that is None.
inline auto watch_for_python(const pybind11::object& progress) {
  return [progress](std::size_t done) {
    const pybind11::gil_scoped_acquire with_gil;
    if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
    if (!progress.is_none()) progress(done);
  };
}

}  // namespace tumble::python
