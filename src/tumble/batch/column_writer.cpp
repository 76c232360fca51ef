#include "tumble/batch/column_writer.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace tumble::batch {
namespace {

#if defined(__SSE2__)

constexpr bool k_can_pass_caches = true;

inline void stream(double* to, double a, double b) { _mm_stream_pd(to, _mm_set_pd(b, a)); }

template <class At>
inline void stream_line(double* to, At at) {
  for (std::size_t k = 0; k < 8; k += 2) stream(to + k, at(k), at(k + 1));
}

template <class At>
inline void stream_line(float* to, At at) {
  for (std::size_t k = 0; k < 16; k += 4) _mm_stream_ps(to + k, _mm_set_ps(at(k + 3), at(k + 2), at(k + 1), at(k)));
}

void make_streams_visible() { _mm_sfence(); }

#else

constexpr bool k_can_pass_caches = false;

template <class Real, class At>
void stream_line(Real* to, At at) {
  for (std::size_t k = 0; k < 64 / sizeof(Real); ++k) to[k] = at(k);
}

void make_streams_visible() {}

#endif

}  // namespace

template <class Real>
void write_past_caches(Real* to, const Real* from, std::size_t count) {
  constexpr std::size_t k_line = 64 / sizeof(Real);
  for (std::size_t i = 0; i < count; i += k_line) stream_line(to + i, [&](std::size_t k) { return from[i + k]; });
  make_streams_visible();
}

template <class Real>
void ColumnWriter<Real>::begin(std::size_t first, std::size_t count) {
  first_ = first;
  count_ = count;
  added_ = written_ = 0;
}

template <class Real>
void ColumnWriter<Real>::add() {
  ++added_;
  if (added_ != columns_ && added_ - written_ != k_new) return;
  write_lines();
  std::memcpy(held_[0], held_[k_new], k_line * sizeof held_[0]);
  written_ = added_;
  if (added_ == columns_) make_streams_visible();
}

template <class Real>
void ColumnWriter<Real>::write_lines() {
  const Columns columns{columns_, written_, added_};  // a copy: the compiler could not know that rows do not change it
  for (std::size_t a = 0; a < 2; ++a) {
    if (arrays_[a] == nullptr) continue;
    Real* row = arrays_[a] + 3 * first_ * columns.all;
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t c = 0; c < 3; ++c, row += columns.all) write_row(row, &held_[k_line][3 * a + c][i], columns);
    }
  }
}

// What has become ready of one row; `held` is its number in column `written`, and those before and after it are k_apart
// from each other.
template <class Real>
inline void ColumnWriter<Real>::write_row(Real* row, const Real* held, const Columns& columns) {
  constexpr std::ptrdiff_t k_apart = 6 * k_most_drops;
  const auto [all, written, added] = columns;
  const std::uintptr_t past = reinterpret_cast<std::uintptr_t>(row) % 64;
  const bool has_lines = k_can_pass_caches && past % sizeof(Real) == 0;
  const std::size_t head = has_lines ? (64 - past) % 64 / sizeof(Real) : 0;  // columns before the first line
  // The columns before number k are written: whole lines of them, `written` being a multiple of k_line.
  std::size_t k = written == 0 || head == 0 ? written : written - k_line + head;
  const Real* at = held + (static_cast<std::ptrdiff_t>(k) - static_cast<std::ptrdiff_t>(written)) * k_apart;
  if (written == 0) {
    for (; k < std::min(head, added); ++k, at += k_apart) row[k] = *at;
  }
  for (; has_lines && k + k_line <= added; k += k_line, at += k_line * k_apart) {
    stream_line(row + k, [&](std::size_t j) { return at[j * k_apart]; });
  }
  if (has_lines && added != all) return;
  for (; k < added; ++k, at += k_apart) row[k] = *at;
}

template void write_past_caches(double*, const double*, std::size_t);
template void write_past_caches(float*, const float*, std::size_t);
template class ColumnWriter<double>;
template class ColumnWriter<float>;

}  // namespace tumble::batch
