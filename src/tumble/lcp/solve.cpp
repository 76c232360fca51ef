#include "tumble/lcp/solve.hpp"

#include <limits>
#include <stdexcept>
#include <utility>

#include "tumble/lcp/require.hpp"
#include "tumble/lcp/rung.hpp"
#include "tumble/lcp/sparse_lu.hpp"

namespace tumble {
namespace {

void run(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace) {
  require_start_basis(settings.start_basis, problem.size());
  run_robust(problem, settings, workspace);
}

void run(const LcpProblem& problem, const EnumerateSettings& settings, LcpWorkspace& workspace) {
  workspace.result = enumerate(problem, settings);
}

void run(const LcpProblem& problem, const LemkeSettings& settings, LcpWorkspace& workspace) {
  solve_prepared(problem, settings, workspace, run_lemke);
}

void run(const LcpProblem& problem, const LemkeLuSettings& settings, LcpWorkspace& workspace) {
  require_start_basis(settings.start_basis, problem.size());
  solve_prepared(problem, settings, workspace, run_lemke_lu);
}

void run(const LcpProblem& problem, const MurtySettings& settings, LcpWorkspace& workspace) {
  solve_prepared(problem, settings, workspace, run_murty);
}

void run(const LcpProblem& problem, const DantzigSettings& settings, LcpWorkspace& workspace) {
  solve_prepared(problem, settings, workspace, run_dantzig);
}

void run(const LcpProblem& problem, const NewtonSettings& settings, LcpWorkspace& workspace) {
  solve_prepared(problem, settings, workspace, run_newton);
}

void run(const LcpProblem& problem, const PgsSettings& settings, LcpWorkspace& workspace) {
  require_start_z(settings.start_z, problem.size());
  solve_unscaled(problem, settings, workspace, run_pgs);
}

void run(const LcpProblem& problem, const NlgsSettings& settings, LcpWorkspace& workspace) {
  require_start_z(settings.start_z, problem.size());
  solve_unscaled(problem, settings, workspace, run_nlgs);
}

}  // namespace

void validate(const LcpSettings& settings) {
  std::visit([](const auto& chosen) { validate(chosen); }, settings);
}

LcpResult solve_lcp(const LcpProblem& problem, const LcpSettings& settings) {
  validate(problem);
  validate(settings);
  LcpWorkspace workspace;
  workspace.buffers().lu_basis.allow_sparse(make_sparse_lu);
  std::visit([&](const auto& chosen) { run(problem, chosen, workspace); }, settings);
  return std::move(workspace.result);
}

const LcpResult& solve_lcp(const LcpProblem& problem, const LcpSettings& settings, LcpWorkspace& workspace) {
  validate(settings);
  workspace.buffers().lu_basis.allow_sparse(make_sparse_lu);
  try {
    validate(problem);
    std::visit([&](const auto& chosen) { run(problem, chosen, workspace); }, settings);
  } catch (const std::invalid_argument&) {
    workspace.result = LcpResult();
    workspace.result.status = LcpStatus::bad_input;
    workspace.result.residual = std::numeric_limits<double>::infinity();
  }
  return workspace.result;
}

}  // namespace tumble
