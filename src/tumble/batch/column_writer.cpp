#include "tumble/batch/column_writer.hpp"

#include <algorithm>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace tumble::batch {
namespace {

// Rows up to this length are put together as a whole, and then those of all drops in one piece.
constexpr std::size_t k_longest_whole_row = 192;
constexpr std::size_t k_part_of_row = 128;

}  // namespace

template <class Real>
void write_once(Real* to, const Real* from, std::size_t count) {
#if defined(__SSE2__)
  constexpr std::size_t k_step = 16 / sizeof(Real);
  const auto misplaced = reinterpret_cast<std::uintptr_t>(to) % 64;
  const std::size_t head =
      std::min(count, misplaced % sizeof(Real) != 0 ? count : (64 - misplaced) % 64 / sizeof(Real));
  std::memcpy(to, from, head * sizeof(Real));
  std::size_t i = head;
  for (; i + k_step <= count; i += k_step) {
    __m128i piece;
    std::memcpy(&piece, from + i, sizeof piece);
    _mm_stream_si128(reinterpret_cast<__m128i*>(to + i), piece);
  }
  std::memcpy(to + i, from + i, (count - i) * sizeof(Real));
#else
  std::memcpy(to, from, count * sizeof(Real));
#endif
}

template <class Real>
ColumnWriter<Real>::ColumnWriter(Real* q, Real* v, std::size_t columns)
    : arrays_{q, v}, columns_(columns), length_(columns <= k_longest_whole_row ? columns : k_part_of_row) {
  for (std::size_t a = 0; a < 2; ++a) {
    if (arrays_[a] != nullptr) parts_[a].resize(k_most_drops * 3 * length_);
  }
}

template <class Real>
void ColumnWriter<Real>::begin(std::size_t first, std::size_t count) {
  first_ = first;
  count_ = count;
  begun_ = put_ = in_tile_ = 0;
}

template <class Real>
void ColumnWriter<Real>::add(const DropBlock<Real>& block) {
  const Real* const rows[6] = {block.x, block.y, block.theta, block.vx, block.vy, block.omega};
  for (std::size_t r = 0; r < 6; ++r) std::memcpy(tile_[r][in_tile_], rows[r], sizeof tile_[r][0]);
  if (++in_tile_ == k_tile || put_ + in_tile_ == length_ || begun_ + put_ + in_tile_ == columns_) turn();
}

template <class Real>
void ColumnWriter<Real>::turn() {
  for (std::size_t r = 0; r < 6; ++r) {
    Real* const part = parts_[r / 3].data();
    if (arrays_[r / 3] == nullptr) continue;
    for (std::size_t i = 0; i < count_; ++i) {
      Real* const row = part + (3 * i + r % 3) * length_ + put_;
      if (in_tile_ == k_tile) {
        for (std::size_t k = 0; k < k_tile; ++k) row[k] = tile_[r][k][i];
      } else {
        for (std::size_t k = 0; k < in_tile_; ++k) row[k] = tile_[r][k][i];
      }
    }
  }
  put_ += in_tile_;
  in_tile_ = 0;
  if (put_ == length_ || begun_ + put_ == columns_) flush();
}

template <class Real>
void ColumnWriter<Real>::flush() {
  for (std::size_t a = 0; a < 2; ++a) {
    if (arrays_[a] == nullptr) continue;
    Real* const to = arrays_[a] + 3 * first_ * columns_;
    if (length_ == columns_) {
      write_once(to, parts_[a].data(), 3 * count_ * columns_);
      continue;
    }
    for (std::size_t row = 0; row < 3 * count_; ++row) {
      write_once(to + row * columns_ + begun_, parts_[a].data() + row * length_, put_);
    }
  }
  begun_ += put_;
  put_ = 0;
}

template <class Real>
void ColumnWriter<Real>::finish() {
#if defined(__SSE2__)
  _mm_sfence();  // other threads see what was written past the caches
#endif
}

template class ColumnWriter<double>;
template class ColumnWriter<float>;

}  // namespace tumble::batch
