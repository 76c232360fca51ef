#include "tumble/lcp/dantzig.hpp"

#include <algorithm>
#include <cmath>

#include "tumble/lcp/infeasibility.hpp"
#include "tumble/lcp/require.hpp"
#include "tumble/lcp/rung.hpp"
#include "tumble/lcp/solve.hpp"

namespace tumble {
namespace {

// The way of row r is that of Lemke's method with the cover e_r: z0 is what the constant of the row still has to lose,
// so w_r + z0 is the w_r of the lowered constant. One basis serves all rows.
struct Drive {
  LuBasis<double>& basis;
  const ScaledProblem& problem;
  double pivot_tolerance;
  int max_pivots;
  std::vector<double>&x, &y;  // slot by slot: values, and what they lose while the entering variable grows by 1
  int entering = LuBasis<double>::k_none;
  int pivots = 0;
  int factorisations = 0;

  bool refresh() {
    ++factorisations;
    if (!basis.factor()) return false;
    basis.values(x);
    return true;
  }

  // Basic variables that may block: those that fall by more than round-off.
  double smallest_pivot() const {
    double largest = 0.0;
    for (const double y_i : y) largest = std::max(largest, std::abs(y_i));
    return pivot_tolerance * largest;
  }

  // The slot whose variable first reaches 0, z0 before all, else the least index.
  int blocking_slot() const {
    const double smallest = smallest_pivot();
    int blocking = LuBasis<double>::k_none;
    double step = 0.0;
    const auto comes_first = [&](int a, int b) {
      return basis.variable(a) == basis.z0() ||
             (basis.variable(b) != basis.z0() && basis.variable(a) < basis.variable(b));
    };
    for (int i = 0; i < static_cast<int>(x.size()); ++i) {
      if (!(y[i] > smallest)) continue;
      const double ratio = std::max(x[i], 0.0) / y[i];
      if (blocking < 0 || ratio < step || (ratio == step && comes_first(i, blocking))) {
        blocking = i;
        step = ratio;
      }
    }
    return blocking;
  }

  // While z0 falls to 0 from where all is >= 0: the first variable to become negative. x is that at z0 = 0.
  int first_negative() const {
    const double smallest = smallest_pivot();
    int blocking = LuBasis<double>::k_none;
    double highest = 0.0;
    for (int i = 0; i < static_cast<int>(x.size()); ++i) {
      if (!(-y[i] > smallest) || !(x[i] < 0.0)) continue;
      const double z0 = x[i] / y[i];
      if (blocking < 0 || z0 > highest || (z0 == highest && basis.variable(i) < basis.variable(blocking))) {
        blocking = i;
        highest = z0;
      }
    }
    return blocking;
  }

  // Lowers the constant of row r from |q_r| to q_r.
  LcpStatus lower(int r) {
    basis.set_constant(r, problem.q[static_cast<std::size_t>(r)]);
    basis.set_cover_to_row(r);
    if (!refresh()) return LcpStatus::numerical;
    entering = basis.z0();
    basis.direction(entering, y);
    int slot = first_negative();
    if (slot < 0) return LcpStatus::solved;
    for (;;) {
      if (pivots == max_pivots) return LcpStatus::iteration_limit;
      ++pivots;
      const int leaving = basis.variable(slot);
      basis.exchange(entering, slot, y);
      if (!refresh()) return LcpStatus::numerical;
      if (leaving == basis.z0()) return LcpStatus::solved;
      entering = basis.complement_of(leaving);
      basis.direction(entering, y);
      slot = blocking_slot();
      if (slot < 0) return LcpStatus::ray_unproven;
    }
  }

  LcpStatus run() {
    const int n = static_cast<int>(problem.size());
    for (int i = 0; i < n; ++i) basis.set_constant(i, std::abs(problem.q[static_cast<std::size_t>(i)]));
    if (!refresh()) return LcpStatus::numerical;
    for (int r = 0; r < n; ++r) {
      if (!(problem.q[static_cast<std::size_t>(r)] < 0.0)) continue;
      const LcpStatus status = lower(r);
      if (status != LcpStatus::solved) return status;
    }
    return LcpStatus::solved;
  }
};

// The result's certificate, from the direction of a ray in buffers.z_scaled: in units of the rows of M a proof, if it
// holds, that there is no solution; else in units of z the ray.
void certify(const LcpProblem& problem, LcpWorkspace& workspace) {
  LcpWorkspace::Buffers& buffers = workspace.buffers();
  LcpResult& result = workspace.result;
  const std::size_t n = problem.size();
  result.certificate.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    result.certificate[i] = scaled_by(std::max(buffers.z_scaled[i], 0.0), buffers.scaled.w_exponent[i]);
  }
  if (is_infeasibility_certificate(problem, result.certificate)) {
    result.status = LcpStatus::infeasible;
  } else {
    unscale(buffers.scaled, buffers.z_scaled, result.certificate);
  }
}

}  // namespace

void validate(const DantzigSettings& settings) {
  require(settings.max_pivots >= 0, "max_pivots", ">= 0", settings.max_pivots);
  require(settings.pivot_tolerance >= 0.0 && settings.pivot_tolerance < 1.0, "pivot_tolerance", "in [0, 1)",
          settings.pivot_tolerance);
  require_accepted_residual(settings.accepted_residual);
}

void run_dantzig(const LcpProblem& problem, const DantzigSettings& settings, LcpWorkspace& workspace) {
  LcpWorkspace::Buffers& buffers = workspace.buffers();
  LcpResult& result = workspace.result;
  result.rung = LcpRung::dantzig;
  const std::size_t n = problem.size();
  const int max_pivots = settings.max_pivots > 0 ? settings.max_pivots : 100 * static_cast<int>(n) + 1000;
  result.basis.assign(n, 0);
  buffers.lu_basis.start(buffers.scaled, 0.0, result.basis);
  Drive drive{buffers.lu_basis, buffers.scaled, settings.pivot_tolerance, max_pivots, buffers.values, buffers.step};
  const LcpStatus status = drive.run();
  result.pivots += drive.pivots;
  result.refactorisations += drive.factorisations;
  for (std::size_t i = 0; i < n; ++i) result.basis[i] = buffers.lu_basis.is_basic(static_cast<int>(n + i));
  buffers.lu_basis.z_part(drive.x, buffers.z_scaled);
  unscale(buffers.scaled, buffers.z_scaled, buffers.z);
  judge_candidate(problem, workspace);
  conclude(status, settings.accepted_residual, result);
  if (result.status == LcpStatus::ray_unproven) {
    buffers.lu_basis.z_direction(drive.entering, drive.y, buffers.z_scaled);
    certify(problem, workspace);
  }
}

LcpResult dantzig(const LcpProblem& problem, const DantzigSettings& settings) { return solve_lcp(problem, settings); }

}  // namespace tumble
