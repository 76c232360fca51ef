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
  int max_exchanges;
  std::vector<Real> x,
      y;  // of the basic variables, slot by slot: values, and what they lose while `entering` grows by 1
  int entering = LuBasis<Real>::k_none;
  int pivots = 0;
  int factorisations = 0;

  static Real round_off() { return Real(256) * std::numeric_limits<Real>::epsilon(); }

  // Factors and values of the basis as it is now. False if it is singular.
  bool refresh() {
    ++factorisations;
    if (!basis.factor()) return false;
    basis.values(x);
    return true;
  }

  static Real largest(const std::vector<Real>& values) {
    using std::abs;
    Real size(0);
    for (const Real& value : values) size = abs(value) > size ? Real(abs(value)) : size;
    return size;
  }

  int most_negative_slot() const {
    int slot = LuBasis<Real>::k_none;
    for (int i = 0; i < static_cast<int>(x.size()); ++i) {
      if (x[i] < Real(0) && (slot < 0 || x[i] < x[slot])) slot = i;
    }
    return slot;
  }

  // The slot whose variable first reaches 0; ties go to z0, else to the largest pivot.
  int blocking_slot() const {
    const int n = static_cast<int>(x.size());
    const Real smallest_pivot = Real(pivot_tolerance) * largest(y);
    const Real error = round_off() * largest(x);
    const auto value = [&](int i) { return x[i] > Real(0) ? x[i] : Real(0); };
    Real step(0);
    int blocking = LuBasis<Real>::k_none;
    for (int i = 0; i < n; ++i) {
      if (!(y[i] > smallest_pivot)) continue;
      const Real ratio = value(i) / y[i];
      if (blocking < 0 || ratio < step) {
        blocking = i;
        step = ratio;
      }
    }
    if (blocking < 0) return blocking;
    const Real limit = step + error / y[blocking];
    for (int i = 0; i < n; ++i) {
      if (!(y[i] > smallest_pivot) || value(i) > limit * y[i] + error) continue;
      if (basis.variable(i) == basis.z0()) return i;
      if (y[i] > y[blocking]) blocking = i;
    }
    return blocking;
  }

  // The direction of `entering`, from fresh factors where the old ones have lost digits.
  bool find_direction() {
    const Real accepted = Real(64) * round_off();
    if (basis.num_exchanges() >= max_exchanges && basis.num_exchanges() > 0 && !refresh()) return false;
    if (basis.direction(entering, y) <= accepted || basis.num_exchanges() == 0) return true;
    if (!refresh()) return false;
    basis.direction(entering, y);
    return true;
  }

  void pivot(int slot) {
    const Real step = x[slot] / y[slot];
    for (std::size_t i = 0; i < x.size(); ++i) x[i] -= step * y[i];
    x[slot] = step;
    basis.exchange(entering, slot, y);
    ++pivots;
  }

  // From a complementary basis to one without a negative value.
  LcpStatus run() {
    if (!refresh()) return LcpStatus::numerical;
    int slot = most_negative_slot();
    if (slot < 0) return LcpStatus::solved;
    entering = basis.z0();
    basis.direction(entering, y);
    for (;;) {
      if (pivots >= max_pivots) return LcpStatus::iteration_limit;
      const int leaving = basis.variable(slot);
      pivot(slot);
      if (leaving == basis.z0()) return refresh() ? LcpStatus::solved : LcpStatus::numerical;
      entering = basis.complement_of(leaving);
      if (!find_direction()) return LcpStatus::numerical;
      slot = blocking_slot();
      if (slot < 0) return LcpStatus::ray_unproven;
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
  basis.start(buffers.scaled, settings.ridge, settings.start_basis, settings.cover);
  Walk<Real> walk{basis, settings.pivot_tolerance, max_pivots, settings.max_exchanges, {}, {}};
  const LcpStatus status = walk.run();
  result.pivots += walk.pivots;
  result.refactorisations += walk.factorisations;
  for (std::size_t i = 0; i < n; ++i) result.basis[i] = basis.is_basic(static_cast<int>(n + i));
  basis.z_part(walk.x, buffers.z_scaled);
  unscale(buffers.scaled, buffers.z_scaled, buffers.z);
  judge_candidate(problem, workspace);
  if (status == LcpStatus::ray_unproven) {
    basis.z_direction(walk.entering, walk.y, buffers.z_scaled);
    unscale(buffers.scaled, buffers.z_scaled, result.certificate);
  }
  return status;
}

}  // namespace

void validate(const LemkeLuSettings& settings) {
  require(settings.max_pivots >= 0, "max_pivots", ">= 0", settings.max_pivots);
  require(settings.pivot_tolerance >= 0.0 && settings.pivot_tolerance < 1.0, "pivot_tolerance", "in [0, 1)",
          settings.pivot_tolerance);
  require(settings.max_exchanges >= 0, "max_exchanges", ">= 0", settings.max_exchanges);
  require(settings.cover >= 0, "cover", ">= 0", settings.cover);
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
