// Settings and results of the LCP solvers <-> Python, for the bindings that solve.
#pragma once

#include <string>

#include "convert.hpp"

#include "tumble/lcp/methods.hpp"

namespace tumble::python {

// Raises ValueError for shapes that do not fit.
LcpProblem as_problem(const py::handle& M, const py::handle& q, const py::handle& row_sizes = py::none());

// The method's defaults, changed by the keyword arguments in `settings`. Raises ValueError for an unknown method or a
// value of the wrong kind, TypeError for a setting that the method does not have.
LcpSettings as_settings(const py::handle& method, const py::dict& settings);

// `set_by_name` with the TypeError.
void set_setting(LcpSettings& settings, const std::string& name, const SettingValue& value);

// The fields of tumble.lcp.Result; `parts` as a tuple of three.
py::dict as_dict(const LcpResult& result);

}  // namespace tumble::python
