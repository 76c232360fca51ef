// The impulses of contacts and the motion after them, from the Jacobians.
#pragma once

#include <vector>

#include "tumble/lcp/contact_system.hpp"
#include "tumble/lcp/solve.hpp"

namespace tumble {

struct ContactSolution {
  LcpResult result;                      // of `as_lcp(system)`; check its status
  std::vector<double> normal_impulse;    // per contact [N s], >= 0
  std::vector<double> friction_impulse;  // per contact [N s], along +t
  std::vector<double> slip_speed;        // per contact [m/s]; for an open one, a bound
  std::vector<ContactMode> mode;         // per contact
  std::vector<Vector3> velocity;         // per body, v + M^-1 J^T f
};

// Solves `as_lcp(system)`, by `robust` unless told otherwise, and corrects the impulses by the Jacobians where they do
// not bring the contacts to rest to 1e-13 of their speed: A = J M^-1 J^T, rounded, knows little of a body much heavier
// than one it rests on. A correction can also find a solution where the LCP of the rounded A has none: `solved` then
// means that the laws hold by the Jacobians to 1e-13 of the speeds, and residual, basis and rung are those of that LCP.
// Throws as `validate` of the system, `as_lcp` and `solve_lcp`; with a workspace, as `solve_lcp` with one.
ContactSolution solve_contacts(const ContactSystem& system, const LcpSettings& settings = RobustSettings{});
ContactSolution solve_contacts(const ContactSystem& system, const LcpSettings& settings, LcpWorkspace& workspace);

}  // namespace tumble
