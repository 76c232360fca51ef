#include "tumble/lcp/one_contact.hpp"

#include <cmath>
#include <limits>

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
  const double inverse_d_n = 1.0 / (velocity_size + std::abs(c.b_n) + c.A_nn * f_n + A_nt * f_t_size);
  const double inverse_d_t = 1.0 / (velocity_size + std::abs(c.b_t) + A_nt * f_n + c.A_tt * f_t_size + slip_speed);
  const double inverse_d_cone = c.A_nn / (velocity_size + c.A_nn * (c.friction * f_n + f_t_size));

  const double inverse_s_n = larger(larger(c.A_nn * inverse_d_n, A_nt * inverse_d_t), c.friction * inverse_d_cone);
  const double inverse_s_t = larger(larger(A_nt * inverse_d_n, c.A_tt * inverse_d_t), inverse_d_cone);

  const double normal = violation(u_n * inverse_d_n, f_n * inverse_s_n);
  const double left = violation((slip_speed - u_t) * inverse_d_t, larger(-f_t, 0.0) * inverse_s_t);
  const double right = violation((slip_speed + u_t) * inverse_d_t, larger(f_t, 0.0) * inverse_s_t);
  const double friction = violation(cone * inverse_d_cone, slip_speed * inverse_d_t);
  return larger(larger(normal, left), larger(right, friction));
}

// f_n, f_t, slip speed and mode; see docs/theory/one_contact.md.
OneContactSolution choose_mode(const OneContact& c) {
  OneContactSolution solution;
  if (c.b_n >= 0.0) {
    solution.slip_speed = std::abs(c.b_t);
    return solution;
  }
  // Stick: A f = -b, as F = det(A) f.
  const double det = c.A_nn * c.A_tt - c.A_nt * c.A_nt;
  const double F_n = c.A_nt * c.b_t - c.A_tt * c.b_n;
  const double F_t = c.A_nt * c.b_n - c.A_nn * c.b_t;
  const double cone_F_n = c.friction * F_n;
  if (std::abs(F_t) <= cone_F_n) {
    solution.f_n = F_n / det;
    solution.f_t = F_t / det;
    solution.mode = ContactMode::stick;
    return solution;
  }
  // Slip in direction sigma, against the force that sticking would take: f_t = -sigma mu f_n, f_n = -b_n / k, slip
  // speed
  // (-sigma F_t - mu F_n) / k. Here k > 0 up to round-off, as b_n < 0 and sticking is excluded.
  const double sigma = F_t > 0.0 ? -1.0 : 1.0;
  const double k = c.A_nn - sigma * c.friction * c.A_nt;
  solution.f_n = -c.b_n / k;
  solution.f_t = -sigma * c.friction * solution.f_n;
  solution.slip_speed = (-sigma * F_t - cone_F_n) / k;
  solution.mode = sigma < 0.0 ? ContactMode::slip_left : ContactMode::slip_right;
  return solution;
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

OneContactSolution solve_one_contact(const OneContact& contact) {
  constexpr double accepted_residual = 1e-10;  // round-off of a few operations, times the condition of A up to 1e5
  OneContactSolution solution = choose_mode(contact);
  solution.residual = one_contact_residual(contact, solution.f_n, solution.f_t, solution.slip_speed);
  // A NaN fails each comparison that it takes part in. Joined by & so that the processor need not guess a branch each.
  const bool is_contact = (contact.A_nn > 0.0) & (contact.friction >= 0.0);
  const bool is_finite = solution.f_n + std::abs(solution.f_t) + solution.slip_speed <= 1e300;
  const bool is_solved = is_contact & is_finite & (solution.residual <= accepted_residual);
  solution.status = is_solved ? LcpStatus::solved : LcpStatus::numerical;
  if (!is_finite || std::isnan(solution.residual)) solution.residual = std::numeric_limits<double>::infinity();
  return solution;
}

}  // namespace tumble
