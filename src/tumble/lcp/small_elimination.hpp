// Gaussian elimination with full pivoting for the small systems of an enumeration, on the stack. Not a public header.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace tumble {

// A x = b with up to Size rows and columns, of any rank. Fill `at` and `right`, then `run`.
template <std::size_t Size>
class SmallElimination {
 public:
  SmallElimination(std::size_t rows, std::size_t columns) : rows_(rows), columns_(columns) {}

  double& at(std::size_t row, std::size_t column) { return entries_[row][column]; }
  double& right(std::size_t row) { return entries_[row][columns_]; }

  // Pivots of magnitude up to `tolerance` times the largest count as 0.
  void run(double tolerance) {
    for (std::size_t c = 0; c < columns_; ++c) order_[c] = c;
    const std::size_t most = std::min(rows_, columns_);
    for (rank_ = 0; rank_ < most; ++rank_) {
      std::size_t row = rank_, column = rank_;
      double largest = 0.0;
      for (std::size_t i = rank_; i < rows_; ++i) {
        for (std::size_t j = rank_; j < columns_; ++j) {
          const double size = std::abs(entries_[i][j]);
          if (size > largest) {
            largest = size;
            row = i;
            column = j;
          }
        }
      }
      if (rank_ == 0) largest_pivot_ = largest;
      if (!(largest > tolerance * largest_pivot_)) return;
      smallest_pivot_ = largest;
      if (row != rank_) std::swap(entries_[row], entries_[rank_]);
      if (column != rank_) {
        for (std::size_t i = 0; i < rows_; ++i) std::swap(entries_[i][column], entries_[i][rank_]);
        std::swap(order_[column], order_[rank_]);
      }
      const double inverse = 1.0 / entries_[rank_][rank_];
      for (std::size_t i = rank_ + 1; i < rows_; ++i) {
        const double factor = entries_[i][rank_] * inverse;
        if (factor == 0.0) continue;
        for (std::size_t j = rank_ + 1; j <= columns_; ++j) entries_[i][j] -= factor * entries_[rank_][j];
      }
    }
  }

  std::size_t rank() const { return rank_; }

  // The smallest pivot over the largest; 1 for rank 0.
  double pivot_ratio() const { return rank_ == 0 ? 1.0 : smallest_pivot_ / largest_pivot_; }

  // What is left of b in the rows without a pivot: 0 if the system has a solution.
  double inconsistency() const {
    double largest = 0.0;
    for (std::size_t i = rank_; i < rows_; ++i) largest = std::max(largest, std::abs(entries_[i][columns_]));
    return largest;
  }

  // The solution whose unknowns without a pivot are 0.
  void solve(double* x) const { substitute(x, columns_, 1.0, rank_); }

  // For rank = columns - 1: x with A x = 0.
  void null_vector(double* x) const {
    substitute(x, rank_, -1.0, rank_);
    x[order_[rank_]] = 1.0;
  }

 private:
  void substitute(double* x, std::size_t right_column, double sign, std::size_t rank) const {
    for (std::size_t c = 0; c < columns_; ++c) x[c] = 0.0;
    for (std::size_t i = rank; i-- > 0;) {
      double sum = sign * entries_[i][right_column];
      for (std::size_t j = i + 1; j < rank; ++j) sum -= entries_[i][j] * x[order_[j]];
      x[order_[i]] = sum / entries_[i][i];
    }
  }

  std::size_t rows_, columns_, rank_ = 0;
  double largest_pivot_ = 0.0, smallest_pivot_ = 0.0;
  std::array<std::array<double, Size + 1>, Size> entries_;
  std::array<std::size_t, Size> order_;
};

}  // namespace tumble
