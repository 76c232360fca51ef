// The LCP of one planar frictional contact, in closed form.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "tumble/lcp/problem.hpp"
#include "tumble/lcp/result.hpp"
#include "tumble/math/vector.hpp"

namespace tumble {

// u = A f + b: velocity u = (u_n, u_t) [m/s] at the contact, contact force or impulse f = (f_n, f_t), and
//   0 <= f_n  complementary to  u_n >= 0,      |f_t| <= friction f_n,  f_t against the slip u_t, full while it slips.
// A is symmetric and positive definite; its unit is that of u over that of f. Here u_n is whatever must become >= 0,
// so restitution, if any, is already in b_n.
struct OneContact {
  double A_nn;
  double A_nt;
  double A_tt;
  double b_n;
  double b_t;
  double friction;  // mu >= 0 [-]
};

enum class ContactMode : std::uint8_t {
  open,        // no force
  stick,       // force inside or on the cone, no slip
  slip_left,   // the contact point slips towards -t (for the ground: -x); friction points to +t
  slip_right,  // towards +t; friction points to -t
};

// -1, 1, or 0 where the contact does not slip.
inline double slip_direction(ContactMode mode) {
  return mode == ContactMode::slip_left ? -1.0 : mode == ContactMode::slip_right ? 1.0 : 0.0;
}

// "open", "stick", "slip left", "slip right".
std::string_view to_string(ContactMode mode);

struct OneContactSolution {
  double f_n = 0.0;         // >= 0
  double f_t = 0.0;         // along +t
  double slip_speed = 0.0;  // |u_t| [m/s], the lambda of the LCP
  ContactMode mode = ContactMode::open;
  LcpStatus status = LcpStatus::numerical;  // solved or numerical
  double residual = 0.0;                    // of z in the LCP of `as_lcp`, as `residual` computes it
};

// The LCP of the contact for z = (f_n, f_t1, f_t2, slip speed), f_t = f_t2 - f_t1. [Stewart & Trinkle 1996; Stewart
// 2000, sec. 5] Row sizes: the larger of |b_n|, |b_t| for the velocities, that over A_nn for the cone.
LcpProblem as_lcp(const OneContact& contact);

// (f_n, f_t1, f_t2, slip speed) of a solution, with the smaller of f_t1, f_t2 equal to 0.
Vector4 as_z(const OneContactSolution& solution);

// The solution of `as_lcp(contact)`. Where b_n < 0 its motion is unique. Where b_n >= 0 the contact opens without a
// force; for friction above A_nn / |A_nt| (Painleve) further solutions may exist then, and the one without force is the
// one returned: `one_contact_motions` lists the others. Derivation: docs/theory/one_contact.md.
// The caller vouches for finite numbers, A positive definite and friction >= 0. If that is not so, the status is
// `numerical` (forces are 0 where they would not be finite), or the z returned solves the LCP all the same.
OneContactSolution solve_one_contact(const OneContact& contact);

// All motions that the contact may have: one, or, where a contact with much friction opens, up to three.
struct OneContactMotions {
  int count = 0;
  std::array<OneContactSolution, 3> motion;  // the first `count`: what `solve_one_contact` returns, then stick, slip
  bool has_between = false;                  // only where b_n = 0 and friction is A_nn / |A_nt| to the last bit: every
                                             // force between that of motion[0] and motion[1] is a solution too
};
OneContactMotions one_contact_motions(const OneContact& contact);

// Contacts side by side, an array for each number of OneContact.
struct OneContactArrays {
  std::span<const double> A_nn, A_nt, A_tt, b_n, b_t, friction;
};

// The numbers of OneContactSolution; an empty span is not written to.
struct OneContactSolutionArrays {
  std::span<double> f_n, f_t, slip_speed, residual;
  std::span<ContactMode> mode;
  std::span<LcpStatus> status;
};

// `solve_one_contact` for each of the contacts, the same bits, several at a time.
// Throws std::invalid_argument, naming the field, if an array has another length than A_nn, empty ones of `solutions`
// excepted.
void solve_one_contacts(const OneContactArrays& contacts, const OneContactSolutionArrays& solutions);

}  // namespace tumble
