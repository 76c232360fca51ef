// An almost complementary basis of Lemke's method, known by its list of basic variables alone. Not a public header.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "tumble/lcp/dense_lu.hpp"
#include "tumble/lcp/scaled_problem.hpp"

namespace tumble {

// The basic variables of  w = M z + cover z0 + q, and how they change. Rows R are those with w_i = 0, columns C the z_j
// that are basic. The core [M_RC cover_R] (without the cover while z0 = 0) gives z_C and z0; the other w follow.
template <class Real>
class LuBasis {
 public:
  static constexpr int k_none = -1;

  // A complementary basis; the cover is such that every w_i and z_i there grows by 1 with z0.
  void start(const ScaledProblem& problem, double ridge, const std::vector<std::uint8_t>& basis) {
    n_ = static_cast<int>(problem.size());
    const auto n = static_cast<std::size_t>(n_);
    M_.assign(problem.M.begin(), problem.M.end());
    for (std::size_t i = 0; i < n; ++i) M_[i * n + i] += Real(ridge);
    q_.assign(problem.q.begin(), problem.q.end());
    is_z_basic_.assign(n, 0);
    is_w_basic_.assign(n, 1);
    for (std::size_t i = 0; i < basis.size(); ++i) {
      is_z_basic_[i] = basis[i];
      is_w_basic_[i] = !basis[i];
    }
    is_z0_basic_ = false;
    cover_.assign(n, Real(0));
    for (int i = 0; i < n_; ++i) {
      if (is_w_basic_[i]) cover_[i] = Real(1);
      for (int j = 0; j < n_; ++j) {
        if (is_z_basic_[j]) cover_[i] -= M(i, j);
      }
    }
  }

  // Another constant than the problem's in row i.
  void set_constant(int i, const Real& q_i) { q_[i] = q_i; }

  // Another cover: z0 adds to w_i alone.
  void set_cover_to_row(int i) {
    cover_.assign(cover_.size(), Real(0));
    cover_[i] = Real(1);
  }

  int z0() const { return 2 * n_; }
  int complement_of(int variable) const { return variable < n_ ? variable + n_ : variable - n_; }
  int size() const { return n_; }

  bool is_basic(int variable) const {
    if (variable == z0()) return is_z0_basic_;
    return variable < n_ ? is_w_basic_[variable] : is_z_basic_[variable - n_];
  }

  // Makes one variable basic in place of another; `k_none` for neither.
  void exchange(int entering, int leaving) {
    set(entering, true);
    set(leaving, false);
  }

  // Factors the core. False if it is singular.
  bool factor() {
    rows_.clear();
    columns_.clear();
    for (int i = 0; i < n_; ++i) {
      if (!is_w_basic_[i]) rows_.push_back(i);
      if (is_z_basic_[i]) columns_.push_back(i);
    }
    const std::size_t k = rows_.size();
    if (columns_.size() + (is_z0_basic_ ? 1u : 0u) != k) return false;
    std::vector<Real>& core = lu_.start(k);
    for (std::size_t i = 0; i < k; ++i) {
      for (std::size_t j = 0; j < columns_.size(); ++j) core[i * k + j] = M(rows_[i], columns_[j]);
      if (is_z0_basic_) core[i * k + k - 1] = cover_[rows_[i]];
    }
    return lu_.factor();
  }

  // Values of the 2n + 1 variables, 0 where nonbasic.
  void values(std::vector<Real>& x) {
    right_.clear();
    for (const int i : rows_) right_.push_back(-q_[i]);
    solve_and_spread(x);
    for (int i = 0; i < n_; ++i) {
      if (is_w_basic_[i]) x[i] = product(i, x) + q_[i];
    }
  }

  // How they change while the nonbasic variable `entering` grows by 1.
  void direction(int entering, std::vector<Real>& d) {
    right_.clear();
    for (const int i : rows_) {
      right_.push_back(entering == z0() ? -cover_[i] : entering < n_ ? Real(i == entering) : -M(i, entering - n_));
    }
    solve_and_spread(d);
    d[entering] = Real(1);
    for (int i = 0; i < n_; ++i) {
      if (is_w_basic_[i]) d[i] = product(i, d);
    }
  }

  const std::vector<std::uint8_t>& basic_z() const { return is_z_basic_; }

 private:
  const Real& M(int i, int j) const { return M_[static_cast<std::size_t>(i) * n_ + j]; }

  void set(int variable, bool basic) {
    if (variable == k_none) return;
    if (variable == z0()) {
      is_z0_basic_ = basic;
    } else if (variable < n_) {
      is_w_basic_[variable] = basic;
    } else {
      is_z_basic_[variable - n_] = basic;
    }
  }

  void solve_and_spread(std::vector<Real>& x) {
    solution_.resize(rows_.size());
    lu_.solve(right_.data(), solution_.data());
    x.assign(2 * static_cast<std::size_t>(n_) + 1, Real(0));
    for (std::size_t j = 0; j < columns_.size(); ++j) x[n_ + columns_[j]] = solution_[j];
    if (is_z0_basic_) x[z0()] = solution_.back();
  }

  // Row i of M z + cover z0.
  Real product(int i, const std::vector<Real>& x) const {
    Real sum = cover_[i] * x[z0()];
    for (int j = 0; j < n_; ++j) {
      if (x[n_ + j] != Real(0)) sum += M(i, j) * x[n_ + j];
    }
    return sum;
  }

  int n_ = 0;
  std::vector<Real> M_, q_, cover_;
  std::vector<std::uint8_t> is_z_basic_, is_w_basic_;
  bool is_z0_basic_ = false;
  std::vector<int> rows_, columns_;
  DenseLu<Real> lu_;
  std::vector<Real> right_, solution_;
};

}  // namespace tumble
