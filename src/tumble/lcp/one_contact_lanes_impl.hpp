// What one_contact_lanes_*.cpp compile, each for its instruction set and with its k_num_lanes. Everything here is in an
// unnamed namespace and inlined: a function with a name of its own could be taken by the linker for all of them. Not a
// public header.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "tumble/lcp/one_contact_lanes.hpp"

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors as arguments of functions, all of which are inlined
#endif

namespace {

#define TUMBLE_INLINE inline __attribute__((always_inline))

struct V {
  using Lanes = double __attribute__((vector_size(k_num_lanes * 8)));
  using Mask = std::int64_t __attribute__((vector_size(k_num_lanes * 8)));  // 0 or -1 in each lane
  using Bytes = std::uint8_t __attribute__((vector_size(k_num_lanes)));

  static TUMBLE_INLINE Lanes load(const double* from) {
    Lanes lanes;
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
  }
  static TUMBLE_INLINE void store(double* to, Lanes lanes) {
    if (to != nullptr) std::memcpy(to, &lanes, sizeof lanes);
  }
  static TUMBLE_INLINE void store_bytes(void* to, Mask lanes) {
    const Bytes bytes = __builtin_convertvector(lanes, Bytes);
    if (to != nullptr) std::memcpy(to, &bytes, sizeof bytes);
  }
  static TUMBLE_INLINE Lanes select(Mask mask, Lanes a, Lanes b) { return mask ? a : b; }
  static TUMBLE_INLINE Lanes absolute(Lanes x) { return (Lanes)((Mask)x & INT64_MAX); }
  static TUMBLE_INLINE Lanes smaller(Lanes a, Lanes b) { return select(a < b, a, b); }
  static TUMBLE_INLINE Lanes larger(Lanes a, Lanes b) { return select(a > b, a, b); }
};

// Where an array begins that may be left out.
template <class T>
TUMBLE_INLINE T* from(std::span<T> array, std::size_t first) {
  return array.empty() ? nullptr : array.data() + first;
}

TUMBLE_INLINE bool solve_block(const tumble::OneContactArrays& contacts,
                               const tumble::OneContactSolutionArrays& solutions, std::size_t first,
                               std::uint8_t* is_done) {
  using Lanes = V::Lanes;
  using Mask = V::Mask;
  double* const f_n_out = from(solutions.f_n, first);
  double* const f_t_out = from(solutions.f_t, first);
  double* const slip_speed_out = from(solutions.slip_speed, first);
  double* const residual_out = from(solutions.residual, first);
  tumble::ContactMode* const mode_out = from(solutions.mode, first);
  tumble::LcpStatus* const status_out = from(solutions.status, first);
  const Lanes zero{};
  for (std::size_t i = 0; i < 64; i += k_num_lanes) {
    const Lanes A_nn = V::load(contacts.A_nn.data() + first + i);
    const Lanes A_nt = V::load(contacts.A_nt.data() + first + i);
    const Lanes A_tt = V::load(contacts.A_tt.data() + first + i);
    const Lanes b_n = V::load(contacts.b_n.data() + first + i);
    const Lanes b_t = V::load(contacts.b_t.data() + first + i);
    const Lanes friction = V::load(contacts.friction.data() + first + i);

    // `solve_one_contact`, both ways computed, one chosen.
    const Lanes det = A_nn * A_tt - A_nt * A_nt;
    const Lanes F_n = A_nt * b_t - A_tt * b_n;
    const Lanes F_t = A_nt * b_n - A_nn * b_t;
    const Lanes cone_F_n = friction * F_n;
    const Mask is_open = b_n >= zero;
    const Lanes F_t_size = V::absolute(F_t);
    const Mask is_stick = F_t_size <= cone_F_n;
    const Mask is_left = F_t > zero;
    const Lanes pull = V::select(is_left, friction, -friction);
    const Lanes k = A_nn + pull * A_nt;
    const Lanes divisor = V::select(is_stick, det, k);
    const Lanes closed_f_n = V::select(is_stick, F_n, -b_n) / divisor;
    const Lanes other = V::select(is_stick, F_t, F_t_size - cone_F_n) / divisor;
    const Lanes f_n = V::select(is_open, zero, closed_f_n);
    const Lanes f_t = V::select(is_open, zero, V::select(is_stick, other, pull * closed_f_n));
    const Lanes slip_speed = V::select(is_open, V::absolute(b_t), V::select(is_stick, zero, other));

    // `judge`.
    const Lanes f_t_size = V::absolute(f_t);
    const Lanes speed = V::larger(V::absolute(b_n), V::absolute(b_t));
    const Lanes nn_f_n = A_nn * f_n, tt_f_t = A_tt * f_t_size, A_nt_size = V::absolute(A_nt);
    const Lanes u_n = nn_f_n + A_nt * f_t + b_n;
    const Lanes u_t = A_nt * f_n + A_tt * f_t + b_t;
    const Lanes along = V::select(is_left, u_t, -u_t);
    const Lanes w_active = slip_speed + along;
    const Lanes off_active = V::select(f_t_size > zero, V::absolute(w_active), -w_active);
    const Lanes w_passive = slip_speed - along;
    const Lanes d_n = speed + V::absolute(b_n) + nn_f_n + A_nt_size * f_t_size;
    const Lanes d_t = speed + V::absolute(b_t) + A_nt_size * f_n + tt_f_t + slip_speed;
    const Lanes closed_residual = V::larger(V::absolute(u_n) / d_n, V::larger(off_active, -w_passive) / d_t);
    const Lanes residual = V::select(is_open, zero, closed_residual);
    const Mask is_plain_open = b_n + slip_speed <= zero + 1e300;
    const Mask is_plain_closed = (f_n >= zero) & (slip_speed >= zero) & (u_n <= nn_f_n) &
                                 ((w_active <= tt_f_t) | (f_t_size <= zero)) & (f_t_size <= friction * f_n) &
                                 (d_n + d_t <= V::smaller(tumble::k_largest_growth * speed, zero + 1e300)) &
                                 (residual <= zero + tumble::one_contact::k_accepted_residual);
    const Mask is_plain =
        (A_nn > zero) & (friction >= zero) & ((is_open & is_plain_open) | (~is_open & is_plain_closed));

    V::store(f_n_out == nullptr ? nullptr : f_n_out + i, f_n);
    V::store(f_t_out == nullptr ? nullptr : f_t_out + i, f_t);
    V::store(slip_speed_out == nullptr ? nullptr : slip_speed_out + i, slip_speed);
    V::store(residual_out == nullptr ? nullptr : residual_out + i, residual);
    // 0 open, 1 stick, 2 slip left, 3 slip right.
    V::store_bytes(mode_out == nullptr ? nullptr : mode_out + i,
                   ~is_open & ((is_stick & 1) | (~is_stick & (3 + is_left))));
    V::store_bytes(status_out == nullptr ? nullptr : status_out + i, Mask{});
    V::store_bytes(is_done + i, is_plain);
  }
  std::uint64_t all_done = ~std::uint64_t{0};
  for (std::size_t i = 0; i < 64; i += 8) {
    std::uint64_t eight;
    std::memcpy(&eight, is_done + i, 8);
    all_done &= eight;
  }
  return all_done == ~std::uint64_t{0};
}

}  // namespace
