// LU factors with partial pivoting, in place, for any real type, without allocating once warm. Not a public header.
//
// Eigen's PartialPivLU allocates its permutation at every change of size, and the bases of pivoting methods change size
// with every pivot; the order of the sums here is fixed, whatever the compiler.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace tumble {

template <class Real>
class DenseLu {
 public:
  // Room for a k x k matrix, row after row, to be filled in before `factor`.
  std::vector<Real>& start(std::size_t k) {
    k_ = k;
    entries_.resize(k * k);
    order_.resize(k);
    return entries_;
  }

  // False if the matrix is singular: a pivot is exactly 0, or not above `tolerance` times the largest entry that its
  // column had at first.
  bool factor(const Real& tolerance = Real(0)) {
    using std::abs;
    for (std::size_t i = 0; i < k_; ++i) order_[i] = i;
    if (tolerance > Real(0)) find_smallest_pivots(tolerance);
    for (std::size_t c = 0; c < k_; ++c) {
      std::size_t best = c;
      for (std::size_t i = c + 1; i < k_; ++i) {
        if (abs(at(i, c)) > abs(at(best, c))) best = i;
      }
      if (!(abs(at(best, c)) > (tolerance > Real(0) ? smallest_pivots_[c] : Real(0)))) return false;
      if (best != c) {
        std::swap_ranges(row(best), row(best) + k_, row(c));
        std::swap(order_[best], order_[c]);
      }
      const Real inverse = Real(1) / at(c, c);
      if constexpr (!k_is_fast) list_nonzeros(c);
      for (std::size_t i = c + 1; i < k_; ++i) {
        if (at(i, c) == Real(0)) continue;
        const Real factor = at(i, c) * inverse;
        at(i, c) = factor;
        const Real* from = row(c);
        Real* to = row(i);
        if constexpr (k_is_fast) {
          for (std::size_t j = c + 1; j < k_; ++j) to[j] -= factor * from[j];
        } else {
          for (const std::size_t j : nonzeros_) to[j] -= factor * from[j];
        }
      }
    }
    return true;
  }

  // x with A x = b; b and x have k entries and may not overlap.
  void solve(const Real* b, Real* x) const {
    for (std::size_t i = 0; i < k_; ++i) {
      Real sum = b[order_[i]];
      for (std::size_t j = 0; j < i; ++j) subtract_product(sum, entries_[i * k_ + j], x[j]);
      x[i] = sum;
    }
    for (std::size_t i = k_; i-- > 0;) {
      Real sum = x[i];
      for (std::size_t j = i + 1; j < k_; ++j) subtract_product(sum, entries_[i * k_ + j], x[j]);
      x[i] = sum / entries_[i * k_ + i];
    }
  }

 private:
  // Numbers made in software are slow: there it pays to skip zeros.
  static constexpr bool k_is_fast = std::is_floating_point_v<Real>;

  void list_nonzeros(std::size_t c) {
    nonzeros_.clear();
    for (std::size_t j = c + 1; j < k_; ++j) {
      if (at(c, j) != Real(0)) nonzeros_.push_back(j);
    }
  }

  static void subtract_product(Real& sum, const Real& a, const Real& b) {
    if constexpr (!k_is_fast) {
      if (a == Real(0) || b == Real(0)) return;
    }
    sum -= a * b;
  }

  Real& at(std::size_t i, std::size_t j) { return entries_[i * k_ + j]; }
  Real* row(std::size_t i) { return entries_.data() + i * k_; }

  void find_smallest_pivots(const Real& tolerance) {
    using std::abs;
    smallest_pivots_.assign(k_, Real(0));
    for (std::size_t i = 0; i < k_; ++i) {
      for (std::size_t j = 0; j < k_; ++j) {
        const Real size = tolerance * abs(at(i, j));
        if (size > smallest_pivots_[j]) smallest_pivots_[j] = size;
      }
    }
  }

  std::size_t k_ = 0;
  std::vector<Real> entries_;
  std::vector<Real> smallest_pivots_;  // per column, if there is a tolerance
  std::vector<std::size_t> order_, nonzeros_;
};

}  // namespace tumble
