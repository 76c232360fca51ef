#include "tumble/lcp/infeasibility.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>

#include "tumble/lcp/scaled_problem.hpp"

namespace tumble {
namespace {

using Index = Eigen::Index;

// min |A x - b| over x >= 0 for A = [M, -I], b = -q, by the active set method of Lawson and Hanson. Rows and columns
// are multiplied by powers of two first: a proof in any units is one, as units may differ from row to row and from
// column to column, and the smallest of numbers may decide.
class NonnegativeLeastSquares {
 public:
  explicit NonnegativeLeastSquares(const ScaledProblem& problem) : n_(static_cast<Index>(problem.size())) {
    Eigen::MatrixXd table(n_, n_ + 1);  // M and q
    for (Index i = 0; i < n_; ++i) {
      const auto row = static_cast<std::size_t>(i);
      for (Index j = 0; j < n_; ++j) table(i, j) = problem(row, static_cast<std::size_t>(j));
      table(i, n_) = problem.q[row];
    }
    equilibrate_rows_and_columns(table);
    A_.setZero(n_, 2 * n_);
    A_.leftCols(n_) = table.leftCols(n_);
    A_.rightCols(n_).diagonal().setConstant(-1.0);
    b_ = -table.col(n_);
  }

  // Row i was multiplied by 2^row_exponent(i).
  int row_exponent(std::size_t i) const { return row_exponents_[i]; }

  // The residual b - A x of the solution; 0 if it is round-off.
  Eigen::VectorXd residual() {
    const Eigen::VectorXd column_sizes = A_.colwise().norm();
    std::vector<bool> is_refused(static_cast<std::size_t>(2 * n_), false);
    x_.setZero(2 * n_);
    Eigen::VectorXd r = b_;
    for (Index round = 0; round < 6 * n_; ++round) {
      const double size_before = r.norm();
      if (size_before <= k_round_off * b_.norm()) return Eigen::VectorXd::Zero(n_);
      const Eigen::VectorXd gain = A_.transpose() * r;
      Index best = -1;
      for (Index j = 0; j < 2 * n_; ++j) {
        if (is_refused[static_cast<std::size_t>(j)] || is_active(j)) continue;
        if (gain[j] <= k_round_off * column_sizes[j] * size_before) continue;
        if (best < 0 || gain[j] * column_sizes[best] > gain[best] * column_sizes[j]) best = j;
      }
      if (best < 0) break;
      active_.push_back(best);
      solve_active();
      r = b_ - A_ * x_;
      // A column that depends on the active ones, or whose gain was round-off, brings nothing.
      if (!(r.norm() < size_before)) is_refused[static_cast<std::size_t>(best)] = true;
    }
    return clear_of_active(r);
  }

 private:
  static constexpr double k_round_off = 1e-13;

  // Makes the largest entry of each row and column lie near 1, M and q alike. [Ruiz 2001]
  void equilibrate_rows_and_columns(Eigen::MatrixXd& table) {
    constexpr int num_rounds = 8;
    const auto exponent_of = [](double largest) {
      int exponent = 0;
      std::frexp(largest, &exponent);  // 0 for 0
      return exponent;
    };
    row_exponents_.assign(static_cast<std::size_t>(n_), 0);
    for (int round = 0; round < num_rounds; ++round) {
      for (Index i = 0; i < n_; ++i) {
        const int exponent = exponent_of(table.row(i).cwiseAbs().maxCoeff());
        for (double& entry : table.row(i)) entry = std::ldexp(entry, -exponent);
        row_exponents_[static_cast<std::size_t>(i)] -= exponent;
      }
      for (Index j = 0; j <= n_; ++j) {
        const int exponent = exponent_of(table.col(j).cwiseAbs().maxCoeff());
        for (double& entry : table.col(j)) entry = std::ldexp(entry, -exponent);
      }
    }
  }

  // The residual r is orthogonal to the active columns but for round-off of b, which may be far larger than r. The one
  // returned is 0 where w is active, and orthogonal to the active columns of M but for round-off of its own and a
  // little more, which is on the safe side.
  Eigen::VectorXd clear_of_active(const Eigen::VectorXd& r) const {
    constexpr double little = 1e-12;
    std::vector<Index> rows, columns;
    for (Index i = 0; i < n_; ++i) {
      if (!is_active(n_ + i)) rows.push_back(i);
      if (is_active(i)) columns.push_back(i);
    }
    Eigen::VectorXd clear = Eigen::VectorXd::Zero(n_);
    clear(rows) = r(rows);
    if (rows.empty() || columns.empty()) return clear;
    const Eigen::MatrixXd active = A_(rows, columns).transpose();
    const Eigen::VectorXd excess = active * r(rows) + little * active.cwiseAbs() * r(rows).cwiseAbs();
    clear(rows) -= active.completeOrthogonalDecomposition().solve(excess);
    return clear;
  }

  bool is_active(Index j) const { return std::find(active_.begin(), active_.end(), j) != active_.end(); }

  // Moves x towards the least squares solution of the active columns; columns that would become negative are dropped.
  void solve_active() {
    while (!active_.empty()) {
      const Eigen::VectorXd target = A_(Eigen::all, active_).colPivHouseholderQr().solve(b_);
      double step = 1.0;
      for (std::size_t k = 0; k < active_.size(); ++k) {
        const double from = x_[active_[k]], to = target[static_cast<Index>(k)];
        if (to <= 0.0) step = std::min(step, from > 0.0 ? from / (from - to) : 0.0);
      }
      std::vector<Index> kept;
      for (std::size_t k = 0; k < active_.size(); ++k) {
        const Index j = active_[k];
        const double to = target[static_cast<Index>(k)];
        const bool is_blocking = to <= 0.0 && (x_[j] <= 0.0 || x_[j] / (x_[j] - to) <= step);
        x_[j] = is_blocking ? 0.0 : x_[j] + step * (to - x_[j]);
        if (!is_blocking) kept.push_back(j);
      }
      const bool is_done = kept.size() == active_.size();
      active_ = kept;
      if (is_done) return;
    }
  }

  Index n_;
  Eigen::MatrixXd A_;
  Eigen::VectorXd b_, x_;
  std::vector<Index> active_;
  std::vector<int> row_exponents_;
};

}  // namespace

bool is_infeasibility_certificate(const LcpProblem& problem, std::span<const double> y) {
  constexpr double round_off = 1e-13;
  constexpr double clear = 1e-6;
  const std::size_t n = problem.size();
  if (y.size() != n) return false;
  double product = 0.0, size = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    if (!(y[i] >= 0.0)) return false;
    product += problem.q[i] * y[i];
    size += std::abs(problem.q[i] * y[i]);
  }
  if (!(product < -clear * size) || !std::isfinite(size)) return false;
  for (std::size_t j = 0; j < n; ++j) {
    double column = 0.0, column_size = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      column += problem(i, j) * y[i];
      column_size += std::abs(problem(i, j) * y[i]);
    }
    if (!(column <= round_off * column_size)) return false;
  }
  return true;
}

std::vector<double> find_infeasibility(const LcpProblem& problem) {
  ScaledProblem scaled;
  scale(problem, scaled);
  NonnegativeLeastSquares squares(scaled);
  const Eigen::VectorXd r = squares.residual();
  const double largest = r.maxCoeff();
  if (!(largest > 0.0)) return {};
  std::vector<double> y(problem.size());
  double largest_y = 0.0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    y[i] = std::ldexp(std::max(r[static_cast<Index>(i)], 0.0), scaled.w_exponent[i] + squares.row_exponent(i));
    largest_y = std::max(largest_y, y[i]);
  }
  for (double& y_i : y) y_i /= largest_y;
  if (!is_infeasibility_certificate(problem, y)) return {};
  return y;
}

}  // namespace tumble
