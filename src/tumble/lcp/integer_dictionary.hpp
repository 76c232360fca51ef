// Pivoting without fractions and without rounding. Not a public header.
#pragma once

#include <optional>
#include <vector>

#include "tumble/lcp/rational.hpp"

namespace tumble {

// A linear system  s = A x + a  with whole numbers, rewritten by pivots: each of the m basic variables is
//   x_B(i) = (value(i) + sum_j entry(i, j) x_N(j)) / denominator(),      denominator() > 0.
// Every entry is a minor of (A, a), so that the division in each pivot leaves no rest [Edmonds 1967; Bareiss 1968], and
// no greatest common divisor is ever needed. Variables are numbered s = 0 .. m-1, x = m .. m+k-1.
class IntegerDictionary {
 public:
  // All s basic. `entries` is m x (k + 1), row after row, with a in the last column.
  IntegerDictionary(std::size_t m, std::size_t k, std::vector<Integer> entries);

  std::size_t num_rows() const { return basic_.size(); }
  std::size_t num_columns() const { return nonbasic_.size(); }
  int basic(std::size_t row) const { return basic_[row]; }
  int nonbasic(std::size_t column) const { return nonbasic_[column]; }
  const Integer& denominator() const { return denominator_; }
  const Integer& value(std::size_t row) const { return entries_[row * stride() + num_columns()]; }
  const Integer& entry(std::size_t row, std::size_t column) const { return entries_[row * stride() + column]; }

  // The row or column where a variable stands now; nothing if it stands in the other.
  std::optional<std::size_t> row_of(int variable) const;
  std::optional<std::size_t> column_of(int variable) const;

  // The basic variable of `row` and the nonbasic one of `column` change places. The entry there must not be 0.
  void pivot(std::size_t row, std::size_t column);

  // value(row) / denominator().
  Rational solution(std::size_t row) const { return Rational(value(row), denominator_); }

 private:
  std::size_t stride() const { return nonbasic_.size() + 1; }

  std::vector<int> basic_, nonbasic_;
  std::vector<Integer> entries_;
  Integer denominator_ = 1;
};

}  // namespace tumble
