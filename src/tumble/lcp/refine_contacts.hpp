// Corrects the impulses of contacts by the Jacobians, where A = J M^-1 J^T has lost digits. Not a public header.
#pragma once

#include <vector>

#include "tumble/lcp/contact_system.hpp"

namespace tumble {

struct RefinedContacts {
  std::vector<double> z;          // of `as_lcp(system)`; empty: nothing to correct in a solution, or no success
  std::vector<Vector3> velocity;  // per body, of the impulses in z before they were rounded to double
};

// Keeps the modes of z: a contact that presses has u_n = 0, one that sticks also u_t = 0. Where v + M^-1 J^T f misses
// that by more than round-off of velocities, f is corrected, by QR factors of M^-1/2 J^T, whose condition is the square
// root of that of A. A heavy body on a light one is the case in point: with masses 1 : 1e12, the 1e-12 of the heavy
// one is added to 1 in A, and with it four digits of its impulse are left. The result has no velocity off by more than
// 1e-13 of the largest approach, no negative normal impulse and none outside its cone; else it is empty. `is_solved`: z
// passes for a solution of the LCP.
RefinedContacts refine_contacts(const ContactSystem& system, const std::vector<double>& z, bool is_solved);

}  // namespace tumble
