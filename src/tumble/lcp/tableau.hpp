// The tableau of Lemke's method. Not a public header.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tumble/lcp/scaled_problem.hpp"

namespace tumble {

// The tableau of  w - M z - e z0 = q  for a scaled problem. Variables are numbered w = 0 .. n-1, z = n .. 2n-1, z0 =
// 2n. Basic variables have unit columns, so only the n + 1 columns of the nonbasic ones are kept, and one of values.
class Tableau {
 public:
  // z = 0: all w basic. Allocates nothing once warm.
  void start(const ScaledProblem& problem);

  int z0() const { return 2 * n_; }
  int complement_of(int variable) const { return variable < n_ ? variable + n_ : variable - n_; }
  int row_of_smallest_value() const;
  int basic(int row) const { return basic_[row]; }
  double value(int row) const { return row_begin(row)[n_ + 1]; }

  // The entry of any variable, basic or not, in a row.
  double entry(int row, int variable) const;

  // Chooses the variable that is to enter, and copies its column.
  void enter(int entering);

  // The row whose basic variable first reaches 0 when the entering one grows; nothing if none does (a ray). Values that
  // differ by no more than their round-off tie, if `has_ties`. Ties go to z0, else to the largest pivot: in floating
  // point that loses less than a lexicographic rule.
  std::optional<int> blocking_row(double pivot_tolerance, bool has_ties) const;

  // Makes the chosen variable basic in `row`; returns the variable that leaves.
  int pivot(int row);

  void basic_z(std::vector<std::uint8_t>& is_basic) const;
  void z_values(std::vector<double>& z) const;

  // How z changes while the chosen variable grows by 1.
  void z_direction(std::vector<double>& direction) const;

 private:
  const double* row_begin(int row) const { return entries_.data() + row * stride_; }
  double* row_begin(int row) { return entries_.data() + row * stride_; }

  int n_ = 0;
  int stride_ = 0;  // n + 2, padded
  int entering_ = 0;
  std::vector<double> entries_;  // columns: n + 1 nonbasic variables, values, padding
  std::vector<double> sizes_;    // of the terms that the values are sums of; their round-off is proportional to it
  std::vector<int> basic_;       // the basic variable of each row
  std::vector<int> position_;    // of each of the 2n + 1 variables: its column if nonbasic, -1 if basic
  std::vector<double> column_entries_;
};

}  // namespace tumble
