#include "tumble/lcp/lemke_lu.hpp"

#include <algorithm>
#include <utility>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "tumble/lcp/lu_basis.hpp"
#include "tumble/lcp/require.hpp"
#include "tumble/lcp/rung.hpp"

namespace tumble {
namespace {

using Quad = boost::multiprecision::cpp_bin_float_quad;

template <class Real>
struct Walk {
  LuBasis<Real>& basis;
  double pivot_tolerance;
  int max_pivots;
  std::vector<Real> x, d;
  int pivots = 0;
  int factorisations = 0;

  static Real round_off() { return Real(256) * std::numeric_limits<Real>::epsilon(); }

  bool factor() {
    ++factorisations;
    return basis.factor();
  }

  Real largest(const std::vector<Real>& values) const {
    using std::abs;
    Real size(0);
    for (const Real& value : values) size = abs(value) > size ? abs(value) : size;
    return size;
  }

  int most_negative() const {
    int variable = LuBasis<Real>::k_none;
    for (int i = 0; i < basis.z0(); ++i) {
      if (x[i] < Real(0) && (variable < 0 || x[i] < x[variable])) variable = i;
    }
    return variable;
  }

  // The basic variable that first reaches 0 along d; ties go to z0, else to the largest pivot.
  int blocking_variable() const {
    const Real smallest_pivot = Real(pivot_tolerance) * largest(d);
    const Real error = round_off() * largest(x);
    Real step(0);
    int blocking = LuBasis<Real>::k_none;
    const auto value = [&](int i) { return x[i] > Real(0) ? x[i] : Real(0); };
    for (int i = 0; i <= basis.z0(); ++i) {
      if (!basis.is_basic(i) || !(-d[i] > smallest_pivot)) continue;
      const Real ratio = value(i) / -d[i];
      if (blocking < 0 || ratio < step) {
        blocking = i;
        step = ratio;
      }
    }
    if (blocking < 0) return blocking;
    const Real limit = step + error / -d[blocking];
    for (int i = basis.z0(); i >= 0; --i) {
      if (!basis.is_basic(i) || !(-d[i] > smallest_pivot)) continue;
      if (value(i) > limit * -d[i] + error) continue;
      if (i == basis.z0()) return i;
      if (d[i] < d[blocking]) blocking = i;
    }
    return blocking;
  }

  // From a complementary basis to one without a negative value.
  LcpStatus run() {
    if (!factor()) return LcpStatus::numerical;
    basis.values(x);
    int leaving = most_negative();
    if (leaving < 0) return LcpStatus::solved;
    int entering = basis.z0();
    for (;; ++pivots) {
      if (pivots >= max_pivots) return LcpStatus::iteration_limit;
      basis.exchange(entering, leaving);
      if (!factor()) return LcpStatus::numerical;
      if (leaving == basis.z0()) {
        ++pivots;
        return LcpStatus::solved;
      }
      basis.values(x);
      entering = basis.complement_of(leaving);
      basis.direction(entering, d);
      leaving = blocking_variable();
      if (leaving < 0) return LcpStatus::ray_unproven;
    }
  }
};

template <class Real>
LcpStatus walk(const LcpProblem& problem, const LemkeLuSettings& settings, LcpWorkspace& workspace,
               LuBasis<Real>& basis) {
  LcpWorkspace::Buffers& buffers = workspace.buffers();
  LcpResult& result = workspace.result;
  const auto n = problem.size();
  const int max_pivots = settings.max_pivots > 0 ? settings.max_pivots : 10 * static_cast<int>(n) + 100;
  basis.start(buffers.scaled, settings.ridge, settings.start_basis);
  Walk<Real> walk{basis, settings.pivot_tolerance, max_pivots, {}, {}};
  const LcpStatus status = walk.run();
  result.pivots += walk.pivots;
  result.refactorisations += walk.factorisations;
  result.basis = basis.basic_z();
  if (status == LcpStatus::solved) basis.values(walk.x);
  buffers.z_scaled.assign(n, 0.0);
  for (std::size_t i = 0; i < n && !walk.x.empty(); ++i) buffers.z_scaled[i] = static_cast<double>(walk.x[n + i]);
  unscale(buffers.scaled, buffers.z_scaled, buffers.z);
  judge_candidate(problem, workspace);
  if (status == LcpStatus::ray_unproven) {
    for (std::size_t i = 0; i < n; ++i) buffers.z_scaled[i] = static_cast<double>(walk.d[n + i]);
    unscale(buffers.scaled, buffers.z_scaled, result.certificate);
  }
  return status;
}

}  // namespace

void validate(const LemkeLuSettings& settings) {
  require(settings.max_pivots >= 0, "max_pivots", ">= 0", settings.max_pivots);
  require(settings.pivot_tolerance >= 0.0 && settings.pivot_tolerance < 1.0, "pivot_tolerance", "in [0, 1)",
          settings.pivot_tolerance);
  require_accepted_residual(settings.accepted_residual);
  require(settings.ridge >= 0.0 && settings.ridge <= 1e-6, "ridge", "in [0, 1e-6]", settings.ridge);
}

void run_lemke_lu(const LcpProblem& problem, const LemkeLuSettings& settings, LcpWorkspace& workspace) {
  LcpResult& result = workspace.result;
  const bool is_quad = settings.precision == Precision::quad_precision;
  result.rung = settings.ridge > 0.0 ? LcpRung::ridge : is_quad ? LcpRung::lemke_quad : LcpRung::lemke_lu;
  LcpStatus status = LcpStatus::numerical;
  if (is_quad) {
    LuBasis<Quad> basis;
    status = walk(problem, settings, workspace, basis);
  } else {
    status = walk(problem, settings, workspace, workspace.buffers().lu_basis);
  }
  result.status = status == LcpStatus::solved ? LcpStatus::numerical : status;
  if (result.residual <= settings.accepted_residual) {
    result.status = LcpStatus::solved;
    result.certificate.clear();
  }
}

LcpResult lemke_lu(const LcpProblem& problem, const LemkeLuSettings& settings) {
  validate(problem);
  validate(settings);
  require_start_basis(settings.start_basis, problem.size());
  LcpWorkspace workspace;
  solve_prepared(problem, settings, workspace, run_lemke_lu);
  return std::move(workspace.result);
}

}  // namespace tumble
