// What one_contact_lanes_*.cpp compile, each for its instruction set and with its k_num_lanes. Everything here is in an
// unnamed namespace and inlined: a function with a name of its own could be taken by the linker for all of them. Not a
// public header.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "tumble/lcp/one_contact_formula.hpp"
#include "tumble/lcp/one_contact_lanes.hpp"
#include "tumble/math/lanes.hpp"

namespace {

using L = tumble::Lanes<double, k_num_lanes>;

TUMBLE_INLINE void store_if_wanted(double* to, std::size_t i, L::Value lanes) {
  if (to != nullptr) L::store(to + i, lanes);
}

TUMBLE_INLINE void store_bytes(void* to, std::size_t i, L::Mask lanes) {
  using Bytes = std::uint8_t __attribute__((vector_size(k_num_lanes)));
  const Bytes bytes = __builtin_convertvector(lanes, Bytes);
  if (to != nullptr) std::memcpy(static_cast<std::uint8_t*>(to) + i, &bytes, sizeof bytes);
}

// Where an array begins that may be left out.
template <class T>
TUMBLE_INLINE T* from(std::span<T> array, std::size_t first) {
  return array.empty() ? nullptr : array.data() + first;
}

TUMBLE_INLINE bool solve_block(const tumble::OneContactArrays& contacts,
                               const tumble::OneContactSolutionArrays& solutions, std::size_t first,
                               std::uint8_t* is_done) {
  double* const f_n_out = from(solutions.f_n, first);
  double* const f_t_out = from(solutions.f_t, first);
  double* const slip_speed_out = from(solutions.slip_speed, first);
  double* const residual_out = from(solutions.residual, first);
  tumble::ContactMode* const mode_out = from(solutions.mode, first);
  tumble::LcpStatus* const status_out = from(solutions.status, first);
  const L::Value zero{};
  for (std::size_t i = 0; i < 64; i += k_num_lanes) {
    const tumble::one_contact::ContactLanes<L> contact{
        L::load(contacts.A_nn.data() + first + i), L::load(contacts.A_nt.data() + first + i),
        L::load(contacts.A_tt.data() + first + i), L::load(contacts.b_n.data() + first + i),
        L::load(contacts.b_t.data() + first + i),  L::load(contacts.friction.data() + first + i)};
    const auto [f_n, f_t, slip_speed, k, is_open, is_stick, is_left] = tumble::one_contact::propose<L>(contact);
    const auto& [A_nn, A_nt, A_tt, b_n, b_t, friction] = contact;

    // `judge`.
    const L::Value f_t_size = L::absolute(f_t);
    const L::Value speed = L::larger(L::absolute(b_n), L::absolute(b_t));
    const L::Value nn_f_n = A_nn * f_n, tt_f_t = A_tt * f_t_size, A_nt_size = L::absolute(A_nt);
    const L::Value u_n = nn_f_n + A_nt * f_t + b_n;
    const L::Value u_t = A_nt * f_n + A_tt * f_t + b_t;
    const L::Value along = L::select(is_left, u_t, -u_t);
    const L::Value w_active = slip_speed + along;
    const L::Value off_active = L::select(f_t_size > zero, L::absolute(w_active), -w_active);
    const L::Value w_passive = slip_speed - along;
    const L::Value d_n = speed + L::absolute(b_n) + nn_f_n + A_nt_size * f_t_size;
    const L::Value d_t = speed + L::absolute(b_t) + A_nt_size * f_n + tt_f_t + slip_speed;
    const L::Value closed_residual = L::larger(L::absolute(u_n) / d_n, L::larger(off_active, -w_passive) / d_t);
    const L::Value residual = L::select(is_open, zero, closed_residual);
    const L::Mask is_plain_open = b_n + slip_speed <= zero + 1e300;
    const L::Mask is_plain_closed = (f_n >= zero) & (slip_speed >= zero) & (u_n <= nn_f_n) &
                                    ((w_active <= tt_f_t) | (f_t_size <= zero)) & (f_t_size <= friction * f_n) &
                                    (d_n + d_t <= L::smaller(tumble::k_largest_growth * speed, zero + 1e300)) &
                                    (residual <= zero + tumble::one_contact::k_accepted_residual);
    const L::Mask is_plain =
        (A_nn > zero) & (friction >= zero) & ((is_open & is_plain_open) | (~is_open & is_plain_closed));

    store_if_wanted(f_n_out, i, f_n);
    store_if_wanted(f_t_out, i, f_t);
    store_if_wanted(slip_speed_out, i, slip_speed);
    store_if_wanted(residual_out, i, residual);
    // 0 open, 1 stick, 2 slip left, 3 slip right.
    store_bytes(mode_out, i, ~is_open & ((is_stick & 1) | (~is_stick & (3 + is_left))));
    store_bytes(status_out, i, L::Mask{});
    store_bytes(is_done, i, is_plain);
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
