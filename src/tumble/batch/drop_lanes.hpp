// The document's step for many drops side by side, in the lanes of vector registers. One translation unit per
// instruction set (drop_lanes_*.cpp) makes the same template. Not a public header.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tumble/math/instruction_set.hpp"

namespace tumble::batch {

// Drops that run together, an array for each of their numbers, small enough to stay in the first-level cache.
template <class Real>
struct DropBlock {
  static constexpr std::size_t k_capacity = 128;
  using Array = Real[k_capacity];

  // What the step needs of the parameters.
  alignas(64) Array half_l, inverse_m, inverse_I, mu, bounce /* 1 + eps */, dt, delta, g;
  alignas(64) Array clear_height;  // above it no corner is within delta, whatever the angle

  // 1 while all that the drop did was ordinary, else 0: see `advance_drops`.
  alignas(64) Array is_ordinary;

  // What measures are made of. Columns are numbered as in drop::Trajectory; -1 is none.
  alignas(64) Array gyration;  // l^2 / 6 [m^2]
  alignas(64) Array last_contact, impacts, max_force_time /* max f_n dt */, was_closed /* 0 or 1 */,
      last_moving, escape;
};

// Bounds for measures.
template <class Real>
struct MeasureBounds {
  Real rest_speed_squared, x_min, x_max;
};

// x, y, theta, vx, vy, omega of drops side by side: six arrays, `stride` numbers apart.
template <class Real>
struct States {
  Real* first;
  std::size_t stride;

  Real* operator[](std::size_t component) const { return first + component * stride; }
};

// `num_steps` steps of `size` drops, >= 1, of which the first leads from column `first_column`, where the states are
// those in `from`, to `to`, and the others go on there. `bounds` null: without measures. The bits
// are those of drop::step. That holds for what is ordinary: |theta| moderate, sizes of forces and speeds far from the
// ends of the range, contacts that are not all but singular. A drop for which one step was not is marked; its state
// means nothing then. Beyond `size`, up to the next multiple of k_padding, the arrays hold anything harmless.
template <class Real>
using AdvanceDrops = void(DropBlock<Real>& block, States<Real> from, States<Real> to, std::size_t size,
                          int first_column, int num_steps, const MeasureBounds<Real>* bounds);

constexpr std::size_t k_padding = 16;  // no instruction set has more lanes

AdvanceDrops<double> advance_drops_scalar, advance_drops_baseline, advance_drops_avx2, advance_drops_avx512;
AdvanceDrops<float> advance_drops_scalar, advance_drops_baseline, advance_drops_avx2, advance_drops_avx512;

template <class Real>
AdvanceDrops<Real>* advance_drops(InstructionSet set) {
#if TUMBLE_HAS_X86_SETS
  if (set == InstructionSet::avx512) return advance_drops_avx512;
  if (set == InstructionSet::avx2) return advance_drops_avx2;
#endif
  if (set == InstructionSet::scalar) return advance_drops_scalar;
  return advance_drops_baseline;
}

}  // namespace tumble::batch
