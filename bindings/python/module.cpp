// The extension module tumble._core. The public names, their docstrings and types are in the Python files
// beside it.
#include <algorithm>
#include <stdexcept>

#include "convert.hpp"

#include "tumble/math/format.hpp"

namespace tumble::python {
namespace {

std::string shape_text(const py::ssize_t* shape, std::size_t num_dimensions) {
  std::string text = "(";
  for (std::size_t i = 0; i < num_dimensions; ++i) {
    text += shape[i] < 0 ? "n" : std::to_string(shape[i]);
    if (i + 1 < num_dimensions || num_dimensions == 1) text += ",";
    if (i + 1 < num_dimensions) text += " ";
  }
  return text + ")";
}

bool is_plain_array(const py::handle& object) {
  return Py_TYPE(object.ptr()) == py::detail::npy_api::get().PyArray_Type_;
}

// The numbers under a mask mean nothing, and no function here can leave them out. numpy would take off the masks of
// rows in a list without a word. `max_depth` of lists in lists: more is the shape of no argument, and a list may hold
// itself.
void refuse_mask(const py::handle& object, const char* name, int max_depth = 3) {
  static const py::object masked_array = py::module_::import("numpy.ma").attr("MaskedArray").cast<py::object>();
  if (is_plain_array(object) || PyFloat_CheckExact(object.ptr()) || PyLong_CheckExact(object.ptr())) return;
  if (py::isinstance<py::list>(object) || py::isinstance<py::tuple>(object)) {
    if (max_depth == 0) return;
    for (const py::handle item : object) refuse_mask(item, name, max_depth - 1);
    return;
  }
  if (!py::isinstance(object, masked_array)) return;
  const auto masked = py::module_::import("numpy.ma").attr("count_masked")(object).cast<py::ssize_t>();
  if (masked == 0) return;
  throw std::invalid_argument(tumble::format("{}: must have no masked entry, got {}", name, masked));
}

std::string dtype_text(const py::array& array) { return "dtype " + std::string(py::str(array.dtype())); }

// numpy calls whatever it does not know an array of objects.
std::string contents_text(const py::handle& object) {
  const bool is_array =
      py::isinstance<py::list>(object) || py::isinstance<py::tuple>(object) || py::isinstance<py::array>(object);
  return is_array ? "dtype object" : std::string(py::str(py::type::handle_of(object).attr("__name__")));
}

}  // namespace

Array as_array(const py::handle& object, const char* name, const std::vector<py::ssize_t>& shape,
               const std::string& shape_in_words) {
  Array array;
  refuse_mask(object, name);
  if (py::isinstance<Array>(object)) {  // float64 and contiguous: nothing to convert
    array = py::reinterpret_borrow<Array>(object);
  } else {
    const auto any = py::array::ensure(object);
    if (!any) {
      PyErr_Clear();
      throw std::invalid_argument(tumble::format("{}: must be an array of numbers", name));
    }
    const char kind = any.dtype().kind();
    const bool is_empty_list = any.size() == 0;
    if (kind != 'f' && kind != 'i' && kind != 'u' && !is_empty_list) {
      throw std::invalid_argument(tumble::format("{}: must be an array of real numbers, got {}", name,
                                                 kind == 'O' ? contents_text(object) : dtype_text(any)));
    }
    array = Array::ensure(any);
    if (!array) {
      PyErr_Clear();
      throw std::invalid_argument(tumble::format("{}: must be an array of numbers", name));
    }
  }
  const bool has_shape = static_cast<std::size_t>(array.ndim()) == shape.size() &&
                         std::equal(shape.begin(), shape.end(), array.shape(),
                                    [](py::ssize_t wanted, py::ssize_t got) { return wanted < 0 || wanted == got; });
  if (!has_shape) {
    throw std::invalid_argument(
        tumble::format("{}: must have shape {}, got {}", name,
                       shape_in_words.empty() ? shape_text(shape.data(), shape.size()) : shape_in_words,
                       shape_text(array.shape(), static_cast<std::size_t>(array.ndim()))));
  }
  return array;
}

py::ssize_t num_dimensions(const py::handle& object, const char* name) {
  refuse_mask(object, name);
  const auto array = py::array::ensure(object);
  if (!array) PyErr_Clear();
  return array ? array.ndim() : -1;
}

py::object without_bools(const py::handle& object, const char* name) {
  refuse_mask(object, name);
  const auto array = py::array::ensure(object);
  if (!array) PyErr_Clear();
  if (!array || array.dtype().kind() != 'b') return py::reinterpret_borrow<py::object>(object);
  return Array::ensure(array);
}

std::string short_repr(const py::handle& object) {
  const std::string text = py::repr(object);
  return text.size() <= 40 ? text : text.substr(0, 40) + "...";
}

double as_number(const py::handle& object, const char* field) {
  const double value = PyFloat_AsDouble(object.ptr());
  if (value == -1.0 && PyErr_Occurred()) {
    PyErr_Clear();
    throw std::invalid_argument(tumble::format("{}: must be a number, got {}", field, short_repr(object)));
  }
  return value;
}

std::string as_text(const py::handle& object, const char* field) {
  if (py::isinstance<py::str>(object)) {
    Py_ssize_t size = 0;
    const char* text = PyUnicode_AsUTF8AndSize(object.ptr(), &size);
    if (text != nullptr) return {text, static_cast<std::size_t>(size)};
    PyErr_Clear();  // half of a surrogate pair
    throw std::invalid_argument(tumble::format("{}: must be valid UTF-8, got {}", field, short_repr(object)));
  }
  throw py::type_error(tumble::format("{}: must be text, got {}", field, short_repr(object)));
}

bool as_flag(const py::handle& object, const char* field) {
  try {
    return py::cast<bool>(object);
  } catch (const py::cast_error&) {
    throw py::type_error(tumble::format("{}: must be True or False, got {}", field, short_repr(object)));
  }
}

Vector3 as_vector3(const py::handle& object, const char* name) {
  const Array array = as_array(object, name, {3});
  const double* data = array.data();
  return {data[0], data[1], data[2]};
}

std::vector<double> as_vector(const Array& array) { return {array.data(), array.data() + array.size()}; }

py::array_t<double> to_numpy(std::span<const double> values) {
  py::array_t<double> array(static_cast<py::ssize_t>(values.size()));
  std::copy(values.begin(), values.end(), array.mutable_data());
  return array;
}

py::array_t<double> to_numpy(std::span<const double> values, py::ssize_t rows, py::ssize_t columns) {
  py::array_t<double> array({rows, columns});
  std::copy(values.begin(), values.end(), array.mutable_data());
  return array;
}

}  // namespace tumble::python

PYBIND11_MODULE(_core, module) {
  module.doc() = "Compiled part of tumble; see tumble, tumble.drop and tumble.lcp.";
  module.attr("__version__") = TUMBLE_VERSION;
  tumble::python::bind_lcp(module);
  tumble::python::bind_contacts(module);
  tumble::python::bind_batch(module);
  tumble::python::bind_drop(module);
  tumble::python::bind_shape(module);
  tumble::python::bind_scene(module);
  tumble::python::bind_trajectory(module);
  tumble::python::bind_simulation(module);
  tumble::python::bind_rollout(module);
}
