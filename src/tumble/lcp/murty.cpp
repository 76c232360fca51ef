#include "tumble/lcp/murty.hpp"

#include <algorithm>
#include <cmath>

#include "tumble/lcp/require.hpp"
#include "tumble/lcp/rung.hpp"
#include "tumble/lcp/solve.hpp"

namespace tumble {
namespace {

// A negative value counts if cutting it off would be more than round-off in some row, beside the terms summed there.
constexpr double k_round_off = 1e-13;

// w of buffers.z_scaled, and the size of the terms in each row.
void find_w(const LcpProblem& problem, LcpWorkspace::Buffers& buffers) {
  const ScaledProblem& scaled = buffers.scaled;
  const std::size_t n = problem.size();
  buffers.w_scaled.resize(n);
  buffers.w_terms.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    double sum = scaled.q[i];
    double terms = std::abs(scaled.q[i]) + scaled_by(buffers.row_sizes.round_off[i], scaled.w_exponent[i]);
    for (std::size_t j = 0; j < n; ++j) {
      const double term = scaled(i, j) * buffers.z_scaled[j];
      sum += term;
      terms += std::abs(term);
    }
    buffers.w_scaled[i] = sum;
    buffers.w_terms[i] = terms;
  }
}

bool is_negative(const std::vector<std::uint8_t>& basis, std::size_t i, const LcpWorkspace::Buffers& buffers) {
  if (!basis[i]) return buffers.w_scaled[i] < -k_round_off * buffers.w_terms[i];
  const double z_i = buffers.z_scaled[i];
  if (!(z_i < 0.0)) return false;
  for (std::size_t j = 0; j < basis.size(); ++j) {
    if (std::abs(buffers.scaled(j, i) * z_i) > k_round_off * buffers.w_terms[j]) return true;
  }
  return false;
}

// A P-matrix needs at most 2^n - 1.
int default_max_pivots(std::size_t n) {
  const int limit = 100 * static_cast<int>(n) + 10000;
  return n < 14 ? std::min(1 << n, limit) : limit;
}

// Changes the basis until no variable is negative; buffers.z_scaled belongs to it in the end.
LcpStatus run_pivots(const LcpProblem& problem, int max_pivots, LcpWorkspace& workspace) {
  LcpWorkspace::Buffers& buffers = workspace.buffers();
  LcpResult& result = workspace.result;
  std::vector<std::uint8_t>& basis = result.basis;
  const std::size_t n = problem.size();
  buffers.z_scaled.assign(n, 0.0);
  for (int pivots = 0;; ++pivots) {
    find_w(problem, buffers);
    std::size_t i = 0;
    while (i < n && !is_negative(basis, i, buffers)) ++i;
    if (i == n) return LcpStatus::solved;
    if (pivots == max_pivots) return LcpStatus::iteration_limit;
    basis[i] = !basis[i];
    ++result.refactorisations;
    if (!solve_basis(basis, buffers, k_singular)) {
      basis[i] = !basis[i];
      solve_basis(basis, buffers);
      return LcpStatus::numerical;
    }
    ++result.pivots;
  }
}

}  // namespace

void validate(const MurtySettings& settings) {
  require(settings.max_pivots >= 0, "max_pivots", ">= 0", settings.max_pivots);
  require_accepted_residual(settings.accepted_residual);
}

void run_murty(const LcpProblem& problem, const MurtySettings& settings, LcpWorkspace& workspace) {
  LcpWorkspace::Buffers& buffers = workspace.buffers();
  LcpResult& result = workspace.result;
  result.rung = LcpRung::murty;
  const int max_pivots = settings.max_pivots > 0 ? settings.max_pivots : default_max_pivots(problem.size());
  const LcpStatus status = run_pivots(problem, max_pivots, workspace);
  unscale(buffers.scaled, buffers.z_scaled, buffers.z);
  judge_candidate(problem, workspace);
  conclude(status, settings.accepted_residual, result);
}

LcpResult murty(const LcpProblem& problem, const MurtySettings& settings) { return solve_lcp(problem, settings); }

}  // namespace tumble
