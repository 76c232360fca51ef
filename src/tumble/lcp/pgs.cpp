#include "tumble/lcp/pgs.hpp"

#include <algorithm>

#include "tumble/lcp/require.hpp"
#include "tumble/lcp/rung.hpp"
#include "tumble/lcp/solve.hpp"

namespace tumble {
namespace {

constexpr int k_sweeps_per_check = 10;

void sweep(const LcpProblem& problem, double relaxation, std::vector<double>& z) {
  const std::size_t n = problem.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double* row = problem.M.data() + i * n;
    double w_i = problem.q[i];
    for (std::size_t j = 0; j < n; ++j) w_i += row[j] * z[j];
    z[i] = std::max(z[i] - relaxation * w_i / row[i], 0.0);
  }
}

}  // namespace

void validate(const PgsSettings& settings) {
  require(settings.max_sweeps >= 1, "max_sweeps", ">= 1", settings.max_sweeps);
  require(settings.relaxation > 0.0 && settings.relaxation < 2.0, "relaxation", "in (0, 2)", settings.relaxation);
  require_accepted_residual(settings.accepted_residual);
  require_nonnegative(settings.start_z, "start_z");
}

void run_pgs(const LcpProblem& problem, const PgsSettings& settings, LcpWorkspace& workspace) {
  LcpWorkspace::Buffers& buffers = workspace.buffers();
  LcpResult& result = workspace.result;
  result.rung = LcpRung::pgs;
  const std::size_t n = problem.size();
  std::vector<double>& z = buffers.values;
  z.assign(n, 0.0);
  std::copy(settings.start_z.begin(), settings.start_z.end(), z.begin());
  bool has_diagonal = true;
  for (std::size_t i = 0; i < n; ++i) has_diagonal = has_diagonal && problem(i, i) > 0.0;
  for (;;) {
    buffers.z = z;
    judge_candidate(problem, workspace);
    if (result.residual <= settings.accepted_residual || !has_diagonal || result.pivots == settings.max_sweeps) break;
    const int count = std::min(k_sweeps_per_check, settings.max_sweeps - result.pivots);
    for (int i = 0; i < count; ++i) sweep(problem, settings.relaxation, z);
    result.pivots += count;
  }
  for (std::size_t i = 0; i < n; ++i) result.basis[i] = result.z[i] > 0.0;
  result.status = has_diagonal ? LcpStatus::iteration_limit : LcpStatus::numerical;
  if (result.residual <= settings.accepted_residual) result.status = LcpStatus::solved;
}

LcpResult pgs(const LcpProblem& problem, const PgsSettings& settings) { return solve_lcp(problem, settings); }

}  // namespace tumble
