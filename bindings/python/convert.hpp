// numpy <-> core: arguments are copied in, results are fresh float64 arrays. No memory of the caller is kept.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "tumble/math/vector.hpp"

namespace tumble::python {

namespace py = pybind11;

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

// `object` as a contiguous float64 array: lists, any integer or float dtype, any strides, read-only or not.
// Raises ValueError naming `name` for anything else (complex, text, ragged lists, masked entries, None) and for a shape
// other than `shape`, where -1 stands for any length. `shape_in_words` is what the message says in its place: "(N, n)".
Array as_array(const py::handle& object, const char* name, const std::vector<py::ssize_t>& shape,
               const std::string& shape_in_words = "");

// Of an array or of lists in lists; -1 for what is neither, which `as_array` refuses. Refuses masked entries.
py::ssize_t num_dimensions(const py::handle& object, const char* name);

// Booleans as zeros and ones, for `as_array`; anything else as it is.
py::object without_bools(const py::handle& object, const char* name);

// One line that names the field, where pybind11's own message for a wrong type fills a screen.
double as_number(const py::handle& object, const char* field);

// Raise TypeError for anything but a str, for what is neither a bool nor a number.
std::string as_text(const py::handle& object, const char* field);
bool as_flag(const py::handle& object, const char* field);

// For messages: repr, cut off after 40 characters.
std::string short_repr(const py::handle& object);

Vector3 as_vector3(const py::handle& object, const char* name);
std::vector<double> as_vector(const Array& array);

py::array_t<double> to_numpy(std::span<const double> values);
py::array_t<double> to_numpy(std::span<const double> values, py::ssize_t rows, py::ssize_t columns);

void bind_batch(py::module_& module);
void bind_lcp(py::module_& module);
void bind_contacts(py::module_& module);
void bind_drop(py::module_& module);
void bind_shape(py::module_& module);
void bind_scene(py::module_& module);
void bind_trajectory(py::module_& module);
void bind_simulation(py::module_& module);
void bind_rollout(py::module_& module);

}  // namespace tumble::python
