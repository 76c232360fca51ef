// Planar contacts with two rows each, as the formats and the contact solvers of other projects take them.
#pragma once

#include <span>
#include <vector>

#include "tumble/lcp/problem.hpp"

namespace tumble::problems {

// Velocities u = W r + q [m/s] for the impulses r [N s] of k contacts, normal and tangent of each in turn.
struct LocalContacts {
  std::vector<double> W;         // 2 k x 2 k, column after column
  std::vector<double> q;         // 2 k
  std::vector<double> friction;  // k [-]
};

// The contacts of an LCP in the order of `as_lcp` of contact_system.hpp. Throws std::invalid_argument if the problem is
// none of contacts in that order.
LocalContacts local_contacts(const LcpProblem& problem);

// The LCP of these contacts, row sizes included, as `as_lcp` of contact_system.hpp.
LcpProblem as_lcp(const LocalContacts& contacts);

// z of that LCP for the impulses r.
std::vector<double> lcp_solution(const LocalContacts& contacts, std::span<const double> impulses);

}  // namespace tumble::problems
