#include "tumble/lcp/robust.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "tumble/lcp/enumerate.hpp"
#include "tumble/lcp/rung.hpp"

namespace tumble {
namespace {

constexpr std::size_t k_max_quad_size = 100;  // above, one solve with 113 bits takes minutes
constexpr std::size_t k_max_tableau_size = 1000;

// One step of the ladder: improves workspace.result, or leaves it.
using Rung = void (*)(const LcpProblem&, const RobustSettings&, LcpWorkspace&);

void try_warm_start(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace) {
  if (settings.start_basis.empty()) return;
  LcpResult& result = workspace.result;
  result.rung = LcpRung::warm_start;
  result.basis = settings.start_basis;
  ++result.refactorisations;
  if (!solve_basis(result.basis, workspace.buffers())) return;
  unscale(workspace.buffers().scaled, workspace.buffers().z_scaled, workspace.buffers().z);
  judge_candidate(problem, workspace);
  if (result.residual <= settings.accepted_residual) result.status = LcpStatus::solved;
}

void try_lemke(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace) {
  const int n = static_cast<int>(problem.size());
  if (problem.size() > k_max_tableau_size) return;
  run_lemke(problem, {.max_pivots = 10 * n + 100, .accepted_residual = settings.accepted_residual}, workspace);
}

void try_lemke_lu(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace) {
  run_lemke_lu(problem, {.accepted_residual = settings.accepted_residual}, workspace);
}

void try_lemke_quad(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace) {
  if (problem.size() > k_max_quad_size) return;
  run_lemke_lu(problem,
               {.pivot_tolerance = 1e-20,
                .accepted_residual = settings.accepted_residual,
                .precision = Precision::quad_precision},
               workspace);
}

void try_ridge(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace) {
  if (problem.size() > k_max_quad_size) return;
  for (const double ridge : {1e-14, 1e-13}) {
    run_lemke_lu(problem,
                 {.pivot_tolerance = 1e-20,
                  .accepted_residual = settings.accepted_residual,
                  .precision = Precision::quad_precision,
                  .ridge = ridge},
                 workspace);
    if (workspace.result.status == LcpStatus::solved) return;
  }
}

void try_enumerate(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace) {
  if (problem.size() > k_max_enumerate_size) return;
  LcpResult& result = workspace.result;
  LcpResult found = enumerate(problem, {settings.accepted_residual});
  found.pivots += result.pivots;
  found.refactorisations += result.refactorisations;
  if (found.status == LcpStatus::solved) {
    workspace.buffers().z = found.z;
    judge_candidate(problem, workspace);
    result.rung = LcpRung::enumerate;
    result.basis = found.basis;
    if (result.residual <= settings.accepted_residual) result.status = LcpStatus::solved;
  } else if (found.status == LcpStatus::no_solution_proved) {
    result = std::move(found);
  }
}

constexpr std::array<Rung, 6> k_ladder = {try_warm_start, try_lemke, try_lemke_lu,
                                          try_lemke_quad, try_ridge, try_enumerate};

void climb(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace) {
  for (const Rung rung : k_ladder) {
    rung(problem, settings, workspace);
    if (workspace.result.status == LcpStatus::solved) return;
  }
}

}  // namespace

void validate(const RobustSettings& settings) {
  if (!(settings.accepted_residual > 0.0 && settings.accepted_residual <= k_largest_accepted_residual)) {
    throw std::invalid_argument(fmt::format("accepted_residual: must be in (0, {}], got {}",
                                            k_largest_accepted_residual, settings.accepted_residual));
  }
}

void run_robust(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace) {
  prepare(problem, workspace);
  if (solve_trivially(problem, workspace)) return;
  climb(problem, settings, workspace);
}

LcpResult robust(const LcpProblem& problem, const RobustSettings& settings) {
  validate(problem);
  validate(settings);
  LcpWorkspace workspace;
  run_robust(problem, settings, workspace);
  return std::move(workspace.result);
}

}  // namespace tumble
