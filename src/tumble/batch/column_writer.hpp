// Brings the columns of a block of drops, which come one after the other with all drops side by side, into arrays where
// each drop has its rows: N x 3 x columns. Not a public header.
#pragma once

#include <cstddef>

#include "tumble/batch/drop_lanes.hpp"

namespace tumble::batch {

// What is written once and not read soon goes to memory past the caches, where the processor can do that: else each
// line of memory would be read first. That takes whole lines of 64 bytes, and rows begin anywhere in a line. So the
// latest columns are held back, and of each row a line is written once all of it is there; only what shares a line with
// a neighbour goes through the cache.
template <class Real>
class ColumnWriter {
 public:
  // q, v: the results' arrays of all drops, or null. `columns`: kept ones of each drop.
  ColumnWriter(Real* q, Real* v, std::size_t columns) : arrays_{q, v}, columns_(columns) {}

  // Drops [first, first + count) follow, count <= k_most_drops: all their columns, one by one. `next` is where the
  // states of the next one are to be put, `add` says that they are there; those of the one before are kept meanwhile.
  void begin(std::size_t first, std::size_t count);
  States<Real> next() { return {held_[k_line + (added_ - written_)][0], k_most_drops}; }
  void add();

  static constexpr std::size_t k_most_drops = 32;  // what is held back, 36 kB, stays in the caches next to the core

 private:
  struct Columns {
    std::size_t all, written, added;
  };
  void write_lines();
  static void write_row(Real* row, const Real* held, const Columns& columns);

  static constexpr std::size_t k_line = 64 / sizeof(Real);
  static constexpr std::size_t k_new = 2 * k_line;       // columns from one writing to the next
  static constexpr std::size_t k_held = k_line + k_new;  // and those of a line that was begun before
  Real* arrays_[2];
  std::size_t columns_, first_ = 0, count_ = 0;
  std::size_t added_ = 0, written_ = 0;             // columns so far; columns when lines were last written
  alignas(64) Real held_[k_held][6][k_most_drops];  // the columns written_ - k_line, ..., added_ - 1
};

// `count` numbers past the caches, `to` being the beginning of a line and `count` a multiple of 16 bytes.
template <class Real>
void write_past_caches(Real* to, const Real* from, std::size_t count);

}  // namespace tumble::batch
