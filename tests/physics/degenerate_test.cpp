// Contacts that depend on each other, that have no solution or several: a status and finite numbers, and never energy
// from nothing.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "closed_form.hpp"
#include "scene_builder.hpp"
#include <gtest/gtest.h>

namespace tumble::physics {
namespace {

bool is_finite(const State& state) {
  return std::all_of(state.bodies.begin(), state.bodies.end(), [](const BodyState& body) {
    return std::isfinite(body.pose.position.x + body.pose.position.y + body.pose.angle) &&
           std::isfinite(body.velocity[0] + body.velocity[1] + body.velocity[2]);
  });
}

// Runs to the end or to the first step that is not solved. Numbers stay finite, energy rises by what is reported only.
State run_carefully(const Scene& scene, double step_size, double duration, const std::string& what) {
  Simulation simulation = start(scene, step_size, duration);
  const EnergyLedger first = energies(scene, simulation.state());
  double last = first.kinetic + first.potential;
  while (!simulation.is_done()) {
    simulation.advance();
    EXPECT_TRUE(is_finite(simulation.state())) << what;
    if (simulation.report().status != LcpStatus::solved) break;
    const EnergyLedger& energy = simulation.report().energy;
    const double now = energy.kinetic + energy.potential;
    const double size = 1.0 + std::abs(now) + std::abs(energy.external_work);  // [J]
    EXPECT_LE(now - last - energy.external_work - energy.created, 1e-11 * size)
        << what << ", at " << simulation.time() << " s";
    last = now;
  }
  EXPECT_EQ(simulation.report().status, LcpStatus::solved) << what;
  return simulation.state();
}

TEST(Degenerate, FloorsInTheSamePlaceActAsOne) {
  for (const double speed : {0.0, 2.0}) {
    const Body box = dynamic(square(0.2), 1.0, {{0.0, 0.1}, 0.0}, {speed, 0.0, 0.0});
    const State one = run_carefully(scene_of(law(0.3), {fixed(level()), box}), 1e-3, 1.0, "one floor");
    const State five = run_carefully(
        scene_of(law(0.3), {fixed(level()), fixed(level()), fixed(level()), fixed(level()), fixed(level()), box}), 1e-3,
        1.0, "five floors");
    EXPECT_NEAR(one.bodies[1].pose.position.x, five.bodies[5].pose.position.x, 1e-12);
    EXPECT_NEAR(one.bodies[1].pose.position.y, five.bodies[5].pose.position.y, 1e-12);
  }
}

TEST(Degenerate, BoxFitsBetweenTwoWallsAndFalls) {
  for (const double friction : {0.0, 0.5, 2.0}) {
    const Scene scene = scene_of(
        law(friction), {fixed(wall_on_the_left(-0.1)), fixed(wall_on_the_right(0.1)), dynamic(square(0.2), 1.0, {})});
    const State end = run_carefully(scene, 1e-3, 0.5, "tight walls");
    EXPECT_NEAR(end.bodies[2].velocity[1], -k_g * 0.5, 1e-12);  // nothing presses it to a wall
  }
}

// Where sliding has no finite force or several, for rods at all angles and with all friction.
TEST(Degenerate, PainleveRodsStopOrLiftOff) {
  for (const double step_size : {1e-2, 1e-3, 1e-4}) {
    for (const double friction : {1.4, 1.5, 3.0, 10.0, 1e3, 1e6}) {
      for (const double degrees : {30.0, 45.0, 56.0, 63.4349, 70.0, 80.0, 89.0}) {
        for (const double restitution : {0.0, 0.5}) {
          const double angle = radians(degrees);
          const Body rod = dynamic_of_gyration(
              segment({-0.5, 0.0}, {0.5, 0.0}), 1.0, 1.0 / 12.0,
              {{0.5 * std::cos(angle), 0.5 * std::sin(angle) + (restitution > 0.0 ? 0.01 : 0.0)}, angle},
              {-1.0, 0.0, 0.2});
          run_carefully(scene_of(law(friction, restitution), {fixed(level()), rod}), step_size, 0.5,
                        "friction " + std::to_string(friction) + ", " + std::to_string(degrees) + " deg, e " +
                            std::to_string(restitution));
        }
      }
    }
  }
}

TEST(Degenerate, BodiesThatOverlapAtTheStartStayWhereTheyAreOrPart) {
  const Shape shapes[] = {square(0.2), disc(0.1), ellipse(0.2, 0.1), capsule(0.2, 0.05)};
  for (const Shape& shape : shapes) {
    run_carefully(scene_of(law(0.5), {fixed(level()), dynamic(shape, 1.0, {{0.0, 0.05}, 0.0})}), 1e-3, 0.5,
                  "in the floor");
    run_carefully(scene_of(law(0.5), {fixed(level()), dynamic(shape, 1.0, {{0.0, 0.5}, 0.3}),
                                      dynamic(shape, 1.0, {{0.0, 0.5}, 0.3})}),
                  1e-3, 1.0, "in the same place");
    run_carefully(scene_of(law(0.5), {fixed(level()), dynamic(shape, 1.0, {{0.0, 0.5}, 0.3}),
                                      dynamic(shape, 1.0, {{0.05, 0.5}, 0.4})}),
                  1e-3, 1.0, "in each other");
  }
}

TEST(Degenerate, BalancedBodiesStayBalancedOrFall) {
  run_carefully(
      scene_of(law(0.5), {fixed(level()), dynamic(square(0.2), 1.0, {{0.0, 0.1 * std::sqrt(2.0)}, 0.25 * k_pi})}), 1e-3,
      1.0, "square on its corner");
  run_carefully(scene_of(law(0.5), {fixed(level()), dynamic_of_gyration(segment({-0.5, 0.0}, {0.5, 0.0}), 1.0,
                                                                        1.0 / 12.0, {{0.0, 0.5}, 0.5 * k_pi})}),
                1e-3, 1.0, "rod on its end");
  run_carefully(scene_of(law(0.5, 0.3), {fixed(RoundedPolygon{{{-0.2, 0.0}, {0.2, 0.0}, {0.0, 0.2}}}),
                                         dynamic(disc(0.1), 1.0, {{0.0, 0.5}, 0.0})}),
                1e-3, 1.0, "disc on an edge");
}

TEST(Degenerate, DiscJamsBetweenTwoSteepSlopes) {
  for (const double friction : {0.0, 0.5, 3.0}) {
    const Scene scene = scene_of(law(friction), {fixed(slope(radians(80.0))), fixed(slope(radians(-80.0))),
                                                 dynamic(disc(0.1), 1.0, {{0.0, 2.0}, 0.0})});
    const State end = run_carefully(scene, 1e-3, 2.0, "groove");
    EXPECT_NEAR(end.bodies[2].pose.position.y, 0.1 / std::cos(radians(80.0)), 1e-9);
  }
}

// From a millionth of a metre to a million: the same motion, in other units.
TEST(Degenerate, SizesFromMicrometresToMegametres) {
  run_carefully(scene_of(law(0.5, 0.5), {fixed(level()), dynamic(square(2e-6), 1e-12, {{0.0, 1e-5}, 0.3})}), 1e-6, 0.01,
                "micrometres");
  run_carefully(scene_of(law(0.5, 0.5), {fixed(level()), dynamic(square(2e6), 1e12, {{0.0, 2e6}, 0.3})}), 1.0, 3000.0,
                "megametres");
}

// No motion keeps the body out of both walls: that is said, and the run ends.
TEST(Degenerate, SqueezedBodyEndsTheRunWithAReason) {
  const Scene scene = scene_of(
      law(0.5), {kinematic(rectangle(0.1, 1.0), {{-0.2, 0.0}, 0.0}, {0.5, 0.0, 0.0}),
                 kinematic(rectangle(0.1, 1.0), {{0.2, 0.0}, 0.0}, {-0.5, 0.0, 0.0}), dynamic(square(0.2), 1.0, {})});
  const Trajectory run = simulate(scene, {.step_size = 1e-3, .duration = 0.5});
  EXPECT_FALSE(run.is_complete);
  EXPECT_EQ(run.status, LcpStatus::infeasible);
  EXPECT_NEAR(run.time.back(), 0.1, 2e-3);
}

// A hundred and ten thousand times what is asked of stacks. (At 1 : 10^12 it sinks by 5e-6 m.)
TEST(Degenerate, HugeMassRatiosStand) {
  for (const double mass : {1e8, 1e10}) {
    const Scene scene = scene_of(law(0.5), {fixed(level()), dynamic(square(0.2), 1.0, {{0.0, 0.1}, 0.0}),
                                            dynamic(square(0.2), mass, {{0.0, 0.3}, 0.0})});
    const State end = state_after(scene, 1e-3, 1.0);
    EXPECT_NEAR(end.bodies[2].pose.position.y, 0.3, 1e-6) << mass;
  }
}

}  // namespace
}  // namespace tumble::physics
