// LU factors of a sparse matrix. Not a public header.
#pragma once

#include <cstddef>
#include <memory>

namespace tumble {

// A class of its own behind virtual functions: programs whose problems are never large do without Eigen's factors,
// which `make_sparse_lu` alone brings in.
class SparseLu {
 public:
  virtual ~SparseLu() = default;

  // Begins a matrix without entries.
  virtual void start() = 0;
  virtual void add(std::size_t row, std::size_t column, double value) = 0;

  // Of the k x k matrix of the entries added. False if it is singular.
  virtual bool factor(std::size_t k) = 0;

  // x with A x = b; b and x have k entries and may not overlap.
  virtual void solve(const double* b, double* x) const = 0;
};

// By Eigen.
std::unique_ptr<SparseLu> make_sparse_lu();

}  // namespace tumble
