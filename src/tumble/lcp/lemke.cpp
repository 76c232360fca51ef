#include "tumble/lcp/lemke.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tumble/lcp/require.hpp"
#include "tumble/lcp/rung.hpp"
#include "tumble/lcp/solve.hpp"

namespace tumble {
namespace {

// How the pivots ended, before the residual has its say.
struct PivotOutcome {
  LcpStatus status;
  int pivots;
};

// `on_pivot(entering, leaving)` is called after every pivot.
template <class OnPivot>
PivotOutcome run_pivots(Tableau& tableau, double pivot_tolerance, bool has_ties, int max_pivots, OnPivot on_pivot) {
  int entering = tableau.z0();
  tableau.enter(entering);
  int leaving = tableau.pivot(tableau.row_of_smallest_value());
  on_pivot(entering, leaving);
  for (int pivots = 1; pivots < max_pivots; ++pivots) {
    entering = tableau.complement_of(leaving);
    tableau.enter(entering);
    const auto row = tableau.blocking_row(pivot_tolerance, has_ties);
    if (!row) return {LcpStatus::ray_unproven, pivots};
    leaving = tableau.pivot(*row);
    on_pivot(entering, leaving);
    if (leaving == tableau.z0()) return {LcpStatus::solved, pivots + 1};
  }
  return {LcpStatus::iteration_limit, max_pivots};
}

template <class OnPivot>
void walk(const LcpProblem& problem, const LemkeSettings& settings, bool has_ties, LcpWorkspace& workspace,
          OnPivot on_pivot) {
  LcpWorkspace::Buffers& buffers = workspace.buffers();
  LcpResult& result = workspace.result;
  Tableau& tableau = buffers.tableau;
  tableau.start(buffers.scaled);
  const int max_pivots = settings.max_pivots > 0 ? settings.max_pivots : 100 * static_cast<int>(problem.size()) + 1000;
  const PivotOutcome outcome = run_pivots(tableau, settings.pivot_tolerance, has_ties, max_pivots, on_pivot);
  result.pivots += outcome.pivots;
  tableau.basic_z(result.basis);

  // z solved for anew from its basis is free of the tableau's rounding; only where that is not as good as round-off of
  // a few operations, the tableau's own values are looked at as well.
  constexpr double round_off = 1e-14;
  ++result.refactorisations;
  if (solve_basis(result.basis, buffers)) {
    unscale(buffers.scaled, buffers.z_scaled, buffers.z);
    judge_candidate(problem, workspace);
  }
  if (!(result.residual <= round_off)) {
    tableau.z_values(buffers.z_scaled);
    unscale(buffers.scaled, buffers.z_scaled, buffers.z);
    judge_candidate(problem, workspace);
  }
  conclude(outcome.status, settings.accepted_residual, result);
}

template <class OnPivot>
void run_lemke(const LcpProblem& problem, const LemkeSettings& settings, LcpWorkspace& workspace, OnPivot on_pivot) {
  LcpWorkspace::Buffers& buffers = workspace.buffers();
  LcpResult& result = workspace.result;
  result.rung = LcpRung::lemke;
  walk(problem, settings, true, workspace, on_pivot);
  // What is round-off beside a large value can be all there is of a small one: a tie may have ended the walk one pivot
  // too early.
  if (result.status == LcpStatus::numerical) walk(problem, settings, false, workspace, on_pivot);
  if (result.status == LcpStatus::ray_unproven) {
    buffers.tableau.z_direction(buffers.z_scaled);
    unscale(buffers.scaled, buffers.z_scaled, result.certificate);
  }
}

std::vector<double> textbook_tableau(const ScaledProblem& problem, const Tableau& tableau) {
  const int n = static_cast<int>(problem.size());
  // A variable's value in the units shown is its scaled value times 2^exponent.
  const int z0_exponent = -*std::min_element(problem.w_exponent.begin(), problem.w_exponent.end());
  const auto exponent = [&](int variable) {
    return variable < n       ? -problem.w_exponent[variable]
           : variable < 2 * n ? problem.z_exponent[variable - n]
                              : z0_exponent;
  };
  std::vector<double> entries;
  for (int i = 0; i < n; ++i) {
    const int of_row = exponent(tableau.basic(i));
    for (int j = 0; j <= 2 * n; ++j) entries.push_back(std::ldexp(tableau.entry(i, j), of_row - exponent(j)));
    entries.push_back(std::ldexp(tableau.value(i), of_row));
  }
  return entries;
}

}  // namespace

void validate(const LemkeSettings& settings) {
  require(settings.max_pivots >= 0, "max_pivots", ">= 0", settings.max_pivots);
  require(settings.pivot_tolerance >= 0.0 && settings.pivot_tolerance < 1.0, "pivot_tolerance", "in [0, 1)",
          settings.pivot_tolerance);
  require_accepted_residual(settings.accepted_residual);
}

void run_lemke(const LcpProblem& problem, const LemkeSettings& settings, LcpWorkspace& workspace) {
  run_lemke(problem, settings, workspace, [](int, int) {});
}

LcpResult lemke(const LcpProblem& problem, const LemkeSettings& settings) { return solve_lcp(problem, settings); }

LemkeTrace trace_lemke(const LcpProblem& problem, const LemkeSettings& settings) {
  validate(problem);
  validate(settings);
  LcpWorkspace workspace;
  LemkeTrace trace;
  const auto write_down = [&](int entering, int leaving) {
    const Tableau& tableau = workspace.buffers().tableau;
    LemkePivot& pivot = trace.pivots.emplace_back();
    pivot.entering = entering;
    pivot.leaving = leaving;
    for (int i = 0; i < static_cast<int>(problem.size()); ++i) pivot.basis.push_back(tableau.basic(i));
    pivot.tableau = textbook_tableau(workspace.buffers().scaled, tableau);
  };
  prepare(problem, workspace);
  if (!solve_trivially(problem, workspace)) run_lemke(problem, settings, workspace, write_down);
  Tableau& tableau = workspace.buffers().tableau;
  tableau.start(workspace.buffers().scaled);
  trace.start = textbook_tableau(workspace.buffers().scaled, tableau);
  trace.result = std::move(workspace.result);
  return trace;
}

}  // namespace tumble
