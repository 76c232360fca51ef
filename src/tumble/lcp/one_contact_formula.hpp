// `propose_one_contact` for lanes: all ways are computed, one is chosen. The same operations, so the same bits. Not a
// public header.
#pragma once

#include "tumble/math/lanes.hpp"

namespace tumble::one_contact {

template <class L>
struct ContactLanes {
  typename L::Value A_nn, A_nt, A_tt, b_n, b_t, friction;
};

template <class L>
struct ProposedLanes {
  typename L::Value f_n, f_t, slip_speed;  // of a closed contact; all 0 but |b_t| where it opens
  typename L::Value k;                     // what f_n is divided by where the contact slips
  typename L::Mask is_open, is_stick, is_left;
};

template <class L>
TUMBLE_INLINE ProposedLanes<L> propose(const ContactLanes<L>& c) {
  const auto zero = L::all(0);
  const auto det = c.A_nn * c.A_tt - c.A_nt * c.A_nt;
  const auto F_n = c.A_nt * c.b_t - c.A_tt * c.b_n;
  const auto F_t = c.A_nt * c.b_n - c.A_nn * c.b_t;
  const auto cone_F_n = c.friction * F_n;
  const auto is_open = c.b_n >= zero;
  const auto F_t_size = L::absolute(F_t);
  const auto is_stick = F_t_size <= cone_F_n;
  const auto is_left = F_t > zero;
  const auto pull = L::select(is_left, c.friction, -c.friction);
  const auto k = c.A_nn + pull * c.A_nt;
  const auto divisor = L::select(is_stick, det, k);
  const auto closed_f_n = L::select(is_stick, F_n, -c.b_n) / divisor;
  const auto other = L::select(is_stick, F_t, F_t_size - cone_F_n) / divisor;
  const auto f_n = L::select(is_open, zero, closed_f_n);
  const auto f_t = L::select(is_open, zero, L::select(is_stick, other, pull * closed_f_n));
  const auto slip_speed = L::select(is_open, L::absolute(c.b_t), L::select(is_stick, zero, other));
  return {f_n, f_t, slip_speed, k, is_open, is_stick, is_left};
}

}  // namespace tumble::one_contact
