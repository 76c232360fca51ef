// LU factors of the core of a basis: dense ones where it is small or full, else sparse ones if there are any. Not a
// public header.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

#include "tumble/lcp/dense_lu.hpp"
#include "tumble/lcp/sparse_lu.hpp"

namespace tumble {

template <class Real>
class CoreLu {
 public:
  // Of doubles only.
  void allow_sparse(std::unique_ptr<SparseLu> (*make)()) {
    if (!sparse_) sparse_ = make();
  }

  // Begins a k x k matrix, to be filled column after column by `add`, then factored. `num_entries` is an estimate.
  void start(std::size_t k, std::size_t num_entries) {
    // Smaller and fuller ones are factored faster as dense ones.
    constexpr std::size_t smallest_sparse = 40, smallest_share = 6;
    k_ = k;
    is_sparse_ = sparse_ && k >= smallest_sparse && smallest_share * num_entries < k * k;
    if (is_sparse_) {
      sparse_->start();
    } else {
      std::vector<Real>& entries = dense_.start(k);
      std::fill(entries.begin(), entries.end(), Real(0));
      entries_ = &entries;
    }
  }

  void add(std::size_t row, std::size_t column, const Real& value) {
    if constexpr (std::is_same_v<Real, double>) {
      if (is_sparse_) {
        sparse_->add(row, column, value);
        return;
      }
    }
    (*entries_)[row * k_ + column] = value;
  }

  // False if the matrix is singular.
  bool factor() { return is_sparse_ ? sparse_->factor(k_) : dense_.factor(); }

  // x with A x = b; b and x have k entries and may not overlap.
  void solve(const Real* b, Real* x) {
    if constexpr (std::is_same_v<Real, double>) {
      if (is_sparse_) {
        sparse_->solve(b, x);
        return;
      }
    }
    dense_.solve(b, x);
  }

 private:
  std::size_t k_ = 0;
  bool is_sparse_ = false;
  DenseLu<Real> dense_;
  std::vector<Real>* entries_ = nullptr;
  std::unique_ptr<SparseLu> sparse_;
};

}  // namespace tumble
