// What drop_lanes_*.cpp compile, each for its instruction set. Everything here is inlined or in an unnamed namespace
// (math/lanes.hpp says why). Names and order of operations are those of drop/drop.cpp. Not a public header.
#pragma once

#include "tumble/batch/drop_lanes.hpp"
#include "tumble/lcp/one_contact_formula.hpp"
#include "tumble/math/lanes.hpp"
#include "tumble/math/sin_cos_reduced.hpp"

namespace {

using tumble::Lanes;
using tumble::batch::DropBlock;
using tumble::batch::MeasureBounds;
using tumble::batch::States;

// What is far from the ends of the range: products and quotients of three such numbers are too. Speeds of contacts and
// 1 / m times dt are held to it.
template <class Real>
constexpr Real k_smallest = sizeof(Real) == 8 ? Real(0x1p-200) : Real(0x1p-24);

template <class Real>
constexpr Real k_largest = 1 / k_smallest<Real>;

// Lowest corner minus centre of mass, world frame [m], and how far it is from the ground. Turns by pi/2 bring the
// square onto itself, so the reduced angle tells all but one thing: of two corners that are equally low the first
// counts, which is the left one (that at 225 degrees of the frame of r) but in the quadrant of n = 1 modulo 4.
template <class L>
struct LowestCorner {
  typename L::Value r_x, r_y;
};

template <class L>
TUMBLE_INLINE LowestCorner<L> lowest_corner(typename L::Value theta, typename L::Value half_l) {
  const auto [r, tail, n_bits] = tumble::reduce_moderate_angle<L>(theta);
  const auto sh = tumble::sin_polynomial<L>(r, tail) * half_l;
  const auto ch = tumble::cos_polynomial<L>(r, tail) * half_l;
  const auto left_y = -sh - ch;
  const auto right_y = sh - ch;
  const auto is_left = (left_y < right_y) | ((left_y <= right_y) & ((n_bits & 3) != 1));
  return {L::select(is_left, right_y, -left_y), L::smaller(left_y, right_y)};
}

template <class L>
struct Forces {
  typename L::Value f_n, f_t;  // 0 where the corner is not in contact or opens
  typename L::Mask is_ordinary;
};

// form_lcp and solve_one_contact. J_n = (0, 1, r_x), J_t = (1, 0, -r_y).
template <class L>
TUMBLE_INLINE Forces<L> contact_forces(const DropBlock<typename L::Real>& block, std::size_t i,
                                       const LowestCorner<L>& corner, typename L::Mask is_near, typename L::Value vx,
                                       typename L::Value vy, typename L::Value omega) {
  using Real = typename L::Real;
  const auto zero = L::all(0);
  const auto inverse_m = L::load(block.inverse_m + i), inverse_I = L::load(block.inverse_I + i);
  const auto dt = L::load(block.dt + i), bounce = L::load(block.bounce + i);
  const auto J_n = corner.r_x, J_t = -corner.r_y;
  const auto A_nn = (inverse_m + J_n * (inverse_I * J_n)) * dt;
  const auto A_nt = (zero + J_n * (inverse_I * J_t)) * dt;
  const auto A_tt = (inverse_m + J_t * (inverse_I * J_t)) * dt;
  const auto b_n = (bounce * vy - dt * L::load(block.g + i)) + J_n * (bounce * omega);
  const auto b_t = vx + J_t * omega;
  const tumble::one_contact::ContactLanes<L> contact{A_nn, A_nt, A_tt, b_n, b_t, L::load(block.mu + i)};
  const auto solution = tumble::one_contact::propose<L>(contact);

  // A of a square is well conditioned: det(A) m^2 / dt^2 = 4 for every angle. So the solution is good to some 1e-15
  // times the growth A_nn / k, and its status is `solved`, unless numbers come near the ends of the range.
  const auto speed = L::larger(L::absolute(b_n), L::absolute(b_t));
  const auto is_ordinary = (speed <= L::all(k_largest<Real>)) &
                           (solution.is_open | ((speed >= L::all(k_smallest<Real>)) &
                                                (solution.is_stick | (solution.k >= A_nn * Real(0x1p-10)))));
  return {L::keep(is_near, solution.f_n), L::keep(is_near, solution.f_t), is_ordinary};
}

// The columns and counts that measures are made of, for the step that leads to column `column`.
template <class L>
TUMBLE_INLINE void measure(DropBlock<typename L::Real>& block, States<typename L::Real> states, std::size_t i,
                           typename L::Value f_n, int column, const MeasureBounds<typename L::Real>& bounds) {
  using Real = typename L::Real;
  const auto zero = L::all(0), one = L::all(1), now = L::all(static_cast<Real>(column));
  const auto is_closed = f_n > zero;
  L::store(block.last_contact + i, L::select(is_closed, now, L::load(block.last_contact + i)));
  L::store(block.max_force_time + i, L::larger(f_n * L::load(block.dt + i), L::load(block.max_force_time + i)));
  const auto was_closed = L::load(block.was_closed + i);
  L::store(block.impacts + i, L::load(block.impacts + i) + L::keep(is_closed, one - was_closed));
  L::store(block.was_closed + i, L::keep(is_closed, one));

  const auto vx = L::load(states[3] + i), vy = L::load(states[4] + i), omega = L::load(states[5] + i);
  const auto speed_squared = (vx * vx + vy * vy) + L::load(block.gyration + i) * (omega * omega);
  const auto is_moving = speed_squared > L::all(bounds.rest_speed_squared);
  L::store(block.last_moving + i, L::select(is_moving, now, L::load(block.last_moving + i)));
  const auto x = L::load(states[0] + i), escape = L::load(block.escape + i);
  const auto escapes = ((x < L::all(bounds.x_min)) | (x > L::all(bounds.x_max))) & (escape < zero);
  L::store(block.escape + i, L::select(escapes, now, escape));
}

// One step of the drops in the lanes from i on: `step` of drop.cpp.
template <class L, bool measures>
TUMBLE_INLINE void advance_lanes(DropBlock<typename L::Real>& block, States<typename L::Real> from,
                                 States<typename L::Real> to, std::size_t i, int column,
                                 const MeasureBounds<typename L::Real>* bounds) {
  using Real = typename L::Real;
  const auto zero = L::all(0);
  auto x = L::load(from[0] + i), y = L::load(from[1] + i), theta = L::load(from[2] + i);
  auto vx = L::load(from[3] + i), vy = L::load(from[4] + i), omega = L::load(from[5] + i);
  const auto dt = L::load(block.dt + i);
  auto acceleration_x = zero, acceleration_y = -L::load(block.g + i), acceleration_theta = zero;
  auto lift = zero, f_n = zero;
  const auto is_low = y <= L::load(block.clear_height + i);
  if (L::any(is_low)) {
    const auto delta = L::load(block.delta + i);
    const auto corner = lowest_corner<L>(theta, L::load(block.half_l + i));
    const auto is_moderate = L::absolute(theta) < L::all(tumble::HalfPi<Real>::largest_angle);
    const auto is_near = (y + corner.r_y < delta) & is_low;
    auto is_ordinary = is_moderate | !is_low;
    if (L::any(is_near)) {
      const auto forces = contact_forces<L>(block, i, corner, is_near, vx, vy, omega);
      f_n = forces.f_n;
      acceleration_x = acceleration_x + L::load(block.inverse_m + i) * (zero + forces.f_t);
      acceleration_y = acceleration_y + L::load(block.inverse_m + i) * f_n;
      acceleration_theta =
          acceleration_theta + L::load(block.inverse_I + i) * (corner.r_x * f_n + -corner.r_y * forces.f_t);
      lift = L::keep(is_near, delta);
      is_ordinary = is_ordinary & (forces.is_ordinary | !is_near);
    }
    L::store(block.is_ordinary + i, L::keep(is_ordinary, L::load(block.is_ordinary + i)));
  }
  vx = vx + dt * acceleration_x;
  vy = vy + dt * acceleration_y;
  omega = omega + dt * acceleration_theta;
  x = x + dt * vx;
  y = (y + dt * vy) + lift;
  theta = theta + dt * omega;
  L::store(to[3] + i, vx);
  L::store(to[4] + i, vy);
  L::store(to[5] + i, omega);
  L::store(to[0] + i, x);
  L::store(to[1] + i, y);
  L::store(to[2] + i, theta);
  if constexpr (measures) measure<L>(block, to, i, f_n, column, *bounds);
}

template <class L, bool measures>
TUMBLE_INLINE void advance_block(DropBlock<typename L::Real>& block, States<typename L::Real> from,
                                 States<typename L::Real> to, std::size_t size, int first_column, int num_steps,
                                 const MeasureBounds<typename L::Real>* bounds) {
  for (int k = 1; k <= num_steps; ++k) {
    for (std::size_t i = 0; i < size; i += L::k_count) {
      advance_lanes<L, measures>(block, from, to, i, first_column + k, bounds);
    }
    from = to;
  }
}

template <class L>
TUMBLE_INLINE void advance(DropBlock<typename L::Real>& block, States<typename L::Real> from,
                           States<typename L::Real> to, std::size_t size, int first_column, int num_steps,
                           const MeasureBounds<typename L::Real>* bounds) {
  if (bounds == nullptr) {
    advance_block<L, false>(block, from, to, size, first_column, num_steps, bounds);
  } else {
    advance_block<L, true>(block, from, to, size, first_column, num_steps, bounds);
  }
}

}  // namespace
