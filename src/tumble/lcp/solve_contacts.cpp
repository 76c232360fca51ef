#include "tumble/lcp/solve_contacts.hpp"

#include <utility>

namespace tumble {
namespace {

using Index = std::size_t;

double tangential_velocity(const BodyContact& contact, const std::vector<Vector3>& velocity) {
  double u_t = 0.0;
  if (contact.body_a >= 0) u_t += dot(contact.tangent_a, velocity[static_cast<Index>(contact.body_a)]);
  if (contact.body_b >= 0) u_t += dot(contact.tangent_b, velocity[static_cast<Index>(contact.body_b)]);
  return u_t;
}

// What z means for the contacts and the bodies.
ContactSolution read_solution(const ContactSystem& system, LcpResult result) {
  const Index count = system.contacts.size();
  ContactSolution solution;
  if (result.z.empty()) result.z.assign(4 * count, 0.0);  // bad_input
  solution.velocity = velocities_after(system, result.z);
  for (Index i = 0; i < count; ++i) {
    const double normal = result.z[i], slip = result.z[3 * count + i];
    const double u_t = tangential_velocity(system.contacts[i], solution.velocity);
    solution.normal_impulse.push_back(normal);
    solution.friction_impulse.push_back(result.z[count + 2 * i] - result.z[count + 2 * i + 1]);
    solution.slip_speed.push_back(slip);
    solution.mode.push_back(contact_mode(normal, slip, u_t));
  }
  solution.result = std::move(result);
  return solution;
}

}  // namespace

ContactSolution solve_contacts(const ContactSystem& system, const LcpSettings& settings) {
  return read_solution(system, solve_lcp(as_lcp(system), settings));
}

ContactSolution solve_contacts(const ContactSystem& system, const LcpSettings& settings, LcpWorkspace& workspace) {
  return read_solution(system, solve_lcp(as_lcp(system), settings, workspace));
}

}  // namespace tumble
