// tumble._core: the LCP solvers. Public face: tumble/lcp.py.
#include <stdexcept>
#include <string>

#include "convert.hpp"
#include <fmt/format.h>

#include "tumble/lcp/problem_text.hpp"
#include "tumble/lcp/residual.hpp"
#include "tumble/lcp/solve.hpp"

namespace tumble::python {
namespace {

LcpProblem as_problem(const py::handle& M, const py::handle& q) {
  const Array vector = as_array(q, "q", {-1});
  const Array matrix = as_array(M, "M", {-1, -1});
  const py::ssize_t n = vector.size();
  if (matrix.shape(0) != n || matrix.shape(1) != n) {
    throw std::invalid_argument(fmt::format("M: must have shape ({0}, {0}) for q of length {0}, got ({1}, {2})", n,
                                            matrix.shape(0), matrix.shape(1)));
  }
  return {as_vector(matrix), as_vector(vector), {}};
}

// (status, z, w, residual, pivots, basis)
py::tuple as_tuple(const LcpResult& result) {
  py::array_t<bool> basis(static_cast<py::ssize_t>(result.basis.size()));
  for (std::size_t i = 0; i < result.basis.size(); ++i) basis.mutable_data()[i] = result.basis[i] != 0;
  return py::make_tuple(std::string(to_string(result.status)), to_numpy(result.z), to_numpy(result.w), result.residual,
                        result.pivots, basis);
}

py::tuple lemke_tuple(const py::handle& M, const py::handle& q, int max_pivots, double pivot_tolerance,
                      double accepted_residual) {
  const LcpProblem problem = as_problem(M, q);
  LcpResult result;
  {
    const py::gil_scoped_release without_gil;
    result = lemke(problem, {max_pivots, pivot_tolerance, accepted_residual});
  }
  return as_tuple(result);
}

py::tuple enumerate_tuple(const py::handle& M, const py::handle& q, double accepted_residual) {
  return as_tuple(enumerate(as_problem(M, q), {accepted_residual}));
}

py::list all_solutions(const py::handle& M, const py::handle& q, double accepted_residual) {
  py::list solutions;
  for (const LcpResult& result : enumerate_solutions(as_problem(M, q), {accepted_residual})) {
    solutions.append(as_tuple(result));
  }
  return solutions;
}

// (negative_w, negative_z, complementarity)
py::tuple residual_parts(const py::handle& M, const py::handle& q, const py::handle& z, const py::handle& row_sizes) {
  LcpProblem problem = as_problem(M, q);
  if (!row_sizes.is_none()) problem.row_sizes = as_vector(as_array(row_sizes, "row_sizes", {-1}));
  const LcpResidual parts = residual(problem, as_vector(as_array(z, "z", {-1})));
  return py::make_tuple(parts.negative_w, parts.negative_z, parts.complementarity);
}

py::tuple parse_text(const std::string& text, const std::string& name) {
  const LcpProblem problem = parse_lcp(text, name);
  const auto n = static_cast<py::ssize_t>(problem.size());
  return py::make_tuple(to_numpy(problem.M, n, n), to_numpy(problem.q));
}

}  // namespace

void bind_lcp(py::module_& module) {
  const LemkeSettings lemke_defaults;
  const EnumerateSettings enumerate_defaults;
  module.def("lemke", &lemke_tuple, py::arg("M"), py::arg("q"), py::arg("max_pivots") = lemke_defaults.max_pivots,
             py::arg("pivot_tolerance") = lemke_defaults.pivot_tolerance,
             py::arg("accepted_residual") = lemke_defaults.accepted_residual);
  module.def("enumerate", &enumerate_tuple, py::arg("M"), py::arg("q"),
             py::arg("accepted_residual") = enumerate_defaults.accepted_residual);
  module.def("all_solutions", &all_solutions, py::arg("M"), py::arg("q"),
             py::arg("accepted_residual") = enumerate_defaults.accepted_residual);
  module.def("residual", &residual_parts, py::arg("M"), py::arg("q"), py::arg("z"), py::arg("row_sizes") = py::none());
  module.def("parse_lcp", &parse_text, py::arg("text"), py::arg("name") = "lcp");
}

}  // namespace tumble::python
