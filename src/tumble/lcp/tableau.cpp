#include "tumble/lcp/tableau.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tumble/lcp/elimination.hpp"

namespace tumble {

void Tableau::start(const ScaledProblem& problem) {
  n_ = static_cast<int>(problem.size());
  stride_ = (n_ + 2 + 3) / 4 * 4;
  const auto n = static_cast<std::size_t>(n_);
  entries_.resize(n * static_cast<std::size_t>(stride_));
  sizes_.resize(n);
  basic_.resize(n);
  column_entries_.resize(n);
  position_.assign(2 * n + 1, -1);
  for (int j = 0; j <= n_; ++j) position_[n_ + j] = j;
  for (int i = 0; i < n_; ++i) {
    double* row = row_begin(i);
    const double* M = problem.M.data() + i * n_;
    for (int j = 0; j < n_; ++j) row[j] = -M[j];
    row[n_] = -1.0;
    row[n_ + 1] = problem.q[i];
    std::fill(row + n_ + 2, row + stride_, 0.0);
    sizes_[i] = std::abs(problem.q[i]);
    basic_[i] = i;
  }
}

int Tableau::row_of_smallest_value() const {
  int row = 0;
  for (int i = 1; i < n_; ++i) {
    if (value(i) < value(row)) row = i;
  }
  return row;
}

double Tableau::entry(int row, int variable) const {
  if (position_[variable] < 0) return basic_[row] == variable ? 1.0 : 0.0;
  return row_begin(row)[position_[variable]];
}

void Tableau::enter(int entering) {
  entering_ = entering;
  const double* from = entries_.data() + position_[entering];
  for (int i = 0; i < n_; ++i) column_entries_[i] = from[i * stride_];
}

std::optional<int> Tableau::blocking_row(double pivot_tolerance, bool has_ties) const {
  // Of the sizes of the terms summed so far: some 50 rounding errors.
  const double round_off = has_ties ? 1e-14 : 0.0;
  double largest = 0.0;
  for (const double entry : column_entries_) largest = std::max(largest, std::abs(entry));
  const double smallest_pivot = pivot_tolerance * largest;
  double step = 0.0;
  int row = -1;
  for (int i = 0; i < n_; ++i) {
    if (column_entries_[i] <= smallest_pivot) continue;
    const double ratio = std::max(value(i), 0.0) / column_entries_[i];
    if (row < 0 || ratio < step) {
      row = i;
      step = ratio;
    }
  }
  if (row < 0) return std::nullopt;
  const double step_error = round_off * sizes_[row] / column_entries_[row];
  for (int i = 0; i < n_; ++i) {
    const double pivot = column_entries_[i];
    if (pivot <= smallest_pivot) continue;
    if (std::max(value(i), 0.0) > (step + step_error) * pivot + round_off * sizes_[i]) continue;
    if (basic_[i] == z0()) return i;
    if (pivot > column_entries_[row]) row = i;
  }
  return row;
}

int Tableau::pivot(int row) {
  const int leaving = basic_[row];
  const int column = position_[entering_];
  const double pivot_entry = column_entries_[row];
  double* pivot_row = row_begin(row);
  sizes_[row] /= std::abs(pivot_entry);
  for (int j = 0; j < stride_; ++j) pivot_row[j] /= pivot_entry;
  pivot_row[column] = 1.0 / pivot_entry;  // the leaving variable takes the column of the entering one
  for (int i = 0; i < n_; ++i) {
    if (i == row || column_entries_[i] == 0.0) continue;
    row_begin(i)[column] = 0.0;
    sizes_[i] = std::max(sizes_[i], std::abs(column_entries_[i]) * sizes_[row]);
  }
  column_entries_[row] = 0.0;
  eliminate(entries_.data(), n_, stride_, pivot_row, column_entries_.data());
  basic_[row] = entering_;
  position_[leaving] = column;
  position_[entering_] = -1;
  return leaving;
}

void Tableau::basic_z(std::vector<std::uint8_t>& is_basic) const {
  is_basic.assign(static_cast<std::size_t>(n_), 0);
  for (const int variable : basic_) {
    if (n_ <= variable && variable < z0()) is_basic[variable - n_] = 1;
  }
}

void Tableau::z_values(std::vector<double>& z) const {
  z.assign(static_cast<std::size_t>(n_), 0.0);
  for (int i = 0; i < n_; ++i) {
    if (n_ <= basic_[i] && basic_[i] < z0()) z[basic_[i] - n_] = value(i);
  }
}

void Tableau::z_direction(std::vector<double>& direction) const {
  direction.assign(static_cast<std::size_t>(n_), 0.0);
  if (n_ <= entering_ && entering_ < z0()) direction[entering_ - n_] = 1.0;
  for (int i = 0; i < n_; ++i) {
    if (n_ <= basic_[i] && basic_[i] < z0()) direction[basic_[i] - n_] = std::max(-column_entries_[i], 0.0);
  }
}

}  // namespace tumble
