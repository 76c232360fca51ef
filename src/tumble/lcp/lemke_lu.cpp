#include "tumble/lcp/lemke_lu.hpp"

#include <algorithm>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "tumble/lcp/lu_basis.hpp"
#include "tumble/lcp/require.hpp"
#include "tumble/lcp/rung.hpp"
#include "tumble/lcp/solve.hpp"

namespace tumble {
namespace {

using Quad = boost::multiprecision::cpp_bin_float_quad;

template <class Real>
struct Walk {
  LuBasis<Real>& basis;
  double pivot_tolerance;
  int max_pivots;
  int max_exchanges;
  bool has_ties;         // values that differ by no more than round-off tie, and the largest pivot decides
  std::vector<Real>& x;  // of the basic variables, slot by slot: their values,
  std::vector<Real>& y;  // and what they lose while `entering` grows by 1
  int entering = LuBasis<Real>::k_none;
  int pivots = 0;
  int factorisations = 0;

  // Of a value after some dozen pivots on one factorisation.
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

  // While z0 falls from where all values are >= 0: the slot whose variable is the first to become negative. Here x and
  // y are those at z0 = 0, where z0 is to enter.
  int first_negative_slot() const {
    int slot = LuBasis<Real>::k_none;
    for (int i = 0; i < static_cast<int>(x.size()); ++i) {
      if (x[i] < Real(0) && y[i] < Real(0) && (slot < 0 || x[i] / y[i] > x[slot] / y[slot])) slot = i;
    }
    return slot;
  }

  // The slot whose variable first reaches 0; ties go to z0, else to the largest pivot.
  int blocking_slot() const {
    const int n = static_cast<int>(x.size());
    const Real smallest_pivot = Real(pivot_tolerance) * largest(y);
    const Real error = has_ties ? Real(round_off() * largest(x)) : Real(0);
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
    const Real accepted = Real(64) * round_off();  // two digits less than fresh factors leave
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

  // From a complementary basis, refreshed, to one without a negative value.
  LcpStatus run() {
    if (std::none_of(x.begin(), x.end(), [](const Real& value) { return value < Real(0); })) return LcpStatus::solved;
    entering = basis.z0();
    basis.direction(entering, y);
    int slot = first_negative_slot();
    if (slot < 0) return LcpStatus::numerical;
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

// Takes z of the basis, if it is the best so far.
template <class Real>
void judge_values(const LcpProblem& problem, LcpWorkspace& workspace, const LuBasis<Real>& basis,
                  const std::vector<Real>& x) {
  LcpWorkspace::Buffers& buffers = workspace.buffers();
  const std::size_t n = problem.size();
  for (std::size_t i = 0; i < n; ++i) workspace.result.basis[i] = basis.is_basic(static_cast<int>(n + i));
  basis.z_part(x, buffers.z_scaled);
  unscale(buffers.scaled, buffers.z_scaled, buffers.z);
  judge_candidate(problem, workspace);
}

template <class Real>
LcpStatus walk_from(const std::vector<std::uint8_t>& start_basis, bool has_ties, const LcpProblem& problem,
                    const LemkeLuSettings& settings, LcpWorkspace& workspace, LuBasis<Real>& basis,
                    std::vector<Real>& x, std::vector<Real>& y) {
  LcpWorkspace::Buffers& buffers = workspace.buffers();
  LcpResult& result = workspace.result;
  const int n = static_cast<int>(problem.size());
  const int max_pivots = settings.max_pivots > 0 ? settings.max_pivots : 10 * n + 100;
  basis.start(buffers.scaled, settings.ridge, start_basis, settings.cover);
  Walk<Real> walk{basis, settings.pivot_tolerance, max_pivots, settings.max_exchanges, has_ties, x, y};
  LcpStatus status = walk.refresh() ? LcpStatus::solved : LcpStatus::numerical;
  if (status == LcpStatus::solved && !start_basis.empty()) judge_values(problem, workspace, basis, x);
  if (status == LcpStatus::solved && !(result.residual <= settings.accepted_residual)) {
    status = walk.run();
    judge_values(problem, workspace, basis, x);
  }
  result.pivots += walk.pivots;
  result.refactorisations += walk.factorisations;
  if (status == LcpStatus::ray_unproven) {
    basis.z_direction(walk.entering, y, buffers.z_scaled);
    unscale(buffers.scaled, buffers.z_scaled, result.certificate);
  }
  return status;
}

// From the start basis, or from none if it is singular. Where unknowns differ much in size, the round-off of one is the
// value of another, and a tie may have ended the way one pivot too early: once more from there, without ties.
template <class Real>
LcpStatus walk(const LcpProblem& problem, const LemkeLuSettings& settings, LcpWorkspace& workspace,
               LuBasis<Real>& basis, std::vector<Real>& x, std::vector<Real>& y) {
  const LcpResult& result = workspace.result;
  const auto from = [&](const std::vector<std::uint8_t>& start_basis, bool has_ties) {
    return walk_from(start_basis, has_ties, problem, settings, workspace, basis, x, y);
  };
  const int pivots_before = result.pivots;
  LcpStatus status = from(settings.start_basis, true);
  const bool is_stuck = status == LcpStatus::numerical && result.pivots == pivots_before;
  if (is_stuck && !settings.start_basis.empty()) status = from({}, true);
  if (status != LcpStatus::solved || result.residual <= settings.accepted_residual) return status;
  std::vector<std::uint8_t>& last_basis = workspace.buffers().basis;
  last_basis = result.basis;
  return from(last_basis, false);
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
    std::vector<Quad> x, y;
    status = walk(problem, settings, workspace, basis, x, y);
  } else {
    LcpWorkspace::Buffers& buffers = workspace.buffers();
    status = walk(problem, settings, workspace, buffers.lu_basis, buffers.values, buffers.step);
  }
  conclude(status, settings.accepted_residual, result);
}

LcpResult lemke_lu(const LcpProblem& problem, const LemkeLuSettings& settings) { return solve_lcp(problem, settings); }

}  // namespace tumble
