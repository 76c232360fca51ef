#include "tumble/lcp/exact.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "tumble/lcp/integer_pivoting.hpp"
#include "tumble/lcp/residual.hpp"
#include "tumble/math/format.hpp"

namespace tumble {
namespace {

IntegerLcp prepare(const RationalLcp& problem, std::size_t max_size) {
  IntegerLcp integers = integers_of(problem);
  require_exact_limits(integers, max_size);
  return integers;
}

std::vector<Rational> rationals_of(const std::vector<std::string>& numbers, const char* name) {
  std::vector<Rational> rationals;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    rationals.push_back(parse_entry(numbers[i], tumble::format("{}[{}]", name, i)));
  }
  return rationals;
}

void require_length(const char* name, std::size_t length, std::size_t n) {
  if (length != n)
    throw std::invalid_argument(tumble::format("{}: must have {} entries like q, got {}", name, n, length));
}

// The w of a z, both in the units of the problem.
std::vector<Rational> complement(const RationalLcp& problem, const std::vector<Rational>& z) {
  const std::size_t n = problem.size();
  std::vector<Rational> w = problem.q;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (z[j] != 0) w[i] += problem.M[i * n + j] * z[j];
    }
  }
  return w;
}

ExactResult to_exact(const RationalLcp& problem, RationalResult&& found) {
  ExactResult result;
  result.status = found.status;
  result.basis = std::move(found.basis);
  result.pivots = found.pivots;
  result.certificate = to_text(found.certificate);
  if (!found.z.empty()) {
    result.z = to_text(found.z);
    result.w = to_text(complement(problem, found.z));
  }
  return result;
}

bool proves_infeasible(const RationalLcp& problem, const std::vector<Rational>& y) {
  const std::size_t n = problem.size();
  Rational q_y = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (y[i] < 0) return false;
    q_y += problem.q[i] * y[i];
  }
  if (q_y >= 0) return false;
  for (std::size_t j = 0; j < n; ++j) {
    Rational sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += problem.M[i * n + j] * y[i];
    if (sum > 0) return false;
  }
  return true;
}

}  // namespace

ExactLcp as_exact(const LcpProblem& problem) {
  validate(problem);
  const RationalLcp rationals = rationals_of(problem);
  return {to_text(rationals.M), to_text(rationals.q)};
}

LcpProblem as_doubles(const ExactLcp& problem) {
  const RationalLcp rationals = rationals_of(problem);
  return {nearest_doubles(rationals.M), nearest_doubles(rationals.q), {}};
}

std::vector<double> as_doubles(const std::vector<std::string>& numbers) {
  return nearest_doubles(rationals_of(numbers, "numbers"));
}

bool is_within_exact_limits(const LcpProblem& problem) {
  validate(problem);
  if (problem.size() > k_max_exact_size) return false;
  return problem.size() * integers_of(rationals_of(problem)).num_bits <= k_max_exact_bits;
}

ExactResult exact_solution(const ExactLcp& problem, std::span<const std::uint8_t> basis) {
  const RationalLcp rationals = rationals_of(problem);
  require_length("basis", basis.size(), problem.size());
  return to_exact(rationals, run_basis(prepare(rationals, k_max_exact_size), basis));
}

ExactResult exact_lemke(const ExactLcp& problem) {
  const RationalLcp rationals = rationals_of(problem);
  return to_exact(rationals, run_lemke(prepare(rationals, k_max_exact_size)));
}

LcpResult exact_lemke(const LcpProblem& problem) {
  validate(problem);
  RationalResult found = run_lemke(prepare(rationals_of(problem), k_max_exact_size));
  LcpResult result;
  result.rung = LcpRung::exact;
  result.status = found.status;
  result.pivots = found.pivots;
  result.z = found.z.empty() ? std::vector<double>(problem.size(), 0.0) : nearest_doubles(found.z);
  result.basis = found.basis.empty() ? std::vector<std::uint8_t>(problem.size(), 0) : std::move(found.basis);
  result.certificate = nearest_doubles(found.certificate);
  const auto judge_z = [&] {
    result.w = complement(problem, result.z);
    result.parts = residual(problem, result.z);
    result.residual = result.parts.largest();
  };
  judge_z();
  // An exact solution beyond the range of double has no z to return.
  if (result.status == LcpStatus::solved && !(result.residual <= k_largest_accepted_residual)) {
    result.status = LcpStatus::numerical;
    result.z.assign(problem.size(), 0.0);
    judge_z();
  }
  return result;
}

ExactResult solve_exactly(const ExactLcp& problem) {
  ExactResult result = exact_lemke(problem);
  const bool is_decided = result.status == LcpStatus::solved || result.status == LcpStatus::infeasible;
  if (is_decided || problem.size() > k_max_exact_enumerate_size) return result;
  ExactSolutionSet set = exact_solution_set(problem);
  if (!set.vertices.empty()) return set.vertices.front();
  if (set.status == LcpStatus::no_solution_proved) {
    result.status = set.status;
    result.certificate.clear();
  }
  return result;
}

ExactSolutionSet exact_solution_set(const ExactLcp& problem) {
  const RationalLcp rationals = rationals_of(problem);
  const IntegerLcp integers = prepare(rationals, k_max_exact_enumerate_size);
  const RationalSolutionSet set = rational_solution_set(integers);
  ExactSolutionSet result;
  if (!set.is_complete) {
    result.status = LcpStatus::iteration_limit;
    return result;
  }
  for (std::size_t v = 0; v < set.z.size(); ++v) {
    ExactResult& vertex = result.vertices.emplace_back();
    vertex.status = LcpStatus::solved;
    vertex.z = to_text(set.z[v]);
    vertex.w = to_text(set.w[v]);
    for (std::size_t i = 0; i < problem.size(); ++i) vertex.basis.push_back(set.bases[v] >> i & 1);
  }
  for (const std::vector<Rational>& direction : set.rays) result.rays.push_back(to_text(direction));
  result.faces = set.faces;
  result.status = LcpStatus::solved;
  if (!result.vertices.empty()) return result;
  Phase1 phase1 = find_feasible_point(integers.n, integers.n, integers.entries);
  result.status = phase1.status == LcpStatus::infeasible ? LcpStatus::infeasible : LcpStatus::no_solution_proved;
  result.certificate = to_text(in_units(std::move(phase1.y), integers));
  return result;
}

bool proves_infeasible(const ExactLcp& problem, const std::vector<std::string>& y) {
  const RationalLcp rationals = rationals_of(problem);
  require_length("y", y.size(), problem.size());
  return proves_infeasible(rationals, rationals_of(y, "y"));
}

bool proves_infeasible(const LcpProblem& problem, std::span<const double> y) {
  validate(problem);
  require_length("y", y.size(), problem.size());
  std::vector<Rational> y_rational;
  for (const double y_i : y) {
    if (!std::isfinite(y_i)) return false;
    y_rational.push_back(rational_of(y_i));
  }
  return proves_infeasible(rationals_of(problem), y_rational);
}

ExactFeasibility exact_feasibility(const ExactLcp& problem) {
  const RationalLcp rationals = rationals_of(problem);
  const IntegerLcp integers = prepare(rationals, k_max_exact_size);
  Phase1 phase1 = find_feasible_point(integers.n, integers.n, integers.entries);
  for (std::size_t i = 0; i < phase1.x.size(); ++i) phase1.x[i] *= integers.z_unit[i];
  return {phase1.status, to_text(phase1.x), to_text(in_units(std::move(phase1.y), integers))};
}

}  // namespace tumble
