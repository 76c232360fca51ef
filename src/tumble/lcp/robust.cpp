#include "tumble/lcp/robust.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tumble/lcp/enumerate.hpp"
#include "tumble/lcp/exact.hpp"
#include "tumble/lcp/infeasibility.hpp"
#include "tumble/lcp/numerical_rungs.hpp"
#include "tumble/lcp/require.hpp"
#include "tumble/lcp/rung.hpp"
#include "tumble/lcp/solve.hpp"

namespace tumble {
namespace {

constexpr std::size_t k_max_exact_rung_size = 24;  // above, the integers grow too long for a step's time

// Without rounding, for problems where the last bits matter: what it finds is rounded to doubles and judged as all
// else. In equilibrated numbers, so that its way does not depend on units.
void try_exact(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace) {
  LcpWorkspace::Buffers& buffers = workspace.buffers();
  if (problem.size() > k_max_exact_rung_size) return;
  const auto is_finite = [](const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
  };
  const LcpProblem scaled{buffers.scaled.M, buffers.scaled.q, {}};
  if (!is_finite(scaled.M) || !is_finite(scaled.q) || !is_within_exact_limits(scaled)) return;
  LcpResult& result = workspace.result;
  LcpResult found = exact_lemke(scaled);
  result.rung = LcpRung::exact;
  result.pivots += found.pivots;
  if (found.status == LcpStatus::solved) {
    unscale(buffers.scaled, found.z, buffers.z);
    result.basis = found.basis;
    offer(problem, settings, workspace);
  } else if (found.status == LcpStatus::infeasible) {
    std::vector<double>& y = found.certificate;
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = scaled_by(y[i], buffers.scaled.w_exponent[i]);
    if (!is_infeasibility_certificate(problem, y)) return;
    result.status = LcpStatus::infeasible;
    result.certificate = std::move(y);
  }
}

void try_enumerate(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace) {
  if (problem.size() > k_max_enumerate_size) return;
  LcpResult& result = workspace.result;
  const LcpResult found = enumerate(problem, {settings.accepted_residual});
  result.pivots += found.pivots;
  result.rung = LcpRung::enumerate;
  if (found.status == LcpStatus::solved) {
    workspace.buffers().z = found.z;
    result.basis = found.basis;
    offer(problem, settings, workspace);
  } else if (found.status == LcpStatus::no_solution_proved) {
    result.status = LcpStatus::no_solution_proved;
    result.certificate.clear();
  }
}

constexpr std::array<Rung, 8> k_ladder = {try_warm_start, try_lemke, try_lemke_lu, try_infeasible,
                                          try_lemke_quad, try_ridge, try_exact,    try_enumerate};

// Rows of unknown sizes: each is judged by its own terms alone first. What satisfies that satisfies every size.
bool climb_strictly(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace) {
  LcpWorkspace::Buffers& buffers = workspace.buffers();
  std::swap(buffers.row_sizes.round_off, buffers.other_sizes);
  buffers.row_sizes.round_off.assign(problem.size(), 0.0);
  const bool is_done = climb(k_ladder, problem, settings, workspace);
  std::swap(buffers.row_sizes.round_off, buffers.other_sizes);
  if (workspace.result.z.empty()) return is_done;
  // The residual reported is that of `residual`.
  buffers.z = workspace.result.z;
  workspace.result.z.clear();
  judge_candidate(problem, workspace);
  return is_done;
}

}  // namespace

void validate(const RobustSettings& settings) { require_accepted_residual(settings.accepted_residual); }

void run_robust(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace) {
  LcpWorkspace::Buffers& buffers = workspace.buffers();
  start(problem, workspace);
  if (solve_trivially(problem, workspace)) return;
  if (buffers.has_contacts && climb_contacts(problem, settings, workspace)) return;
  scale(problem, buffers.scaled);
  if (buffers.row_sizes.is_guess && climb_strictly(problem, settings, workspace)) return;
  climb(k_ladder, problem, settings, workspace);
}

LcpResult robust(const LcpProblem& problem, const RobustSettings& settings) { return solve_lcp(problem, settings); }

}  // namespace tumble
