#include "tumble/lcp/solve_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tumble/lcp/refine_contacts.hpp"
#include "tumble/lcp/residual.hpp"

namespace tumble {
namespace {

using Index = std::size_t;

// Impulses that satisfy the contacts better than A = J M^-1 J^T, which was rounded, can tell. The laws hold for them by
// the Jacobians, so they are a solution even if the LCP of the rounded A was taken for infeasible.
void refine(const ContactSystem& system, const LcpProblem& problem, ContactSolution& solution) {
  LcpResult& result = solution.result;
  if (result.status == LcpStatus::bad_input) return;
  RefinedContacts refined = refine_contacts(system, result.z, result.status == LcpStatus::solved);
  const bool is_finite = std::all_of(refined.z.begin(), refined.z.end(), [](double x) { return std::isfinite(x); });
  if (refined.z.empty() || !is_finite) return;
  result.z = std::move(refined.z);
  result.w = complement(problem, result.z);
  result.parts = residual(problem, result.z);
  result.residual = result.parts.largest();
  result.status = LcpStatus::solved;
  result.certificate.clear();
  solution.velocity = std::move(refined.velocity);
}

// What the result means for the contacts and the bodies.
ContactSolution read_solution(const ContactSystem& system, const LcpProblem& problem, LcpResult result) {
  const Index count = system.contacts.size();
  ContactSolution solution;
  if (result.z.empty()) result.z.assign(4 * count, 0.0);  // bad_input
  solution.velocity = velocities_after(system, result.z);
  solution.result = std::move(result);
  refine(system, problem, solution);
  const std::vector<double>& z = solution.result.z;
  for (Index i = 0; i < count; ++i) {
    const double normal = z[i], slip = z[3 * count + i];
    const double u_t = velocity_at(system.contacts[i], solution.velocity)[1];
    solution.normal_impulse.push_back(normal);
    solution.friction_impulse.push_back(z[count + 2 * i] - z[count + 2 * i + 1]);
    solution.slip_speed.push_back(slip);
    solution.mode.push_back(contact_mode(normal, slip, u_t));
  }
  return solution;
}

}  // namespace

ContactSolution solve_contacts(const ContactSystem& system, const LcpSettings& settings) {
  const LcpProblem problem = as_lcp(system);
  return read_solution(system, problem, solve_lcp(problem, settings));
}

ContactSolution solve_contacts(const ContactSystem& system, const LcpSettings& settings, LcpWorkspace& workspace) {
  const LcpProblem problem = as_lcp(system);
  return read_solution(system, problem, solve_lcp(problem, settings, workspace));
}

}  // namespace tumble
