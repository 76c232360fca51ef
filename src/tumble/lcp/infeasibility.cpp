#include "tumble/lcp/infeasibility.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>

#include "tumble/lcp/scaled_problem.hpp"

namespace tumble {
namespace {

using Index = Eigen::Index;

// min |A x - b| over x >= 0 for A = [M, -I], b = -q, by the active set method of Lawson and Hanson.
class NonnegativeLeastSquares {
 public:
  // Row i is multiplied by 2^row_exponents[i], so that its largest entry is near 1.
  NonnegativeLeastSquares(const ScaledProblem& problem, std::vector<int>& row_exponents)
      : n_(static_cast<Index>(problem.size())) {
    A_.setZero(n_, 2 * n_);
    b_.resize(n_);
    row_exponents.resize(problem.size());
    for (Index i = 0; i < n_; ++i) {
      const auto row = static_cast<std::size_t>(i);
      for (Index j = 0; j < n_; ++j) A_(i, j) = problem(row, static_cast<std::size_t>(j));
      b_[i] = -problem.q[row];
      int exponent = 0;
      std::frexp(std::max(A_.row(i).cwiseAbs().maxCoeff(), std::abs(b_[i])), &exponent);
      row_exponents[row] = -exponent;
      for (Index j = 0; j < n_; ++j) A_(i, j) = std::ldexp(A_(i, j), -exponent);
      b_[i] = std::ldexp(b_[i], -exponent);
      A_(i, n_ + i) = -1.0;
    }
  }

  // The residual b - A x of the solution.
  Eigen::VectorXd residual() {
    constexpr double round_off = 1e-13;
    const Eigen::VectorXd column_sizes = A_.colwise().norm();
    std::vector<bool> is_refused(static_cast<std::size_t>(2 * n_), false);
    x_.setZero(2 * n_);
    Eigen::VectorXd r = b_;
    for (Index round = 0; round < 6 * n_; ++round) {
      const Eigen::VectorXd gain = A_.transpose() * r;
      Index best = -1;
      for (Index j = 0; j < 2 * n_; ++j) {
        if (is_refused[static_cast<std::size_t>(j)] || is_active(j)) continue;
        if (gain[j] <= round_off * column_sizes[j] * b_.norm()) continue;
        if (best < 0 || gain[j] * column_sizes[best] > gain[best] * column_sizes[j]) best = j;
      }
      if (best < 0) break;
      active_.push_back(best);
      const double size_before = r.norm();
      solve_active();
      r = b_ - A_ * x_;
      // A column that depends on the active ones, or whose gain was round-off, brings nothing.
      if (!(r.norm() < size_before)) is_refused[static_cast<std::size_t>(best)] = true;
    }
    return r;
  }

 private:
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
  std::vector<int> row_exponents;
  const Eigen::VectorXd r = NonnegativeLeastSquares(scaled, row_exponents).residual();
  const double largest = r.maxCoeff();
  if (!(largest > 0.0)) return {};
  std::vector<double> y(problem.size());
  double largest_y = 0.0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    // What is 0 in exact arithmetic has the round-off of b.
    const double r_i = r[static_cast<Index>(i)];
    y[i] = r_i > 1e-13 * largest ? std::ldexp(r_i, scaled.w_exponent[i] + row_exponents[i]) : 0.0;
    largest_y = std::max(largest_y, y[i]);
  }
  for (double& y_i : y) y_i /= largest_y;
  if (!is_infeasibility_certificate(problem, y)) return {};
  return y;
}

}  // namespace tumble
