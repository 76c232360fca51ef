#include "tumble/lcp/lemke.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include <Eigen/LU>
#include <fmt/format.h>

#include "tumble/lcp/equilibrate.hpp"
#include "tumble/lcp/residual.hpp"

namespace tumble {
namespace {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Index = Eigen::Index;

// The problem in equilibrated units, with |q| at most 1 in each block, and the way back.
struct ScaledProblem {
  RowMajorMatrix M;
  Eigen::VectorXd q;
  std::vector<int> z_exponent;  // z_i = z_scaled_i * 2^z_exponent_i
};

ScaledProblem scale(const LcpProblem& problem) {
  const std::size_t n = problem.size();
  const Equilibration scales = equilibrate(problem);
  const std::vector<double> sizes = block_sizes(problem, scales);
  std::vector<int> q_exponents(2 * n);  // per block; a block without q of its own is as large as the largest
  for (std::size_t block = 0; block < 2 * n; ++block) {
    const double size = sizes[block] > 0.0 ? sizes[block] : *std::max_element(sizes.begin(), sizes.end());
    std::frexp(size, &q_exponents[block]);
  }
  ScaledProblem scaled{RowMajorMatrix(n, n), Eigen::VectorXd(n), std::vector<int>(n)};
  for (std::size_t j = 0; j < n; ++j) scaled.z_exponent[j] = scales.column[j] + q_exponents[scales.column_block[j]];
  for (std::size_t i = 0; i < n; ++i) {
    const int w_exponent = scales.row[i] - q_exponents[scales.row_block[i]];
    scaled.q[i] = std::ldexp(problem.q[i], w_exponent);
    for (std::size_t j = 0; j < n; ++j) scaled.M(i, j) = std::ldexp(problem(i, j), w_exponent + scaled.z_exponent[j]);
  }
  return scaled;
}

// The tableau of  w - M z - e z0 = q  for the scaled problem. Variables are numbered w = 0 .. n-1, z = n .. 2n-1,
// z0 = 2n; column 2n + 1 holds the values of the basic variables.
class Tableau {
 public:
  explicit Tableau(const ScaledProblem& problem)
      : n_(problem.q.size()), entries_(RowMajorMatrix::Zero(n_, 2 * n_ + 2)), sizes_(problem.q.cwiseAbs()), basic_(n_) {
    for (Index i = 0; i < n_; ++i) {
      entries_(i, i) = 1.0;
      entries_.row(i).segment(n_, n_) = -problem.M.row(i);
      entries_(i, z0()) = -1.0;
      entries_(i, values()) = problem.q[i];
      basic_[i] = i;
    }
  }

  Index z0() const { return 2 * n_; }
  Index complement_of(Index variable) const { return variable < n_ ? variable + n_ : variable - n_; }
  Index row_of_smallest_value() const {
    Index row;
    entries_.col(values()).minCoeff(&row);
    return row;
  }

  // The row whose basic variable first reaches 0 when `entering` grows; nothing if none does (a ray).
  // Values that differ by no more than their round-off tie. Ties go to z0, else to the largest pivot: in floating point
  // that loses less than a lexicographic rule.
  std::optional<Index> blocking_row(Index entering, double pivot_tolerance) const {
    constexpr double round_off = 1e-14;  // of the sizes of the terms summed so far: some 50 rounding errors
    const double smallest_pivot = pivot_tolerance * entries_.col(entering).cwiseAbs().maxCoeff();
    double step = 0.0;
    std::optional<Index> row;
    for (Index i = 0; i < n_; ++i) {
      if (entries_(i, entering) <= smallest_pivot) continue;
      const double ratio = std::max(entries_(i, values()), 0.0) / entries_(i, entering);
      if (!row || ratio < step) {
        row = i;
        step = ratio;
      }
    }
    if (!row) return row;
    const double step_error = round_off * sizes_[*row] / entries_(*row, entering);
    for (Index i = 0; i < n_; ++i) {
      const double pivot = entries_(i, entering);
      if (pivot <= smallest_pivot) continue;
      if (std::max(entries_(i, values()), 0.0) > (step + step_error) * pivot + round_off * sizes_[i]) continue;
      if (basic_[i] == z0()) return i;
      if (pivot > entries_(*row, entering)) row = i;
    }
    return row;
  }

  // Makes `entering` basic in `row`; returns the variable that leaves.
  Index pivot(Index row, Index entering) {
    sizes_[row] /= std::abs(entries_(row, entering));
    entries_.row(row) /= entries_(row, entering);
    for (Index i = 0; i < n_; ++i) {
      const double factor = entries_(i, entering);
      if (i == row || factor == 0.0) continue;
      entries_.row(i) -= factor * entries_.row(row);
      sizes_[i] = std::max(sizes_[i], std::abs(factor) * sizes_[row]);
    }
    std::swap(basic_[row], entering);
    return entering;
  }

  std::vector<std::uint8_t> basic_z() const {
    std::vector<std::uint8_t> is_basic(n_, 0);
    for (const Index variable : basic_) {
      if (n_ <= variable && variable < z0()) is_basic[variable - n_] = 1;
    }
    return is_basic;
  }

  Eigen::VectorXd z_values() const {
    Eigen::VectorXd z = Eigen::VectorXd::Zero(n_);
    for (Index i = 0; i < n_; ++i) {
      if (n_ <= basic_[i] && basic_[i] < z0()) z[basic_[i] - n_] = std::max(entries_(i, values()), 0.0);
    }
    return z;
  }

 private:
  Index values() const { return 2 * n_ + 1; }

  Index n_;
  RowMajorMatrix entries_;
  Eigen::VectorXd sizes_;     // of the terms that the values are sums of; their round-off is proportional to it
  std::vector<Index> basic_;  // the basic variable of each row
};

// z with M_BB z_B = -q_B on the basic rows B and 0 elsewhere, free of the tableau's rounding; negative parts cut off.
Eigen::VectorXd solve_basis(const ScaledProblem& problem, const std::vector<std::uint8_t>& basis) {
  std::vector<Index> rows;
  for (std::size_t i = 0; i < basis.size(); ++i) {
    if (basis[i]) rows.push_back(static_cast<Index>(i));
  }
  Eigen::VectorXd z = Eigen::VectorXd::Zero(problem.q.size());
  if (rows.empty()) return z;
  const Eigen::MatrixXd M_BB = problem.M(rows, rows);
  z(rows) = M_BB.partialPivLu().solve(-problem.q(rows)).cwiseMax(0.0);
  return z;
}

void validate(const LemkeSettings& settings) {
  const auto refuse = [](const char* field, double value, const char* range) {
    throw std::invalid_argument(fmt::format("{}: must be {}, got {}", field, range, value));
  };
  if (settings.max_pivots < 0) refuse("max_pivots", settings.max_pivots, ">= 0");
  if (!(settings.pivot_tolerance >= 0.0 && settings.pivot_tolerance < 1.0)) {
    refuse("pivot_tolerance", settings.pivot_tolerance, "in [0, 1)");
  }
  if (!(settings.accepted_residual > 0.0 && settings.accepted_residual <= k_largest_accepted_residual)) {
    refuse("accepted_residual", settings.accepted_residual, "in (0, 0.01]");
  }
}

// How the pivots ended, before the residual has its say.
struct PivotOutcome {
  LcpStatus status;
  int pivots;
};

PivotOutcome run_pivots(Tableau& tableau, const LemkeSettings& settings, int max_pivots) {
  Index leaving = tableau.pivot(tableau.row_of_smallest_value(), tableau.z0());
  for (int pivots = 1; pivots < max_pivots; ++pivots) {
    const Index entering = tableau.complement_of(leaving);
    const auto row = tableau.blocking_row(entering, settings.pivot_tolerance);
    if (!row) return {LcpStatus::ray_unproven, pivots};
    leaving = tableau.pivot(*row, entering);
    if (leaving == tableau.z0()) return {LcpStatus::solved, pivots + 1};
  }
  return {LcpStatus::iteration_limit, max_pivots};
}

}  // namespace

LcpResult lemke(const LcpProblem& problem, const LemkeSettings& settings) {
  validate(problem);
  validate(settings);
  const std::size_t n = problem.size();
  LcpResult result;
  if (std::all_of(problem.q.begin(), problem.q.end(), [](double x) { return x >= 0.0; })) {
    result.status = LcpStatus::solved;
    result.z.assign(n, 0.0);
    result.w = problem.q;
    result.basis.assign(n, 0);
    return result;
  }
  const ScaledProblem scaled = scale(problem);
  Tableau tableau(scaled);
  const int max_pivots = settings.max_pivots > 0 ? settings.max_pivots : 100 * static_cast<int>(n) + 1000;
  const PivotOutcome outcome = run_pivots(tableau, settings, max_pivots);

  result.rung = LcpRung::lemke;
  result.pivots = outcome.pivots;
  result.basis = tableau.basic_z();
  result.residual = std::numeric_limits<double>::infinity();
  for (const Eigen::VectorXd& candidate : {solve_basis(scaled, result.basis), tableau.z_values()}) {
    std::vector<double> z(n);
    for (std::size_t i = 0; i < n; ++i) z[i] = std::ldexp(candidate[i], scaled.z_exponent[i]);
    const LcpResidual parts = residual(problem, z);
    if (result.z.empty() || parts.largest() < result.residual) {
      result.z = z;
      result.parts = parts;
      result.residual = parts.largest();
    }
  }
  result.w = complement(problem, result.z);
  const bool is_accepted = result.residual <= settings.accepted_residual;
  if (is_accepted) {
    result.status = LcpStatus::solved;
  } else {
    result.status = outcome.status == LcpStatus::solved ? LcpStatus::numerical : outcome.status;
  }
  return result;
}

}  // namespace tumble
