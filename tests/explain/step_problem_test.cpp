#include "tumble/explain/step_problem.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tumble/explain/lemke_pages.hpp"
#include "tumble/lcp/lemke.hpp"
#include "tumble/lcp/residual.hpp"
#include "tumble/trajectory/simulate.hpp"

namespace tumble {
namespace {

constexpr double k_round_off = 1e-12;  // [-] of sums of a few terms of size 1

// A square of side 0.2 m on the ground, sliding: both corners touch.
Scene sliding_square(double speed, double height = 0.1, double restitution = 0.0) {
  Body ground, box;
  ground.kind = BodyKind::fixed;
  ground.parts = {{half_plane({0.0, 1.0})}};
  box.parts = {{square(0.2)}};
  set_mass(box, 1.0);
  box.pose = {{0.0, height}, 0.0};
  box.velocity = {speed, 0.0, 0.0};
  Scene scene;
  scene.materials = {{"default", {0.3, 0.3, restitution}}};
  scene.bodies = {ground, box};
  return scene;
}

// Whatever a step decides must solve the problem that is shown for it, and agree with the impulse plane of each
// contact.
void expect_shown_as_solved(const Scene& scene, double step_size, int num_steps) {
  StepWorkspace workspace(scene);
  State state = initial_state(scene);
  StepReport report;
  int shown_steps = 0;
  for (int step = 0; step < num_steps; ++step) {
    const State before = state;
    ASSERT_EQ(time_step(scene, step_size, {}, state, workspace, &report), LcpStatus::solved);
    const StepProblem shown = problem_of_contacts(scene, before.bodies, state.bodies, report.contacts, step_size);
    ASSERT_EQ(shown.z.empty(), report.contacts.empty());
    if (shown.z.empty()) continue;
    ++shown_steps;
    EXPECT_LT(residual(shown.problem, shown.z).largest(), k_round_off) << "step " << step;
    for (const ContactRecord& contact : report.contacts) {
      const ImpulsePlane plane = impulse_plane(scene, before.bodies, contact, step_size);
      EXPECT_GE(contact.normal_velocity_after, plane.u_n_target - k_round_off);
      EXPECT_NEAR(plane.u_n + plane.A_nn * plane.P_n + plane.A_nt * plane.P_t, contact.normal_velocity_after,
                  k_round_off);
      EXPECT_NEAR(plane.u_t + plane.A_nt * plane.P_n + plane.A_tt * plane.P_t, contact.tangential_velocity_after,
                  k_round_off);
    }
  }
  EXPECT_GT(shown_steps, 0);
}

TEST(StepProblem, HoldsForBodiesThatSlideStickAndBounce) {
  expect_shown_as_solved(sliding_square(1.0), 1e-3, 500);
  expect_shown_as_solved(sliding_square(0.3, 0.3, 0.5), 1e-3, 1000);
}

TEST(StepProblem, OfTheDropIsTheDocuments) {
  const drop::Parameters parameters;
  const drop::Record record = drop::simulate_with_record({0.0, 1.5, 0.52359877559829887}, {0.0, -0.2, 0.0}, parameters);
  int num_contacts = 0;
  for (int k = 0; k < record.trajectory.columns; ++k) {
    const Vector3 q = record.trajectory.q_at(k), v = record.trajectory.v_at(k);
    const drop::StepRecord& step = record.steps[static_cast<std::size_t>(k)];
    if (!(step.gap < parameters.delta)) continue;
    ++num_contacts;
    const StepProblem shown = problem_of_drop(q, v, parameters);
    EXPECT_TRUE(std::equal(step.z.begin(), step.z.end(), shown.z.begin()));
    const drop::Lcp lcp = form_lcp(drop::get_contacts(q, parameters).J, v, parameters);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(shown.problem.q[i], lcp.p[i]);
      for (std::size_t j = 0; j < 4; ++j) EXPECT_EQ(shown.problem(i, j), lcp.V[i][j]);
      // One of each pair is 0, up to round-off of the forces, some 100 N.
      EXPECT_NEAR(std::min(shown.z[i], std::abs(shown.w[i])), 0.0, 1e-13 * 1e3);
    }
    // The plane: u' = u + A P is the velocity of the corner after the step.
    const ImpulsePlane plane = impulse_plane_of_drop(q, v, parameters);
    const Vector3 after = drop::step(q, v, parameters).v;
    const drop::Jacobian J = drop::get_contacts(q, parameters).J;
    EXPECT_NEAR(plane.u_n + plane.A_nn * plane.P_n + plane.A_nt * plane.P_t, dot(J.n, after), k_round_off);
    EXPECT_NEAR(plane.u_t + plane.A_nt * plane.P_n + plane.A_tt * plane.P_t, dot(J.t, after), k_round_off);
    if (plane.P_n > 0.0) {
      EXPECT_NEAR(dot(J.n, after), plane.u_n_target, k_round_off);
    }
    EXPECT_LE(std::abs(plane.P_t), plane.friction * plane.P_n + k_round_off);
  }
  EXPECT_GT(num_contacts, 5);
}

TEST(StepProblem, IsEmptyForManyContacts) {
  Scene scene = sliding_square(0.0);
  const Body box = scene.bodies.back();
  for (int i = 1; i < 3; ++i) {
    scene.bodies.push_back(box);
    scene.bodies.back().pose.position.x = i;
  }
  StepWorkspace workspace(scene);
  State state = initial_state(scene);
  const State before = state;
  StepReport report;
  time_step(scene, 1e-3, {}, state, workspace, &report);
  ASSERT_GT(report.contacts.size(), k_max_contacts_shown);
  EXPECT_TRUE(problem_of_contacts(scene, before.bodies, state.bodies, report.contacts, 1e-3).z.empty());
}

// [Cottle 1992, example 4.4.7 has the same form]: two pivots by hand.
TEST(LemkePages, FollowThePivots) {
  const LcpProblem problem{{2.0, 1.0, 1.0, 2.0}, {-5.0, -6.0}, {}};
  const auto [pages, end] = lemke_pages(trace_lemke(problem), 2, {});
  ASSERT_EQ(pages.size(), 4u);
  EXPECT_EQ(end, LemkeEnd::solved);
  EXPECT_FALSE(pages[0].entered);
  EXPECT_EQ(lemke_variable(*pages[0].entering, 2), "z0");
  EXPECT_EQ(lemke_variable(*pages[0].leaving, 2), "w2");
  EXPECT_EQ(lemke_variable(*pages[1].entering, 2), "z2");
  EXPECT_DOUBLE_EQ(*pages[1].ratios[0], 1.0);
  EXPECT_FALSE(pages[3].entering);
  EXPECT_EQ(lemke_variable(pages[3].basis[0], 2), "z2");
  EXPECT_DOUBLE_EQ(pages[3].entry(0, 3), 7.0 / 3.0);
}

}  // namespace
}  // namespace tumble
