// The complementarity problem that one step solved, for those who want to see it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tumble/drop/drop.hpp"
#include "tumble/lcp/problem.hpp"
#include "tumble/step/state.hpp"
#include "tumble/step/step_report.hpp"

namespace tumble {

// w = V z + p >= 0, z >= 0, w . z = 0, with its solution. V is problem.M, p is problem.q.
struct StepProblem {
  LcpProblem problem;
  std::vector<std::string> z_names, z_units, w_names, w_units;
  std::vector<double> z, w;
};

// The document's, of the step from a column: z = (f_n, f_t1, f_t2, lambda). Throws as drop::step_with_record.
StepProblem problem_of_drop(const Vector3& q, const Vector3& v, const drop::Parameters& parameters);

// More contacts at once are too many to look at: 4 rows each.
inline constexpr std::size_t k_max_contacts_shown = 4;

// That of all contacts at work in a step of a scene, in impulses, `as_lcp` of their contact system: `before` and
// `after` are the bodies before and after the step [Scene::bodies]. Where something bounced it is the problem for the
// velocity after the step, else the one problem there is; contacts with an impulse are held to the normal velocity that
// they have after the step, the others to -(gap + bend) / step size or, where others bounce, to nothing. Empty if there
// are no contacts, or more than k_max_contacts_shown.
StepProblem problem_of_contacts(const Scene& scene, std::span<const BodyState> before, std::span<const BodyState> after,
                                std::span<const ContactRecord> contacts, double step_size);

// What the impulse P = (P_n, P_t) of one contact does to its velocity, the impulses of all others being as they are:
//   u' = u + A P.
// The lines of the impulse plane: compression ends at u_n' = 0, restitution at u_n' = u_n_target, sticking is u_t' = 0.
struct ImpulsePlane {
  double A_nn = 0.0, A_nt = 0.0, A_tt = 0.0;  // [1/kg]
  double u_n = 0.0, u_t = 0.0;                // [m/s], without the impulse
  double u_n_target = 0.0;                    // [m/s]
  double friction = 0.0;                      // [-]
  double P_n = 0.0, P_t = 0.0;                // [N s], the solution
};

ImpulsePlane impulse_plane_of_drop(const Vector3& q, const Vector3& v, const drop::Parameters& parameters);
ImpulsePlane impulse_plane(const Scene& scene, std::span<const BodyState> before, const ContactRecord& contact,
                           double step_size);

}  // namespace tumble
