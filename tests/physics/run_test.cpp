// What a run records adds up.
#include <cmath>
#include <string>

#include "closed_form.hpp"
#include "named_scenes.hpp"
#include "random.hpp"
#include "scene_builder.hpp"
#include <gtest/gtest.h>

namespace tumble::physics {
namespace {

constexpr double k_sum_round_off = 1e-11;  // [-] of thousands of steps

// Energies at the end are those at the start and all works and losses between.
TEST(Run, LedgersOfAllSamplesAddUp) {
  for (const char* name : {"drop", "conveyor", "pusher", "billiard", "wedge"}) {
    const Scene scene = named_scene(name);
    const Trajectory run = simulate(scene, {.sample_every = 7});
    double sum = run.energy.front().kinetic + run.energy.front().potential, size = std::abs(sum);
    for (std::size_t i = 1; i < run.energy.size(); ++i) {
      const EnergyLedger& e = run.energy[i];
      sum += e.external_work - e.friction_loss - e.impact_loss - e.damping_loss + e.stabilisation_work;
      size += std::abs(e.external_work) + std::abs(e.friction_loss) + std::abs(e.impact_loss);
    }
    const EnergyLedger& last = run.energy.back();
    EXPECT_NEAR(sum, last.kinetic + last.potential, k_sum_round_off * size) << name;
  }
}

// A square that falls, bounces and comes to rest: the impulses of all contacts have carried its weight all the time and
// taken its momentum at the start.
TEST(Run, ImpulsesOfAllStepsCarryTheWeight) {
  const Scene scene = named_scene("drop");
  const Trajectory run = simulate(scene);
  ASSERT_TRUE(run.is_complete);
  const Body& square = scene.bodies[1];
  double sum_n = 0.0, sum_t = 0.0;
  for (const StepContacts& step : run.contacts) {
    for (const ContactRecord& record : step.contacts) {
      sum_n += record.normal_impulse * record.contact.normal.y;
      sum_t += record.friction_impulse * turned_right(record.contact.normal).x;
    }
  }
  EXPECT_NEAR(sum_n, square.mass * (k_g * run.time.back() - square.velocity[1]), k_sum_round_off * sum_n);
  EXPECT_NEAR(sum_t, -square.mass * square.velocity[0], k_sum_round_off * sum_n);  // on level ground: both at rest
}

// Two bodies at random that hit each other with one contact: Newton's law of restitution at it, and Coulomb's law.
TEST(Run, PairsAtRandomObeyNewtonAndCoulomb) {
  constexpr double step_size = 1e-5;
  constexpr double first_order =
      1e-2;  // [-] what a step of 0.01 ms moves, of the distance of 1 cm over which arms change
  int impacts = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    problems::Random random(300 + seed);
    const Shape shapes[] = {square(0.2), ellipse(0.15, 0.1), capsule(0.2, 0.06), regular_polygon(5, 0.12), disc(0.1)};
    const double friction = random.uniform(0.0, 1.0), restitution = random.uniform(0.1, 1.0);
    std::vector<Body> bodies;
    for (const double side : {-1.0, 1.0}) {
      const double mass = random.log_uniform(-2.0, 2.0), angle = random.uniform(0.0, 6.3),
                   y = random.uniform(-0.05, 0.05);
      const double speed = random.uniform(0.5, 2.0), w = random.uniform(-3.0, 3.0);
      bodies.push_back(dynamic(shapes[random.below(5)], mass, {{0.3 * side, y}, angle}, {-speed * side, 0.0, w}));
    }
    Simulation simulation = start(without_gravity(scene_of(law(friction, restitution), bodies)), step_size, 0.5);
    run_until(simulation, [](const State&, const StepReport& report) { return has_impulse(report); });
    const std::vector<ContactRecord>& contacts = simulation.report().contacts;
    if (contacts.size() != 1) continue;  // flat on a side
    const ContactRecord& c = contacts[0];
    ++impacts;
    const double speed = std::abs(c.normal_velocity) + std::abs(c.tangential_velocity);
    EXPECT_NEAR(c.normal_velocity_after, -restitution * c.normal_velocity, first_order * speed) << "seed " << seed;
    EXPECT_LE(std::abs(c.friction_impulse), friction * c.normal_impulse * (1.0 + 1e-12)) << "seed " << seed;
    if (c.mode == ContactMode::stick) {
      EXPECT_NEAR(c.tangential_velocity_after, 0.0, first_order * speed) << "seed " << seed;
    } else {
      EXPECT_NEAR(c.friction_impulse, std::copysign(friction * c.normal_impulse, -c.tangential_velocity_after),
                  1e-12 * c.normal_impulse)
          << "seed " << seed;
    }
  }
  EXPECT_GE(impacts, 30);
}

// The fast solver stops after some sweeps: what stands stays within a millimetre, in place and depth.
TEST(Run, FastSolverKeepsStacksWithinAMillimetre) {
  constexpr double accepted = 1e-3;  // [m]
  for (const char* name : {"stack", "pyramid"}) {
    const Scene scene = named_scene(name);
    Simulation simulation(scene, {.duration = 5.0, .keeps_contacts = false, .step = {.solver = ContactSolver::fast}});
    double depth = 0.0;
    while (!simulation.is_done()) {
      simulation.advance();
      for (const ContactRecord& record : simulation.report().contacts) depth = std::max(depth, -record.contact.gap);
    }
    EXPECT_LT(depth, accepted) << name;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const Vector2 way = simulation.state().bodies[i].pose.position - scene.bodies[i].pose.position;
      EXPECT_LT(length(way), accepted) << name << ", body " << i;
    }
  }
}

}  // namespace
}  // namespace tumble::physics
