#include "tumble/lcp/dantzig.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "tumble/lcp/infeasibility.hpp"
#include "tumble/lcp/require.hpp"
#include "tumble/lcp/rung.hpp"

namespace tumble {
namespace {

// The way of row r is that of Lemke's method with the cover e_r: z0 is what the constant of the row still has to lose,
// so w_r + z0 is the w_r of the lowered constant. One basis serves all rows.
struct Drive {
  LuBasis<double>& basis;
  const ScaledProblem& problem;
  double pivot_tolerance;
  int max_pivots;
  std::vector<double>&x, &d;  // of the 2 n + 1 variables: values, and the direction in which they move
  int pivots = 0;
  int factorisations = 0;

  bool factor() {
    ++factorisations;
    return basis.factor();
  }

  // Basic variables that may block while d is followed: those that fall by more than round-off.
  double smallest_pivot() const {
    double largest = 0.0;
    for (const double d_i : d) largest = std::max(largest, std::abs(d_i));
    return pivot_tolerance * largest;
  }

  // The basic variable that first reaches 0 along d, z0 before all, else the least index.
  int blocking_variable() const {
    const double smallest = smallest_pivot();
    int blocking = LuBasis<double>::k_none;
    double step = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= basis.z0(); ++k) {
      const int i = k == 0 ? basis.z0() : k - 1;
      if (!basis.is_basic(i) || !(-d[i] > smallest)) continue;
      const double ratio = std::max(x[i], 0.0) / -d[i];
      if (ratio < step) {
        blocking = i;
        step = ratio;
      }
    }
    return blocking;
  }

  // While z0 falls to 0 from where all is >= 0: the first variable to become negative. x and d are those at z0 = 0.
  int first_negative() const {
    const double smallest = smallest_pivot();
    int blocking = LuBasis<double>::k_none;
    double highest = 0.0;
    for (int i = 0; i < basis.z0(); ++i) {
      if (!basis.is_basic(i) || !(d[i] > smallest) || !(x[i] < 0.0)) continue;
      const double z0 = -x[i] / d[i];
      if (z0 > highest) {
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
    if (!factor()) return LcpStatus::numerical;
    basis.values(x);
    basis.direction(basis.z0(), d);
    int entering = basis.z0();
    int leaving = first_negative();
    while (leaving >= 0) {
      if (pivots == max_pivots) return LcpStatus::iteration_limit;
      ++pivots;
      basis.exchange(entering, leaving);
      if (!factor()) return LcpStatus::numerical;
      basis.values(x);
      if (leaving == basis.z0()) return LcpStatus::solved;
      entering = basis.complement_of(leaving);
      basis.direction(entering, d);
      leaving = blocking_variable();
      if (leaving < 0) return LcpStatus::ray_unproven;
    }
    return LcpStatus::solved;
  }

  LcpStatus run() {
    const int n = basis.size();
    x.assign(2 * problem.size() + 1, 0.0);
    for (int i = 0; i < n; ++i) basis.set_constant(i, std::abs(problem.q[static_cast<std::size_t>(i)]));
    for (int r = 0; r < n; ++r) {
      if (!(problem.q[static_cast<std::size_t>(r)] < 0.0)) continue;
      const LcpStatus status = lower(r);
      if (status != LcpStatus::solved) return status;
    }
    return LcpStatus::solved;
  }
};

// The result's certificate, from the direction d of a ray: in units of the rows of M a proof, if it holds, that there
// is no solution; else in units of z the ray.
void certify(const LcpProblem& problem, const std::vector<double>& d, LcpWorkspace& workspace) {
  LcpWorkspace::Buffers& buffers = workspace.buffers();
  LcpResult& result = workspace.result;
  const std::size_t n = problem.size();
  for (std::size_t i = 0; i < n; ++i) buffers.z_scaled[i] = std::max(d[n + i], 0.0);
  result.certificate.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    result.certificate[i] = scaled_by(buffers.z_scaled[i], buffers.scaled.w_exponent[i]);
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
  result.basis = buffers.lu_basis.basic_z();
  buffers.z_scaled.assign(drive.x.begin() + static_cast<std::ptrdiff_t>(n),
                          drive.x.begin() + static_cast<std::ptrdiff_t>(2 * n));
  unscale(buffers.scaled, buffers.z_scaled, buffers.z);
  judge_candidate(problem, workspace);
  result.status = status == LcpStatus::solved ? LcpStatus::numerical : status;
  if (result.residual <= settings.accepted_residual) {
    result.status = LcpStatus::solved;
  } else if (status == LcpStatus::ray_unproven) {
    certify(problem, drive.d, workspace);
  }
}

LcpResult dantzig(const LcpProblem& problem, const DantzigSettings& settings) {
  validate(problem);
  validate(settings);
  LcpWorkspace workspace;
  solve_prepared(problem, settings, workspace, run_dantzig);
  return std::move(workspace.result);
}

}  // namespace tumble
