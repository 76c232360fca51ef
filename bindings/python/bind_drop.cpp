// tumble._core: the document's drop model. Public face: tumble/drop.py.
#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "convert.hpp"

#include "tumble/drop/drop.hpp"
#include "tumble/math/format.hpp"

namespace tumble::python {
namespace {

using namespace py::literals;
using drop::Parameters;

int as_count(const py::object& object, const char* field) {
  const long value = PyLong_Check(object.ptr()) || PyIndex_Check(object.ptr()) ? PyLong_AsLong(object.ptr()) : -1;
  const bool is_count = !PyErr_Occurred() && value >= 0 && value <= std::numeric_limits<int>::max();
  PyErr_Clear();
  if (!is_count) {
    throw std::invalid_argument(tumble::format("{}: must be a whole number in [2, {}], got {}", field,
                                               drop::k_max_columns, short_repr(object)));
  }
  return static_cast<int>(value);
}

Parameters make_parameters(const py::object& l, const py::object& m, const py::object& mu, const py::object& eps,
                           const py::object& dt, const py::object& delta, const py::object& g,
                           const py::object& columns) {
  const Parameters parameters{as_number(l, "l"),     as_number(m, "m"),           as_number(mu, "mu"),
                              as_number(eps, "eps"), as_number(dt, "dt"),         as_number(delta, "delta"),
                              as_number(g, "g"),     as_count(columns, "columns")};
  validate(parameters);
  return parameters;
}

py::dict as_dict(const Parameters& p) {
  return py::dict("l"_a = p.l, "m"_a = p.m, "mu"_a = p.mu, "eps"_a = p.eps, "dt"_a = p.dt, "delta"_a = p.delta,
                  "g"_a = p.g, "columns"_a = p.columns);
}

const Parameters& as_parameters(const py::handle& object) {
  if (py::isinstance<Parameters>(object)) return object.cast<const Parameters&>();
  const std::string type = py::str(py::type::handle_of(object).attr("__name__"));
  throw py::type_error(tumble::format("params: must be a tumble.drop.Parameters, got {}", type));
}

drop::Jacobian as_jacobian(const py::handle& object) {
  const Array J = as_array(object, "J", {3, 2});
  drop::Jacobian jacobian;
  for (py::ssize_t i = 0; i < 3; ++i) {
    jacobian.t[static_cast<std::size_t>(i)] = J.at(i, 0);
    jacobian.n[static_cast<std::size_t>(i)] = J.at(i, 1);
  }
  return jacobian;
}

py::tuple get_contacts(const py::handle& q, const py::handle& params) {
  const Parameters& parameters = as_parameters(params);
  const auto [J, phi] = drop::get_contacts(as_vector3(q, "q"), parameters);
  const std::array<double, 6> rows = {J.t[0], J.n[0], J.t[1], J.n[1], J.t[2], J.n[2]};
  return py::make_tuple(to_numpy(rows, 3, 2), phi);
}

py::tuple form_lcp(const py::handle& J, const py::handle& v, const py::handle& params) {
  const Parameters& parameters = as_parameters(params);
  const auto [V, p] = drop::form_lcp(as_jacobian(J), as_vector3(v, "v"), parameters);
  return py::make_tuple(to_numpy(std::span(V[0].data(), 16), 4, 4), to_numpy(p));
}

py::array_t<double> solve_LCP(const py::handle& V, const py::handle& p) {
  const Array matrix = as_array(V, "V", {4, 4});
  const Array vector = as_array(p, "p", {4});
  Matrix4 rows;
  std::copy(matrix.data(), matrix.data() + 16, rows[0].data());
  Vector4 right;
  std::copy(vector.data(), vector.data() + 4, right.data());
  return to_numpy(drop::solve_LCP(rows, right));
}

py::tuple step(const py::handle& q, const py::handle& v, const py::handle& params) {
  const Parameters& parameters = as_parameters(params);
  const auto [q_next, v_next] = drop::step(as_vector3(q, "q"), as_vector3(v, "v"), parameters);
  return py::make_tuple(to_numpy(q_next), to_numpy(v_next));
}

// A step that leaves the range of double ends the run: the document's return value has no room for a status.
void require_complete(const drop::Trajectory& trajectory, const Parameters& parameters) {
  if (trajectory.status == LcpStatus::solved) return;
  throw drop::NoSolution(
      tumble::format("step {} of {} left the range of double arithmetic: LCP status {}; the columns before it are fine",
                     trajectory.columns, parameters.columns - 1, to_string(trajectory.status)),
      trajectory.status);
}

// One trajectory of pieces that each begin with the last column of the one before.
drop::Trajectory join(const std::vector<drop::Trajectory>& pieces, int columns) {
  const auto stride = static_cast<std::size_t>(columns);
  drop::Trajectory whole{columns, std::vector<double>(3 * stride), std::vector<double>(3 * stride),
                         pieces.back().status};
  std::size_t start = 0;
  for (const drop::Trajectory& piece : pieces) {
    const auto length = static_cast<std::size_t>(piece.columns);
    for (std::size_t i = 0; i < 3; ++i) {
      std::copy_n(&piece.q[i * length], length, &whole.q[i * stride + start]);
      std::copy_n(&piece.v[i * length], length, &whole.v[i * stride + start]);
    }
    start += length - 1;
  }
  return whole;
}

// A long run in pieces, so that Ctrl-C is noticed between them; `simulate(q, v, parameters)` runs one. A step depends
// on its state alone, so the numbers are those of a run in one piece.
template <class Simulate>
drop::Trajectory simulate_in_pieces(Vector3 q, Vector3 v, const Parameters& parameters, Simulate simulate) {
  constexpr int k_piece = 100'000;  // columns, some milliseconds
  const auto run = [&](int columns) {
    const py::gil_scoped_release without_gil;
    Parameters piece = parameters;
    piece.columns = columns;
    return simulate(q, v, piece);
  };
  drop::Trajectory first = run(std::min(parameters.columns, k_piece));
  int columns = first.columns;
  if (columns == parameters.columns || first.status != LcpStatus::solved) return first;
  std::vector<drop::Trajectory> pieces;
  pieces.push_back(std::move(first));
  while (columns < parameters.columns && pieces.back().status == LcpStatus::solved) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    q = pieces.back().q_at(pieces.back().columns - 1);
    v = pieces.back().v_at(pieces.back().columns - 1);
    pieces.push_back(run(std::min(parameters.columns - columns + 1, k_piece)));
    columns += pieces.back().columns - 1;
  }
  return join(pieces, columns);
}

py::tuple simulate(const py::handle& q0, const py::handle& v0, const py::handle& params) {
  const Parameters& parameters = as_parameters(params);
  const drop::Trajectory trajectory =
      simulate_in_pieces(as_vector3(q0, "q0"), as_vector3(v0, "v0"), parameters, &drop::simulate);
  require_complete(trajectory, parameters);
  return py::make_tuple(to_numpy(trajectory.q, 3, trajectory.columns), to_numpy(trajectory.v, 3, trajectory.columns));
}

template <class T, class Field>
py::array_t<T> collect(const drop::Record& record, Field field) {
  py::array_t<T> values(static_cast<py::ssize_t>(record.steps.size()));
  for (std::size_t k = 0; k < record.steps.size(); ++k) values.mutable_data()[k] = field(record.steps[k]);
  return values;
}

template <class Field>
py::list collect_names(const drop::Record& record, Field field) {
  py::list names;
  for (const drop::StepRecord& s : record.steps) names.append(std::string(to_string(field(s))));
  return names;
}

py::dict simulate_with_record(const py::handle& q0, const py::handle& v0, const py::handle& params) {
  const Parameters& parameters = as_parameters(params);
  drop::Record record;
  record.trajectory =
      simulate_in_pieces(as_vector3(q0, "q0"), as_vector3(v0, "v0"), parameters,
                         [&record](const Vector3& q, const Vector3& v, const Parameters& piece_parameters) {
                           drop::Record piece = drop::simulate_with_record(q, v, piece_parameters);
                           if (!record.steps.empty()) record.steps.pop_back();  // the first of this piece says the same
                           record.steps.insert(record.steps.end(), piece.steps.begin(), piece.steps.end());
                           return std::move(piece.trajectory);
                         });
  const drop::Trajectory& trajectory = record.trajectory;
  const int columns = trajectory.columns;
  py::array_t<double> t(columns);
  py::array_t<double> kinetic(columns);
  py::array_t<double> potential(columns);
  for (int k = 0; k < columns; ++k) {
    t.mutable_data()[k] = k * parameters.dt;
    kinetic.mutable_data()[k] = kinetic_energy(trajectory.v_at(k), parameters);
    potential.mutable_data()[k] = potential_energy(trajectory.q_at(k), parameters);
  }
  using Step = drop::StepRecord;
  return py::dict("t"_a = t, "q"_a = to_numpy(trajectory.q, 3, columns), "v"_a = to_numpy(trajectory.v, 3, columns),
                  "gap"_a = collect<double>(record, [](const Step& s) { return s.gap; }),
                  "corner"_a = collect<int>(record, [](const Step& s) { return s.corner; }),
                  "f_n"_a = collect<double>(record, [](const Step& s) { return s.z[0]; }),
                  "f_t1"_a = collect<double>(record, [](const Step& s) { return s.z[1]; }),
                  "f_t2"_a = collect<double>(record, [](const Step& s) { return s.z[2]; }),
                  "slip_speed"_a = collect<double>(record, [](const Step& s) { return s.z[3]; }),
                  "mode"_a = collect_names(record, [](const Step& s) { return s.mode; }),
                  "status"_a = collect_names(record, [](const Step& s) { return s.status; }),
                  "residual"_a = collect<double>(record, [](const Step& s) { return s.residual; }),
                  "kinetic"_a = kinetic, "potential"_a = potential);
}

py::array_t<double> corner_positions(const py::handle& q, const py::handle& params) {
  const Parameters& parameters = as_parameters(params);
  const auto corners = drop::corner_positions(as_vector3(q, "q"), parameters);
  return to_numpy(std::span(corners[0].data(), 8), 4, 2);
}

}  // namespace

void bind_drop(py::module_& module) {
  py::register_exception<drop::NoSolution>(module, "NoSolution", PyExc_RuntimeError);

  const Parameters defaults;
  py::class_<Parameters>(module, "Parameters")
      .def(py::init(&make_parameters), py::kw_only(), "l"_a = defaults.l, "m"_a = defaults.m, "mu"_a = defaults.mu,
           "eps"_a = defaults.eps, "dt"_a = defaults.dt, "delta"_a = defaults.delta, "g"_a = defaults.g,
           "columns"_a = defaults.columns)
      .def_readonly("l", &Parameters::l)
      .def_readonly("m", &Parameters::m)
      .def_readonly("mu", &Parameters::mu)
      .def_readonly("eps", &Parameters::eps)
      .def_readonly("dt", &Parameters::dt)
      .def_readonly("delta", &Parameters::delta)
      .def_readonly("g", &Parameters::g)
      .def_readonly("columns", &Parameters::columns)
      .def("asdict", &as_dict)
      .def("__eq__",
           [](const Parameters& a, const py::object& b) {
             return py::isinstance<Parameters>(b) && a == b.cast<const Parameters&>();
           })
      .def("__hash__", [](const Parameters& p) { return py::hash(py::tuple(as_dict(p).attr("values")())); })
      .def("__repr__",
           [](const Parameters& p) {
             return tumble::format("Parameters(l={}, m={}, mu={}, eps={}, dt={}, delta={}, g={}, columns={})", p.l, p.m,
                                   p.mu, p.eps, p.dt, p.delta, p.g, p.columns);
           })
      .def(py::pickle([](const Parameters& p) { return as_dict(p); },
                      [](const py::dict& d) { return py::type::of<Parameters>()(**d).cast<Parameters>(); }));

  module.def("get_contacts", &get_contacts, "q"_a, "params"_a);
  module.def("form_lcp", &form_lcp, "J"_a, "v"_a, "params"_a);
  module.def("solve_LCP", &solve_LCP, "V"_a, "p"_a);
  module.def("step", &step, "q"_a, "v"_a, "params"_a);
  module.def("simulate", &simulate, "q0"_a, "v0"_a, "params"_a);
  module.def("simulate_with_record", &simulate_with_record, "q0"_a, "v0"_a, "params"_a);
  module.def("corner_positions", &corner_positions, "q"_a, "params"_a);
}

}  // namespace tumble::python
