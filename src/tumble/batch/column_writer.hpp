// Brings the columns of a block of drops, which come one after the other with all drops side by side, into arrays where
// each drop has its rows: N x 3 x columns. Not a public header.
#pragma once

#include <cstddef>
#include <vector>

#include "tumble/batch/drop_lanes.hpp"

namespace tumble::batch {

// Writes `count` numbers past the caches: memory that is written once need not be read before.
template <class Real>
void write_once(Real* to, const Real* from, std::size_t count);

template <class Real>
class ColumnWriter {
 public:
  // q, v: the results' arrays of all drops, or null. `columns`: kept ones of each drop.
  ColumnWriter(Real* q, Real* v, std::size_t columns);

  // Drops [first, first + count) follow; count <= k_most_drops.
  void begin(std::size_t first, std::size_t count);
  void add(const DropBlock<Real>& block);  // the next kept column
  void finish();

  static constexpr std::size_t k_most_drops = 32;

 private:
  void turn();   // the columns of the tile become part of rows
  void flush();  // the parts of rows go to the results

  static constexpr std::size_t k_tile = 8;  // columns
  Real* arrays_[2];
  std::size_t columns_, length_;  // of a row, and of a part of it that is put together in the cache
  std::size_t first_ = 0, count_ = 0;
  std::size_t begun_ = 0, put_ = 0, in_tile_ = 0;  // first column of the parts; columns in them; columns in the tile
  std::vector<Real> parts_[2];                     // k_most_drops x 3 x length_
  alignas(64) Real tile_[6][k_tile][k_most_drops];
};

}  // namespace tumble::batch
