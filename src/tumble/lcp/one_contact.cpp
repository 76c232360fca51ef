#include "tumble/lcp/one_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "tumble/lcp/one_contact_lanes.hpp"
#include "tumble/math/format.hpp"
#include "tumble/math/instruction_set.hpp"

namespace tumble {
namespace {

// By value and as one comparison: a maxsd, where std::max by reference may become a branch.
double larger(double a, double b) { return a > b ? a : b; }
double smaller(double a, double b) { return a < b ? a : b; }

// One row's share of the residual: the worst of -w, -z and min(w, z), for relative w and z.
double violation(double w, double z) { return larger(larger(-w, -z), smaller(w, z)); }

// `residual` written out for the four rows of one contact: rows 2 and 3 share their d, and f_t1 + f_t2 = |f_t|.
double one_contact_residual(const OneContact& c, double f_n, double f_t, double slip_speed) {
  const double velocity_size = larger(std::abs(c.b_n), std::abs(c.b_t));
  if (velocity_size == 0.0) return 0.0;

  const double f_t_size = std::abs(f_t);
  const double u_n = c.A_nn * f_n + c.A_nt * f_t + c.b_n;
  const double u_t = c.A_nt * f_n + c.A_tt * f_t + c.b_t;
  const double cone = c.friction * f_n - f_t_size;

  const double A_nt = std::abs(c.A_nt);
  const double bound = k_largest_growth * velocity_size;
  const double terms_n = smaller(c.A_nn * f_n + A_nt * f_t_size, bound);
  const double terms_t = smaller(A_nt * f_n + c.A_tt * f_t_size + slip_speed, bound);
  const double terms_cone = smaller(c.A_nn * (c.friction * f_n + f_t_size), bound);
  const double inverse_d_n = 1.0 / (velocity_size + std::abs(c.b_n) + terms_n);
  const double inverse_d_t = 1.0 / (velocity_size + std::abs(c.b_t) + terms_t);
  const double inverse_d_cone = c.A_nn / (velocity_size + terms_cone);

  const double inverse_s_n = larger(larger(c.A_nn * inverse_d_n, A_nt * inverse_d_t), c.friction * inverse_d_cone);
  const double inverse_s_t = larger(larger(A_nt * inverse_d_n, c.A_tt * inverse_d_t), inverse_d_cone);

  const double normal = violation(u_n * inverse_d_n, f_n * inverse_s_n);
  const double left = violation((slip_speed - u_t) * inverse_d_t, larger(-f_t, 0.0) * inverse_s_t);
  const double right = violation((slip_speed + u_t) * inverse_d_t, larger(f_t, 0.0) * inverse_s_t);
  const double friction = violation(cone * inverse_d_cone, slip_speed * inverse_d_t);
  return larger(larger(normal, left), larger(right, friction));
}

}  // namespace

std::string_view to_string(ContactMode mode) {
  switch (mode) {
    case ContactMode::open: return "open";
    case ContactMode::stick: return "stick";
    case ContactMode::slip_left: return "slip left";
    case ContactMode::slip_right: return "slip right";
  }
  return "unknown";
}

LcpProblem as_lcp(const OneContact& c) {
  const double velocity_size = larger(std::abs(c.b_n), std::abs(c.b_t));
  return {{c.A_nn, -c.A_nt, c.A_nt, 0.0,   //
           -c.A_nt, c.A_tt, -c.A_tt, 1.0,  //
           c.A_nt, -c.A_tt, c.A_tt, 1.0,   //
           c.friction, -1.0, -1.0, 0.0},
          {c.b_n, -c.b_t, c.b_t, 0.0},
          {velocity_size, velocity_size, velocity_size, velocity_size / c.A_nn}};
}

Vector4 as_z(const OneContactSolution& solution) {
  return {solution.f_n, larger(-solution.f_t, 0.0), larger(solution.f_t, 0.0), solution.slip_speed};
}

namespace {

using one_contact::k_accepted_residual;

// Residual and status, whatever the numbers. A NaN fails each comparison that it takes part in.
void judge_in_full(const OneContact& c, OneContactSolution& solution) {
  solution.residual = one_contact_residual(c, solution.f_n, solution.f_t, solution.slip_speed);
  const bool is_contact = c.A_nn > 0.0 && c.friction >= 0.0;
  const bool is_finite = solution.f_n + std::abs(solution.f_t) + solution.slip_speed <= 1e300;
  const bool is_solved = is_contact && is_finite && solution.residual <= k_accepted_residual;
  solution.status = is_solved ? LcpStatus::solved : LcpStatus::numerical;
  if (is_finite && !std::isnan(solution.residual)) return;
  solution.f_n = solution.f_t = solution.slip_speed = 0.0;
  solution.residual = std::numeric_limits<double>::infinity();
}

// The residual of a closed contact where the answer is as good as it nearly always is: each w_i that should be 0 is
// smaller than the terms that z_i brings to its row, so that min(w_i / d_i, z_i / s_i) is the former. `judge_in_full`
// else. The same operations as in one_contact_lanes_impl.hpp. `is_left`: the friction that acts, if any, points to +t.
void judge(const OneContact& c, bool is_left, OneContactSolution& x) {
  const double f_t_size = std::abs(x.f_t);
  const double speed = larger(std::abs(c.b_n), std::abs(c.b_t));
  const double nn_f_n = c.A_nn * x.f_n, tt_f_t = c.A_tt * f_t_size, A_nt = std::abs(c.A_nt);
  const double u_n = nn_f_n + c.A_nt * x.f_t + c.b_n;
  const double u_t = c.A_nt * x.f_n + c.A_tt * x.f_t + c.b_t;
  const double along = is_left ? u_t : -u_t;  // slip on the side whose friction force may act
  const double w_active = x.slip_speed + along;
  const double off_active = f_t_size > 0.0 ? std::abs(w_active) : -w_active;
  const double w_passive = x.slip_speed - along;
  const double d_n = speed + std::abs(c.b_n) + nn_f_n + A_nt * f_t_size;
  const double d_t = speed + std::abs(c.b_t) + A_nt * x.f_n + tt_f_t + x.slip_speed;
  x.residual = larger(std::abs(u_n) / d_n, larger(off_active, -w_passive) / d_t);
  const bool is_plain = (x.f_n >= 0.0) & (x.slip_speed >= 0.0) & (u_n <= nn_f_n) &
                        ((w_active <= tt_f_t) | (f_t_size <= 0.0)) & (f_t_size <= c.friction * x.f_n) & (c.A_nn > 0.0) &
                        (d_n + d_t <= smaller(k_largest_growth * speed, 1e300)) & (x.residual <= k_accepted_residual);
  x.status = LcpStatus::solved;
  if (!is_plain) judge_in_full(c, x);
}

}  // namespace

// See docs/theory/one_contact.md.
OneContactSolution solve_one_contact(const OneContact& c) {
  OneContactSolution solution = propose_one_contact(c);
  if (solution.mode == ContactMode::open) {  // u = b: every row holds to the last bit
    solution.status = LcpStatus::solved;
    if (!((c.A_nn > 0.0) & (c.friction >= 0.0) & (c.b_n + solution.slip_speed <= 1e300))) judge_in_full(c, solution);
    return solution;
  }
  const bool pulls_right =
      solution.mode == ContactMode::stick ? solution.f_t > 0.0 : solution.mode == ContactMode::slip_left;
  judge(c, pulls_right, solution);
  return solution;
}

OneContactMotions one_contact_motions(const OneContact& c) {
  OneContactMotions motions;
  motions.motion[motions.count++] = solve_one_contact(c);
  // Friction pulls the contact in where it slips in direction sigma = sign(A_nt): k there.
  const double k = c.A_nn - c.friction * std::abs(c.A_nt);
  if (!(c.b_n >= 0.0) || !(k <= 0.0) || motions.motion[0].status != LcpStatus::solved) return motions;
  const double sigma = c.A_nt > 0.0 ? 1.0 : -1.0;
  const double det = c.A_nn * c.A_tt - c.A_nt * c.A_nt;
  const double F_n = c.A_nt * c.b_t - c.A_tt * c.b_n;
  const double F_t = c.A_nt * c.b_n - c.A_nn * c.b_t;
  if (!(F_n > 0.0 && std::abs(F_t) <= c.friction * F_n)) return motions;
  const auto add = [&](double f_n, double f_t, double slip_speed, ContactMode mode) {
    OneContactSolution& solution = motions.motion[motions.count++];
    solution = {f_n, f_t, slip_speed, mode, LcpStatus::numerical, 0.0};
    judge_in_full(c, solution);
  };
  add(F_n / det, F_t / det, 0.0, ContactMode::stick);
  motions.has_between = k == 0.0 && c.b_n == 0.0;
  const double slip_speed = (-sigma * F_t - c.friction * F_n) / k;
  if (k < 0.0 && c.b_n > 0.0 && slip_speed > 0.0) {
    const double f_n = -c.b_n / k;
    add(f_n, -sigma * c.friction * f_n, slip_speed, sigma < 0.0 ? ContactMode::slip_left : ContactMode::slip_right);
  }
  return motions;
}

namespace {

template <class T>
void require_length(std::span<T> array, const char* name, std::size_t count, bool may_be_empty) {
  if (array.size() == count || (may_be_empty && array.empty())) return;
  throw std::invalid_argument(tumble::format("{}: must have {} entries like A_nn, got {}", name, count, array.size()));
}

OneContact contact_at(const OneContactArrays& a, std::size_t i) {
  return {a.A_nn[i], a.A_nt[i], a.A_tt[i], a.b_n[i], a.b_t[i], a.friction[i]};
}

template <class T>
void put(std::span<T> array, std::size_t i, T value) {
  if (!array.empty()) array[i] = value;
}

}  // namespace

void solve_one_contacts(const OneContactArrays& contacts, const OneContactSolutionArrays& solutions) {
  const std::size_t count = contacts.A_nn.size();
  require_length(contacts.A_nt, "A_nt", count, false);
  require_length(contacts.A_tt, "A_tt", count, false);
  require_length(contacts.b_n, "b_n", count, false);
  require_length(contacts.b_t, "b_t", count, false);
  require_length(contacts.friction, "friction", count, false);
  require_length(solutions.f_n, "f_n", count, true);
  require_length(solutions.f_t, "f_t", count, true);
  require_length(solutions.slip_speed, "slip_speed", count, true);
  require_length(solutions.residual, "residual", count, true);
  require_length(solutions.mode, "mode", count, true);
  require_length(solutions.status, "status", count, true);
  // A block of contacts stays in the cache while the few that need a closer look are solved again, one by one.
  constexpr std::size_t block_size = 64;
  const auto solve_block = one_contact::block_solver(instruction_set());
  for (std::size_t first = 0; first < count; first += block_size) {
    const std::size_t size = std::min(block_size, count - first);
    std::array<std::uint8_t, block_size> is_done{};
    if (size == block_size && solve_block != nullptr && solve_block(contacts, solutions, first, is_done.data()))
      continue;
    for (std::size_t k = 0; k < size; ++k) {
      if (is_done[k] != 0) continue;
      const std::size_t i = first + k;
      const OneContactSolution solution = solve_one_contact(contact_at(contacts, i));
      put(solutions.f_n, i, solution.f_n);
      put(solutions.f_t, i, solution.f_t);
      put(solutions.slip_speed, i, solution.slip_speed);
      put(solutions.residual, i, solution.residual);
      put(solutions.mode, i, solution.mode);
      put(solutions.status, i, solution.status);
    }
  }
}

}  // namespace tumble
