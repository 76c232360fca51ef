#include "tumble/lcp/rung.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace tumble {

LcpWorkspace::LcpWorkspace() : buffers_(std::make_unique<Buffers>()) {}
LcpWorkspace::~LcpWorkspace() = default;
LcpWorkspace::LcpWorkspace(LcpWorkspace&&) noexcept = default;
LcpWorkspace& LcpWorkspace::operator=(LcpWorkspace&&) noexcept = default;

void start(const LcpProblem& problem, LcpWorkspace& workspace) {
  LcpWorkspace::Buffers& buffers = workspace.buffers();
  buffers.has_contacts = find_row_sizes(problem, buffers.contacts, buffers.scaled.scales, buffers.row_sizes);
  LcpResult& result = workspace.result;
  result.status = LcpStatus::numerical;
  result.z.clear();
  result.w.clear();
  result.z.reserve(problem.size());  // they change places with those of candidates
  result.w.reserve(problem.size());
  result.residual = std::numeric_limits<double>::infinity();
  result.parts = {result.residual, result.residual, result.residual};
  result.pivots = 0;
  result.refactorisations = 0;
  result.rung = LcpRung::none;
  result.basis.assign(problem.size(), 0);
  result.certificate.clear();
}

void prepare(const LcpProblem& problem, LcpWorkspace& workspace) {
  start(problem, workspace);
  scale(problem, workspace.buffers().scaled);
}

bool solve_trivially(const LcpProblem& problem, LcpWorkspace& workspace) {
  if (std::any_of(problem.q.begin(), problem.q.end(), [](double x) { return !(x >= 0.0); })) return false;
  LcpResult& result = workspace.result;
  result.status = LcpStatus::solved;
  result.z.assign(problem.size(), 0.0);
  result.w = problem.q;
  result.residual = 0.0;
  result.parts = {};
  return true;
}

void judge_candidate(const LcpProblem& problem, LcpWorkspace& workspace) {
  LcpWorkspace::Buffers& buffers = workspace.buffers();
  LcpResult& result = workspace.result;
  const LcpResidual parts = judge(problem, buffers.row_sizes, buffers.z, buffers.w, buffers.judge);
  if (!result.z.empty() && !(parts.largest() < result.residual)) return;
  result.parts = parts;
  result.residual = parts.largest();
  std::swap(result.z, buffers.z);
  std::swap(result.w, buffers.w);
}

void conclude(LcpStatus status, double accepted_residual, LcpResult& result) {
  result.status = status == LcpStatus::solved ? LcpStatus::numerical : status;
  if (!(result.residual <= accepted_residual)) return;
  result.status = LcpStatus::solved;
  result.certificate.clear();
}

bool solve_basis(const std::vector<std::uint8_t>& basis, LcpWorkspace::Buffers& buffers, double tolerance) {
  const ScaledProblem& problem = buffers.scaled;
  buffers.z_scaled.assign(problem.size(), 0.0);
  std::vector<std::size_t>& rows = buffers.basic_rows;
  rows.clear();
  for (std::size_t i = 0; i < basis.size(); ++i) {
    if (basis[i]) rows.push_back(i);
  }
  const std::size_t k = rows.size();
  std::vector<double>& entries = buffers.lu.start(k);
  buffers.right.resize(k);
  buffers.solution.resize(k);
  for (std::size_t i = 0; i < k; ++i) {
    for (std::size_t j = 0; j < k; ++j) entries[i * k + j] = problem(rows[i], rows[j]);
    buffers.right[i] = -problem.q[rows[i]];
  }
  if (!buffers.lu.factor(tolerance)) return false;
  buffers.lu.solve(buffers.right.data(), buffers.solution.data());
  for (std::size_t i = 0; i < k; ++i) buffers.z_scaled[rows[i]] = buffers.solution[i];
  return true;
}

}  // namespace tumble
