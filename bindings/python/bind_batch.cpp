// tumble._core: batches of drops. Public face: tumble/_batch.py.
#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "convert.hpp"
#include "without_gil.hpp"

#include "tumble/batch/simulate_batch.hpp"
#include "tumble/math/format.hpp"

namespace tumble::python {
namespace {

using namespace py::literals;
using batch::DropMeasures;

template <class Real>
using ArrayOf = py::array_t<Real, py::array::c_style | py::array::forcecast>;

// An N x 3 array; what is float32 already is not copied.
template <class Real>
ArrayOf<Real> as_rows(const py::handle& object, const char* name) {
  if constexpr (sizeof(Real) == 4) {
    const bool fits = py::isinstance<ArrayOf<Real>>(object) && !py::isinstance<Array>(object);
    if (fits) {
      const auto array = py::reinterpret_borrow<ArrayOf<Real>>(object);
      if (array.ndim() == 2 && array.shape(1) == 3) return array;
    }
  }
  return as_array(object, name, {-1, 3}, "(N, 3)");
}

// A number, or an array with one for each drop.
struct Values {
  double number = 0.0;
  std::optional<Array> array{};

  std::span<const double> span() const {
    return array ? std::span(array->data(), static_cast<std::size_t>(array->size())) : std::span(&number, 1);
  }
};

Values as_values(const py::handle& object, const char* name) {
  if (PyFloat_CheckExact(object.ptr()) || PyLong_CheckExact(object.ptr()) || num_dimensions(object, name) == 0) {
    return {as_number(object, name)};
  }
  return {0.0, as_array(object, name, {-1}, "() or (N,)")};
}

constexpr const char* k_names[] = {"l", "m", "mu", "eps", "dt", "delta", "g"};

struct Parameters {
  explicit Parameters(const py::dict& object) {
    for (std::size_t k = 0; k < 7; ++k) values[k] = as_values(object[k_names[k]], k_names[k]);
    columns = object["columns"].cast<int>();
  }

  // For the library no value at all is the document's.
  void require_lengths(std::size_t count) const {
    for (std::size_t k = 0; k < 7; ++k) {
      if (!values[k].span().empty() || count == 0) continue;
      throw std::invalid_argument(tumble::format("{}: must have 1 or {} values, got 0", k_names[k], count));
    }
  }

  batch::DropParameters arrays() const {
    return {values[0].span(), values[1].span(), values[2].span(), values[3].span(),
            values[4].span(), values[5].span(), values[6].span(), columns};
  }

  std::array<Values, 7> values;
  int columns;
};

std::optional<InstructionSet> as_instruction_set(const py::object& name) {
  if (name.is_none()) return std::nullopt;
  return instruction_set_named(as_text(name, "instruction_set"), "instruction_set");
}

template <class T>
std::span<T> span_of(py::array_t<T>& array) {
  return {array.mutable_data(), static_cast<std::size_t>(array.size())};
}

template <class Real>
py::tuple simulate_batch(const py::object& q0, const py::object& v0, const py::dict& params, int every, bool states,
                         bool measures, double rest_speed, double x_min, double x_max, int threads,
                         const py::object& instruction_set, const py::object& progress) {
  const auto q_rows = as_rows<Real>(q0, "q0"), v_rows = as_rows<Real>(v0, "v0");
  if (q_rows.shape(0) != v_rows.shape(0)) {
    throw std::invalid_argument(
        tumble::format("q0, v0: must have as many rows, got {} and {}", q_rows.shape(0), v_rows.shape(0)));
  }
  const Parameters parameters(params);
  const py::ssize_t count = q_rows.shape(0);
  parameters.require_lengths(static_cast<std::size_t>(count));
  std::vector<py::ssize_t> shape = {count, 3};
  if (every != 0 && parameters.columns > 0) {
    shape.push_back(static_cast<py::ssize_t>(batch::kept_columns(parameters.columns, every)));
  }
  if (!states) shape[0] = 0;
  py::array_t<Real> q(shape), v(shape);
  py::array_t<std::uint8_t> status(count);
  py::array_t<std::int32_t> columns(count);
  py::array_t<DropMeasures> told(measures ? count : 0);
  const batch::DropStarts<Real> starts{{q_rows.data(), static_cast<std::size_t>(q_rows.size())},
                                       {v_rows.data(), static_cast<std::size_t>(v_rows.size())}};
  const batch::BatchSettings settings{
      every, threads, {rest_speed, x_min, x_max}, as_instruction_set(instruction_set), watch_for_python(progress)};
  const auto statuses = span_of(status);
  const batch::DropResults<Real> results{span_of(q),
                                         span_of(v),
                                         {reinterpret_cast<batch::DropStatus*>(statuses.data()), statuses.size()},
                                         span_of(columns),
                                         span_of(told)};
  const batch::DropParameters arrays = parameters.arrays();
  {
    const py::gil_scoped_release without_gil;
    batch::simulate_batch<Real>(starts, arrays, settings, results);
  }
  const auto or_none = [](const py::array& array, bool is_wanted) {
    return is_wanted ? py::object(array) : py::none();
  };
  const bool has_invalid =
      std::find(results.status.begin(), results.status.end(), batch::DropStatus::invalid) != results.status.end();
  return py::make_tuple(has_invalid, or_none(q, states), or_none(v, states), status, columns, or_none(told, measures));
}

std::string what_is_invalid(const py::object& q0, const py::object& v0, const py::dict& params, std::size_t i) {
  const Array q = as_array(q0, "q0", {-1, 3}), v = as_array(v0, "v0", {-1, 3});
  return batch::what_is_invalid(
      {{q.data(), static_cast<std::size_t>(q.size())}, {v.data(), static_cast<std::size_t>(v.size())}},
      Parameters(params).arrays(), i);
}

}  // namespace

void bind_batch(py::module_& module) {
  PYBIND11_NUMPY_DTYPE(DropMeasures, last_contact, rest_time, max_impulse, energy_lost, escape_time, impacts, face);
  module.def("simulate_batch", &simulate_batch<double>);
  module.def("simulate_batch_single", &simulate_batch<float>);
  module.def("what_is_invalid", &what_is_invalid);
  module.def("instruction_set", [] { return std::string(to_string(instruction_set())); });
}

}  // namespace tumble::python
