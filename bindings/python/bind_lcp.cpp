// tumble._core: the LCP solvers. Public face: tumble/lcp/.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <future>
#include <stdexcept>
#include <string>
#include <thread>

#include "convert_lcp.hpp"
#include <pybind11/stl.h>

#include "tumble/lcp/enumerate.hpp"
#include "tumble/lcp/exact.hpp"
#include "tumble/lcp/methods.hpp"
#include "tumble/lcp/problem_text.hpp"
#include "tumble/lcp/residual.hpp"
#include "tumble/math/format.hpp"

namespace tumble::python {

using namespace py::literals;

namespace {

py::array_t<bool> as_bools(const std::vector<std::uint8_t>& basis) {
  py::array_t<bool> array(static_cast<py::ssize_t>(basis.size()));
  for (std::size_t i = 0; i < basis.size(); ++i) array.mutable_data()[i] = basis[i] != 0;
  return array;
}

py::list as_list(const std::vector<std::string>& words) {
  py::list list;
  for (const std::string& word : words) list.append(py::str(word));
  return list;
}

// 0 for a setting that the method does not have: `set_setting` refuses it.
SettingValue value_of(const LcpSettings& settings, const std::string& name) {
  for (NamedSetting& setting : named_settings(settings)) {
    if (setting.name == name) return std::move(setting.value);
  }
  return 0;
}

bool is_list(const LcpSettings& settings, const std::string& name) {
  return std::holds_alternative<std::vector<double>>(value_of(settings, name));
}

// None leaves the setting as it is.
SettingValue as_setting(const LcpSettings& settings, const std::string& name, const py::handle& value) {
  if (value.is_none()) return value_of(settings, name);
  if (py::isinstance<py::str>(value)) return py::cast<std::string>(value);
  if (is_list(settings, name)) return as_vector(as_array(without_bools(value, name.c_str()), name.c_str(), {-1}));
  return as_number(value, name.c_str());
}

py::dict solve(const py::handle& M, const py::handle& q, const py::handle& method, const py::handle& row_sizes,
               const py::dict& settings) {
  const LcpProblem problem = as_problem(M, q, row_sizes);
  const LcpSettings chosen = as_settings(method, settings);
  LcpResult result;
  {
    const py::gil_scoped_release without_gil;
    result = solve_lcp(problem, chosen);
  }
  return as_dict(result);
}

// An argument of a batch: one array for all problems, or one for each.
class PerProblem {
 public:
  PerProblem() = default;

  PerProblem(const py::handle& object, const char* name, py::ssize_t count, std::vector<py::ssize_t> shape) {
    size_ = 1;
    for (const py::ssize_t length : shape) size_ *= length;
    const bool is_shared = num_dimensions(object, name) == static_cast<py::ssize_t>(shape.size());
    if (!is_shared) {
      stride_ = size_;
      shape.insert(shape.begin(), count);
    }
    array_ = as_array(object, name, shape);
    begin_ = array_.data();
  }

  bool is_empty() const { return size_ == 0; }
  bool is_shared() const { return !is_empty() && stride_ == 0; }

  void copy(std::size_t i, std::vector<double>& to) const {
    const double* from = begin_ + static_cast<py::ssize_t>(i) * stride_;
    to.assign(from, from + size_);
  }

 private:
  Array array_;
  const double* begin_ = nullptr;
  py::ssize_t size_ = 0;
  py::ssize_t stride_ = 0;  // 0: shared
};

// Raises ValueError for what is wrong with all problems at once: a method that takes no n like theirs, shared row sizes
// or a shared start. M = 1, q = 0 is solved by z = 0 at once; what refuses it would refuse every other.
void require_usable(LcpSettings settings, py::ssize_t n, const PerProblem& sizes, const PerProblem& starts,
                    const std::string& start_name) {
  const auto size = static_cast<std::size_t>(n);
  LcpProblem problem{std::vector<double>(size * size), std::vector<double>(size), {}};
  for (std::size_t i = 0; i < size; ++i) problem.M[i * size + i] = 1.0;
  if (sizes.is_shared()) sizes.copy(0, problem.row_sizes);
  std::vector<double> start;
  if (starts.is_shared()) starts.copy(0, start);
  if (!start.empty()) set_by_name(settings, start_name, start);
  solve_lcp(problem, settings);
}

// The results of a batch, one row for each problem; 0 where a result has no vector.
struct BatchArrays {
  py::array_t<std::int32_t> status, pivots, refactorisations, rung;
  py::array_t<double> z, w, residual, parts, certificate;
  py::array_t<bool> basis;

  BatchArrays(py::ssize_t count, py::ssize_t n)
      : status(count),
        pivots(count),
        refactorisations(count),
        rung(count),
        z({count, n}),
        w({count, n}),
        residual(count),
        parts({count, py::ssize_t{3}}),
        certificate({count, n}),
        basis({count, n}) {}

  void write(std::size_t i, const LcpResult& result) {
    const auto n = static_cast<std::size_t>(z.shape(1));
    const auto write_row = [&](auto& array, const auto& values) {
      auto* row = array.mutable_data() + i * n;
      std::fill(row, row + n, 0);
      std::copy(values.begin(), values.end(), row);
    };
    status.mutable_data()[i] = static_cast<std::int32_t>(result.status);
    pivots.mutable_data()[i] = result.pivots;
    refactorisations.mutable_data()[i] = result.refactorisations;
    rung.mutable_data()[i] = static_cast<std::int32_t>(result.rung);
    residual.mutable_data()[i] = result.residual;
    const std::array part = {result.parts.negative_w, result.parts.negative_z, result.parts.complementarity};
    std::copy(part.begin(), part.end(), parts.mutable_data() + 3 * i);
    write_row(z, result.z);
    write_row(w, result.w);
    write_row(certificate, result.certificate);
    write_row(basis, result.basis);
  }

  py::dict as_dict() const {
    return py::dict("status"_a = status, "z"_a = z, "w"_a = w, "residual"_a = residual, "parts"_a = parts,
                    "pivots"_a = pivots, "refactorisations"_a = refactorisations, "rung"_a = rung, "basis"_a = basis,
                    "certificate"_a = certificate);
  }
};

// work(begin, end) for parts of 0 .. count - 1, by `num_threads` threads. To be called without the GIL; between two
// parts of its own the calling thread looks for Ctrl-C, which raises KeyboardInterrupt after the parts begun.
template <class MakeWork>
void in_parallel(std::size_t count, std::size_t num_threads, const MakeWork& make_work) {
  constexpr std::size_t part = 64;
  std::atomic<std::size_t> next = 0;
  const auto run = [&](const auto& after_part) {
    auto work = make_work();
    for (std::size_t begin = next.fetch_add(part); begin < count; begin = next.fetch_add(part)) {
      work(begin, std::min(begin + part, count));
      after_part();
    }
  };
  std::vector<std::future<void>> others;
  for (std::size_t i = 1; i < std::min(num_threads, count / part + 1); ++i) {
    others.push_back(std::async(std::launch::async, [&] { run([] {}); }));
  }
  bool is_interrupted = false;
  run([&] {
    const py::gil_scoped_acquire with_gil;
    is_interrupted = PyErr_CheckSignals() != 0;
    if (is_interrupted) next = count;
  });
  for (std::future<void>& other : others) other.get();
  if (!is_interrupted) return;
  const py::gil_scoped_acquire with_gil;
  throw py::error_already_set();
}

py::dict solve_batch(const py::handle& M, const py::handle& q, const py::handle& method, const py::handle& row_sizes,
                     const py::handle& start, const py::handle& threads, const py::dict& settings) {
  const Array vectors = as_array(q, "q", {-1, -1}, "(N, n)");
  const py::ssize_t count = vectors.shape(0), n = vectors.shape(1);
  if (n == 0) throw std::invalid_argument("q: must have at least 1 entry per problem, got 0");
  const PerProblem all_M(M, "M", count, {n, n}), all_q(vectors, "q", count, {n});
  const PerProblem sizes = row_sizes.is_none() ? PerProblem() : PerProblem(row_sizes, "row_sizes", count, {n});
  LcpSettings chosen = as_settings(method, settings);
  const std::string start_name = is_list(chosen, "start_z") ? "start_z" : "start_basis";
  const PerProblem starts = start.is_none()
                                ? PerProblem()
                                : PerProblem(without_bools(start, start_name.c_str()), start_name.c_str(), count, {n});
  if (!start.is_none()) set_setting(chosen, start_name, std::vector<double>());
  validate(chosen);
  require_usable(chosen, n, sizes, starts, start_name);
  const double wanted = as_number(threads, "threads");
  if (!(wanted >= 0.0 && wanted <= 1024.0 && wanted == std::trunc(wanted))) {
    throw std::invalid_argument(tumble::format("threads: must be a whole number in [0, 1024], got {}", wanted));
  }
  const auto num_threads =
      wanted > 0.0 ? static_cast<std::size_t>(wanted) : std::max<std::size_t>(1, std::thread::hardware_concurrency());

  BatchArrays arrays(count, n);
  {
    const py::gil_scoped_release without_gil;
    in_parallel(static_cast<std::size_t>(count), num_threads, [&] {
      return [&, own = chosen, problem = LcpProblem(), list = std::vector<double>(), workspace = LcpWorkspace()](
                 std::size_t begin, std::size_t end) mutable {
        for (std::size_t i = begin; i < end; ++i) {
          all_M.copy(i, problem.M);
          all_q.copy(i, problem.q);
          sizes.copy(i, problem.row_sizes);
          if (!starts.is_empty()) {
            starts.copy(i, list);
            set_by_name(own, start_name, list);
          }
          arrays.write(i, solve_lcp(problem, own, workspace));
        }
      };
    });
  }
  return arrays.as_dict();
}

py::list all_solutions(const py::handle& M, const py::handle& q, const py::handle& accepted_residual) {
  const EnumerateSettings settings{as_number(accepted_residual, "accepted_residual")};
  py::list solutions;
  for (const LcpResult& result : enumerate_solutions(as_problem(M, q), settings)) {
    solutions.append(as_dict(result));
  }
  return solutions;
}

// The fields of tumble.lcp.ExactResult, numbers as text.
py::dict as_dict(const ExactResult& result) {
  return py::dict("status"_a = py::str(to_string(result.status)), "z"_a = as_list(result.z), "w"_a = as_list(result.w),
                  "basis"_a = as_bools(result.basis), "certificate"_a = as_list(result.certificate),
                  "pivots"_a = result.pivots);
}

// `basis` is None for one solution of any.
py::dict exact(std::vector<std::string> M, std::vector<std::string> q, const py::handle& basis) {
  const ExactLcp problem{std::move(M), std::move(q)};
  std::vector<std::uint8_t> start;
  if (!basis.is_none()) {
    for (const double x : as_vector(as_array(without_bools(basis, "basis"), "basis", {-1}))) {
      if (x != 0.0 && x != 1.0) throw std::invalid_argument(tumble::format("basis: must be zeros and ones, got {}", x));
      start.push_back(x != 0.0);
    }
  }
  ExactResult result;
  {
    const py::gil_scoped_release without_gil;
    result = basis.is_none() ? solve_exactly(problem) : exact_solution(problem, start);
  }
  return as_dict(result);
}

// The fields of tumble.lcp.ExactSolutionSet; a face as (vertices, rays).
py::dict solution_set(std::vector<std::string> M, std::vector<std::string> q) {
  const ExactLcp problem{std::move(M), std::move(q)};
  ExactSolutionSet set;
  {
    const py::gil_scoped_release without_gil;
    set = exact_solution_set(problem);
  }
  py::list vertices, rays, faces;
  for (const ExactResult& vertex : set.vertices) vertices.append(as_dict(vertex));
  for (const std::vector<std::string>& ray : set.rays) rays.append(as_list(ray));
  for (const SolutionFace& face : set.faces) faces.append(py::make_tuple(face.vertices, face.rays));
  return py::dict("status"_a = py::str(to_string(set.status)), "vertices"_a = vertices, "rays"_a = rays,
                  "faces"_a = faces, "certificate"_a = as_list(set.certificate));
}

// (negative_w, negative_z, complementarity)
py::tuple residual_parts(const py::handle& M, const py::handle& q, const py::handle& z, const py::handle& row_sizes) {
  const LcpResidual parts = residual(as_problem(M, q, row_sizes), as_vector(as_array(z, "z", {-1})));
  return py::make_tuple(parts.negative_w, parts.negative_z, parts.complementarity);
}

py::tuple parse_text(const py::handle& text, const py::handle& name) {
  const LcpProblem problem = parse_lcp(as_text(text, "text"), as_text(name, "name"));
  const auto n = static_cast<py::ssize_t>(problem.size());
  return py::make_tuple(to_numpy(problem.M, n, n), to_numpy(problem.q));
}

// {name: summary}
py::dict methods() {
  py::dict summaries;
  for (const LcpMethod& method : lcp_methods()) summaries[py::str(method.name)] = py::str(method.summary);
  return summaries;
}

// {name: default}; None for a list, of which none is the default.
py::dict settings_of(const py::handle& method) {
  struct AsObject {
    py::object operator()(int count) const { return py::int_(count); }
    py::object operator()(double number) const { return py::float_(number); }
    py::object operator()(const std::string& word) const { return py::str(word); }
    py::object operator()(const std::vector<double>&) const { return py::none(); }
  };
  py::dict defaults;
  for (const NamedSetting& setting : named_settings(as_settings(method, {}))) {
    defaults[py::str(setting.name)] = std::visit(AsObject(), setting.value);
  }
  return defaults;
}

template <class Names>
py::tuple as_names(const Names& values) {
  py::list names;
  for (const auto value : values) names.append(py::str(to_string(value)));
  return py::tuple(names);
}

}  // namespace

LcpProblem as_problem(const py::handle& M, const py::handle& q, const py::handle& row_sizes) {
  const Array vector = as_array(q, "q", {-1});
  const Array matrix = as_array(M, "M", {-1, -1});
  const py::ssize_t n = vector.size();
  if (matrix.shape(0) != n || matrix.shape(1) != n) {
    throw std::invalid_argument(tumble::format("M: must have shape ({0}, {0}) for q of length {0}, got ({1}, {2})", n,
                                               matrix.shape(0), matrix.shape(1)));
  }
  LcpProblem problem{as_vector(matrix), as_vector(vector), {}};
  if (!row_sizes.is_none()) problem.row_sizes = as_vector(as_array(row_sizes, "row_sizes", {n}));
  return problem;
}

void set_setting(LcpSettings& settings, const std::string& name, const SettingValue& value) {
  try {
    set_by_name(settings, name, value);
  } catch (const UnknownSetting& error) {  // as Python does for an unknown keyword
    throw py::type_error(error.what());
  }
}

LcpSettings as_settings(const py::handle& method, const py::dict& settings) {
  if (!py::isinstance<py::str>(method)) {
    throw std::invalid_argument(tumble::format("method: must be a name, got {}", short_repr(method)));
  }
  LcpSettings chosen = lcp_method(py::cast<std::string>(method)).defaults;
  for (const auto& [name, value] : settings) {
    const auto field = py::cast<std::string>(name);
    set_setting(chosen, field, as_setting(chosen, field, value));
  }
  return chosen;
}

py::dict as_dict(const LcpResult& result) {
  const LcpResidual& parts = result.parts;
  py::object certificate = py::none();
  if (!result.certificate.empty()) certificate = to_numpy(result.certificate);
  return py::dict("status"_a = py::str(to_string(result.status)), "z"_a = to_numpy(result.z),
                  "w"_a = to_numpy(result.w), "residual"_a = result.residual,
                  "parts"_a = py::make_tuple(parts.negative_w, parts.negative_z, parts.complementarity),
                  "pivots"_a = result.pivots, "refactorisations"_a = result.refactorisations,
                  "rung"_a = py::str(to_string(result.rung)), "basis"_a = as_bools(result.basis),
                  "certificate"_a = certificate);
}

void bind_lcp(py::module_& module) {
  module.def("solve", &solve, "M"_a, "q"_a, "method"_a, "row_sizes"_a, "settings"_a);
  module.def("solve_batch", &solve_batch, "M"_a, "q"_a, "method"_a, "row_sizes"_a, "start"_a, "threads"_a,
             "settings"_a);
  module.def("all_solutions", &all_solutions, "M"_a, "q"_a, "accepted_residual"_a);
  module.def("exact", &exact, "M"_a, "q"_a, "basis"_a);
  module.def("solution_set", &solution_set, "M"_a, "q"_a);
  module.def("residual", &residual_parts, "M"_a, "q"_a, "z"_a, "row_sizes"_a);
  module.def("parse_lcp", &parse_text, "text"_a, "name"_a);
  module.def("methods", &methods);
  module.def("settings_of", &settings_of, "method"_a);
  module.attr("STATUSES") = as_names(k_lcp_statuses);
  module.attr("RUNGS") = as_names(k_lcp_rungs);
}

}  // namespace tumble::python
