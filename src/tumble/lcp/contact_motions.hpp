// Whether the motion that contacts allow is the only one, and which others there are.
#pragma once

#include <vector>

#include "tumble/lcp/contact_system.hpp"
#include "tumble/lcp/one_contact.hpp"
#include "tumble/lcp/problem.hpp"
#include "tumble/lcp/result.hpp"

namespace tumble {

// The solutions of the LCP that differ by their impulses, but not by the velocities that these cause.
struct ContactMotion {
  std::vector<double> z;           // n; one of the solutions, a vertex of the solution set
  std::vector<ContactMode> modes;  // per contact, as z has them: in another solution a contact at rest may be open
  std::vector<double> velocities;  // u_n, u_t of each contact, one after the other
};

struct ContactMotions {
  LcpStatus status = LcpStatus::numerical;  // as `enumerate`
  std::vector<ContactMotion> motions;       // in the order of `enumerate_solutions`; empty without a solution
  bool has_between = false;  // there are more: along some face of solutions the velocities change from those of one
                             // motion to those of another, or grow along a ray

  bool is_unique() const { return motions.size() == 1 && !has_between; }
};

// All motions of up to three contacts, from `solution_set`, that is, to the accuracy of double arithmetic: velocities
// that agree to 1e-8 of the terms they are sums of are taken for one. Contacts are recognised in M, in any order and
// scale of the unknowns; +t is the direction of the first friction unknown. Modes and velocities are in the order of
// the cone rows, followed by the normals without friction unknowns, which are open or stick, with u_t = 0. Where
// friction is 0 a cone row names no normal: such cones take the normals that no cone names in their order, which is
// that of `as_lcp`, unless there are more or fewer of them. Each then counts alone; a cone without a normal is open.
// Throws std::invalid_argument where `solution_set` does, or if M is not that of contacts, one of them with cone rows.
ContactMotions contact_motions(const LcpProblem& problem);

// The same for `as_lcp(system)`, in the order of its contacts, whatever their friction.
ContactMotions contact_motions(const ContactSystem& system);

}  // namespace tumble
