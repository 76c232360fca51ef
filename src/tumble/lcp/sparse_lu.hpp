// LU factors of a sparse matrix, by Eigen, which is compiled in sparse_lu.cpp alone. Not a public header.
#pragma once

#include <cstddef>
#include <memory>

namespace tumble {

class SparseLu {
 public:
  SparseLu();
  ~SparseLu();
  SparseLu(SparseLu&&) noexcept;
  SparseLu& operator=(SparseLu&&) noexcept;

  // Begins a matrix without entries.
  void start();
  void add(std::size_t row, std::size_t column, double value);

  // Of the k x k matrix of the entries added. False if it is singular.
  bool factor(std::size_t k);

  // x with A x = b; b and x have k entries and may not overlap.
  void solve(const double* b, double* x) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tumble
