// LU factors of a sparse matrix of 3 x 3 blocks with a symmetric pattern, one row of blocks per body. Not a public
// header.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tumble/math/vector.hpp"

namespace tumble {

using Matrix3 = std::array<Vector3, 3>;  // rows

// Without exchanges of rows: for matrices whose symmetric part is dominated by a positive definite one, which those of
// contacts with a ridge are but for slip under much friction; the caller judges what comes out. The order of
// elimination (approximate minimum degree) and the pattern of the factors are found once per pattern.
class BlockLu {
 public:
  // The blocks other than those on the diagonal: pairs of rows, (i, j) with i < j, sorted, each once.
  using Pairs = std::vector<std::array<int, 2>>;

  void set_pattern(int num_rows, const Pairs& pairs);
  void clear();  // all blocks to 0

  Matrix3& diagonal(int i) { return blocks_[static_cast<std::size_t>(place_[static_cast<std::size_t>(i)])]; }
  // Block (i, j) and block (j, i) of pair number p.
  Matrix3& upper(std::size_t p) { return blocks_[static_cast<std::size_t>(pair_places_[p][0])]; }
  Matrix3& lower(std::size_t p) { return blocks_[static_cast<std::size_t>(pair_places_[p][1])]; }

  // In place. False if a pivot is 0 or not finite.
  bool factor();

  // Of two rows of blocks, or of one (then the other is -1), the entries of a vector that are not 0.
  struct SparseVector {
    std::array<int, 2> row{-1, -1};
    std::array<Vector3, 2> value{};
  };

  // Factors of A + column row' from those of A [Sherman & Morrison 1950]. False, and nothing changed, if that would
  // lose more than half of the digits, or has been done so often since `factor` that this costs less.
  bool update(const SparseVector& column, const SparseVector& row);

  // x := A^-1 x.
  void solve(std::vector<Vector3>& x) const;

 private:
  void order(int num_rows);
  void find_columns();

  std::vector<std::vector<int>> columns_;  // of the factor, per step of elimination
  int num_rows_ = -1;
  Pairs pairs_;
  std::vector<int> position_, row_at_;             // row -> place in the order of elimination, and back
  std::vector<int> place_;                         // row -> its diagonal block
  std::vector<std::array<int, 2>> pair_places_;    // pair -> its blocks
  std::vector<int> column_begin_, column_row_;     // per step k: the later steps coupled with it, increasing
  std::vector<int> lower_begin_;                   // per step k: first of its blocks (r, k); (k, r) follow in turn
  std::vector<int> update_begin_, update_target_;  // per step k: the blocks that its elimination changes
  std::vector<Matrix3> blocks_;                    // diagonal blocks first, in the order of elimination
  struct Update {
    SparseVector row;
    std::vector<Vector3> step;  // x := x - (row . x) step
  };
  std::vector<Update> updates_;  // the first num_updates_ of them, in turn
  std::size_t num_updates_ = 0;
};

}  // namespace tumble
