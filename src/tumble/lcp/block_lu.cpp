#include "tumble/lcp/block_lu.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

namespace tumble {
namespace {

using Index = std::size_t;

constexpr int k_natural_order_size = 16;  // up to here any order is nearly as good
constexpr Index k_max_updates = 8;
constexpr double k_smallest_update = 1e-7;  // [-] what an update leaves of a direction

double dot(const BlockLu::SparseVector& row, const std::vector<Vector3>& x) {
  double sum = 0.0;
  for (Index k = 0; k < 2; ++k) {
    if (row.row[k] >= 0) sum += tumble::dot(row.value[k], x[static_cast<Index>(row.row[k])]);
  }
  return sum;
}

// a := a - b c
inline void subtract_product(Matrix3& a, const Matrix3& b, const Matrix3& c) {
  for (Index i = 0; i < 3; ++i) {
    for (Index j = 0; j < 3; ++j) a[i][j] -= b[i][0] * c[0][j] + b[i][1] * c[1][j] + b[i][2] * c[2][j];
  }
}

inline void subtract_product(Vector3& a, const Matrix3& b, const Vector3& c) {
  for (Index i = 0; i < 3; ++i) a[i] -= b[i][0] * c[0] + b[i][1] * c[1] + b[i][2] * c[2];
}

// LU in place without exchanges, so that a change of units by powers of two changes no bit: L below the diagonal, with
// ones on it, U above, its diagonal inverted. No block is ever inverted as a whole: where stiff and free directions
// meet the digits of the free ones would go. False if a pivot is 0 or not finite.
bool factor_block(Matrix3& m) {
  m[0][0] = 1.0 / m[0][0];
  m[1][0] *= m[0][0];
  m[2][0] *= m[0][0];
  m[1][1] = 1.0 / (m[1][1] - m[1][0] * m[0][1]);
  m[1][2] -= m[1][0] * m[0][2];
  m[2][1] = (m[2][1] - m[2][0] * m[0][1]) * m[1][1];
  m[2][2] = 1.0 / ((m[2][2] - m[2][0] * m[0][2]) - m[2][1] * m[1][2]);
  return std::isfinite(m[0][0]) && std::isfinite(m[1][1]) && std::isfinite(m[2][2]);
}

// a := a U^-1
inline void divide_right(Matrix3& a, const Matrix3& lu) {
  for (Index i = 0; i < 3; ++i) {
    a[i][0] *= lu[0][0];
    a[i][1] = (a[i][1] - a[i][0] * lu[0][1]) * lu[1][1];
    a[i][2] = (a[i][2] - a[i][0] * lu[0][2] - a[i][1] * lu[1][2]) * lu[2][2];
  }
}

// a := L^-1 a
inline void divide_left(Matrix3& a, const Matrix3& lu) {
  for (Index j = 0; j < 3; ++j) {
    a[1][j] -= lu[1][0] * a[0][j];
    a[2][j] -= lu[2][0] * a[0][j] + lu[2][1] * a[1][j];
  }
}

}  // namespace

void BlockLu::order(int num_rows) {
  const auto n = static_cast<Index>(num_rows);
  position_.resize(n);
  row_at_.resize(n);
  if (num_rows <= k_natural_order_size) {
    for (Index i = 0; i < n; ++i) position_[i] = row_at_[i] = static_cast<int>(i);
    return;
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < num_rows; ++i) entries.emplace_back(i, i, 1.0);
  for (const auto& [i, j] : pairs_) {
    entries.emplace_back(i, j, 1.0);
    entries.emplace_back(j, i, 1.0);
  }
  Eigen::SparseMatrix<double> pattern(num_rows, num_rows);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(pattern, permutation);
  for (Index k = 0; k < n; ++k) {
    row_at_[k] = permutation.indices()[static_cast<Eigen::Index>(k)];
    position_[static_cast<Index>(row_at_[k])] = static_cast<int>(k);
  }
}

// Columns of the factor: what is coupled, and what elimination couples (a column passes its rows to its parent).
void BlockLu::find_columns() {
  const auto n = static_cast<Index>(num_rows_);
  std::vector<std::vector<int>>& column = columns_;
  if (column.size() < n) column.resize(n);
  for (std::vector<int>& rows : column) rows.clear();
  for (const auto& [i, j] : pairs_) {
    const int k = position_[static_cast<Index>(i)], l = position_[static_cast<Index>(j)];
    column[static_cast<Index>(std::min(k, l))].push_back(std::max(k, l));
  }
  for (Index k = 0; k < n; ++k) {
    std::sort(column[k].begin(), column[k].end());
    column[k].erase(std::unique(column[k].begin(), column[k].end()), column[k].end());
    if (column[k].empty()) continue;
    std::vector<int>& parent = column[static_cast<Index>(column[k].front())];
    parent.insert(parent.end(), column[k].begin() + 1, column[k].end());
  }
}

void BlockLu::set_pattern(int num_rows, const Pairs& pairs) {
  if (num_rows == num_rows_ && pairs == pairs_) return;
  num_rows_ = num_rows;
  pairs_ = pairs;
  order(num_rows);
  const auto n = static_cast<Index>(num_rows);

  find_columns();
  const std::vector<std::vector<int>>& column = columns_;
  column_begin_.assign(1, 0);
  column_row_.clear();
  for (Index k = 0; k < n; ++k) {
    column_row_.insert(column_row_.end(), column[k].begin(), column[k].end());
    column_begin_.push_back(static_cast<int>(column_row_.size()));
  }

  place_.resize(n);
  for (Index i = 0; i < n; ++i) place_[i] = position_[i];
  lower_begin_.resize(n);
  for (Index k = 0; k < n; ++k) lower_begin_[k] = num_rows + 2 * column_begin_[k];
  blocks_.resize(n + 2 * column_row_.size());

  // Block (row, k) for row > k of the order; block (k, row) is the next one.
  const auto place_of = [&](int row, int k) {
    const auto begin = column_row_.begin() + column_begin_[static_cast<Index>(k)];
    const auto end = column_row_.begin() + column_begin_[static_cast<Index>(k) + 1];
    const auto at = std::lower_bound(begin, end, row) - begin;
    return lower_begin_[static_cast<Index>(k)] + 2 * static_cast<int>(at);
  };
  pair_places_.clear();
  for (const auto& [i, j] : pairs) {
    const int k = position_[static_cast<Index>(i)], l = position_[static_cast<Index>(j)];
    const int place = place_of(std::max(k, l), std::min(k, l));
    if (k > l) {
      pair_places_.push_back({place, place + 1});
    } else {
      pair_places_.push_back({place + 1, place});
    }
  }
  update_begin_.assign(1, 0);
  update_target_.clear();
  for (Index k = 0; k < n; ++k) {
    for (const int row : column[k]) {
      for (const int other : column[k]) {
        if (row == other) {
          update_target_.push_back(row);
        } else if (row > other) {
          update_target_.push_back(place_of(row, other));
        } else {
          update_target_.push_back(place_of(other, row) + 1);
        }
      }
    }
    update_begin_.push_back(static_cast<int>(update_target_.size()));
  }
}

void BlockLu::clear() { std::fill(blocks_.begin(), blocks_.end(), Matrix3{}); }

bool BlockLu::factor() {
  num_updates_ = 0;
  for (Index k = 0; k < static_cast<Index>(num_rows_); ++k) {
    if (!factor_block(blocks_[k])) return false;
    const auto count = static_cast<Index>(column_begin_[k + 1] - column_begin_[k]);
    Matrix3* const coupled = blocks_.data() + lower_begin_[k];
    for (Index c = 0; c < count; ++c) {
      divide_right(coupled[2 * c], blocks_[k]);
      divide_left(coupled[2 * c + 1], blocks_[k]);
    }
    const int* target = update_target_.data() + update_begin_[k];
    for (Index r = 0; r < count; ++r) {
      for (Index c = 0; c < count; ++c) {
        subtract_product(blocks_[static_cast<Index>(*target++)], coupled[2 * r], coupled[2 * c + 1]);
      }
    }
  }
  return true;
}

bool BlockLu::update(const SparseVector& column, const SparseVector& row) {
  if (num_updates_ == k_max_updates) return false;
  if (updates_.size() == num_updates_) updates_.emplace_back();
  Update& update = updates_[num_updates_];
  update.row = row;
  update.step.assign(static_cast<Index>(num_rows_), Vector3{});
  for (Index k = 0; k < 2; ++k) {
    if (column.row[k] >= 0) update.step[static_cast<Index>(column.row[k])] = column.value[k];
  }
  solve(update.step);
  const double left = 1.0 + dot(row, update.step);
  if (!(std::abs(left) > k_smallest_update)) return false;
  for (Vector3& block : update.step) {
    for (double& entry : block) entry /= left;
  }
  ++num_updates_;
  return true;
}

void BlockLu::solve(std::vector<Vector3>& x) const {
  const auto n = static_cast<Index>(num_rows_);
  const auto at = [&](Index k) -> Vector3& { return x[static_cast<Index>(row_at_[k])]; };
  for (Index k = 0; k < n; ++k) {
    const Matrix3& lu = blocks_[k];
    Vector3& y = at(k);
    y[1] -= lu[1][0] * y[0];
    y[2] -= lu[2][0] * y[0] + lu[2][1] * y[1];
    const Matrix3* block = blocks_.data() + lower_begin_[k];
    for (int c = column_begin_[k]; c < column_begin_[k + 1]; ++c, block += 2) {
      subtract_product(at(static_cast<Index>(column_row_[static_cast<Index>(c)])), block[0], y);
    }
  }
  for (Index k = n; k-- > 0;) {
    const Matrix3& lu = blocks_[k];
    Vector3& y = at(k);
    const Matrix3* block = blocks_.data() + lower_begin_[k] + 1;
    for (int c = column_begin_[k]; c < column_begin_[k + 1]; ++c, block += 2) {
      subtract_product(y, block[0], at(static_cast<Index>(column_row_[static_cast<Index>(c)])));
    }
    y[2] *= lu[2][2];
    y[1] = (y[1] - lu[1][2] * y[2]) * lu[1][1];
    y[0] = (y[0] - lu[0][1] * y[1] - lu[0][2] * y[2]) * lu[0][0];
  }
  for (Index u = 0; u < num_updates_; ++u) {
    const double weight = dot(updates_[u].row, x);
    for (Index b = 0; b < n; ++b) {
      for (Index j = 0; j < 3; ++j) x[b][j] -= weight * updates_[u].step[b][j];
    }
  }
}

}  // namespace tumble
