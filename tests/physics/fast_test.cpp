// Fast bodies do not pass through thin ones, at any step size.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "closed_form.hpp"
#include "random.hpp"
#include "scene_builder.hpp"
#include <gtest/gtest.h>

namespace tumble::physics {
namespace {

constexpr double k_speed = 1000.0;   // [m/s]
constexpr double k_duration = 0.02;  // [s]

// Runs a scene without gravity at step sizes from longer than the whole flight to a small part of it, and restitutions;
// the last body must stay on its side of the first, or inside, as `is_right` has it.
template <class IsRight>
void expect_no_passage(std::vector<Body> bodies, IsRight is_right, const std::string& what,
                       const std::vector<double>& restitutions = {0.0, 0.5, 1.0}) {
  for (const double step_size : {1e-2, 1e-3, 1e-4}) {
    for (const double restitution : restitutions) {
      const Scene scene = without_gravity(scene_of(law(0.3, restitution), bodies));
      Simulation simulation = start(scene, step_size, k_duration);
      bool is_through = false;
      ASSERT_NO_THROW(
          is_through = run_until(simulation, [&](const State& state, const StepReport&) { return !is_right(state); }));
      EXPECT_FALSE(is_through) << what << ", step size " << step_size << ", e " << restitution << ", at "
                               << simulation.time() << " s";
    }
  }
}

bool is_in_order(const State& state) {
  return state.bodies.front().pose.position.x > state.bodies.back().pose.position.x;
}

Body wall(double half_height = 1.0) {
  return fixed(segment({0.0, -half_height}, {0.0, half_height}), {{1.0, 0.0}, 0.0});
}

TEST(Fast, BodiesStayInFrontOfAWallWithoutThickness) {
  expect_no_passage({wall(), dynamic(disc(0.01), 1.0, {}, {k_speed, 0.0, 0.0})}, is_in_order, "disc");
  expect_no_passage({wall(), dynamic(square(0.02), 1.0, {{}, 0.3}, {k_speed, 20.0, 0.0})}, is_in_order, "square");
  expect_no_passage({wall(), dynamic(capsule(0.05, 0.005), 1.0, {{}, 0.3}, {k_speed, 20.0, 0.0})}, is_in_order,
                    "capsule");
}

// After the impact they roll along the wall, at up to 140 m/s: it has to be longer than that takes them.
TEST(Fast, LongBodiesThatTurnStayInFrontOfAWallWithoutThickness) {
  const Body long_wall = wall(30.0);
  expect_no_passage({long_wall, dynamic(ellipse(0.02, 0.01), 1.0, {{}, 0.3}, {k_speed, 20.0, 0.0})}, is_in_order,
                    "ellipse");
  // Without any thickness, a rod that comes to lie flat on the wall is on neither side of it; one that bounces is.
  expect_no_passage({long_wall, dynamic_of_gyration(segment({-0.1, 0.0}, {0.1, 0.0}), 1.0, 0.04 / 12.0, {{}, 1.2},
                                                    {k_speed, 0.0, 40.0})},
                    is_in_order, "thin rod", {0.5, 1.0});
  expect_no_passage({long_wall, dynamic(capsule(0.2, 0.0001), 1.0, {{}, 1.2}, {k_speed, 0.0, 40.0})}, is_in_order,
                    "rod");
}

TEST(Fast, ThinBodiesDoNotPassEachOther) {
  // 1 mm thick, 1 m per step and more.
  expect_no_passage({dynamic(rectangle(0.001, 0.2), 1.0, {{0.6, 0.0}, 0.0}, {-0.5 * k_speed, 0.0, 0.0}),
                     dynamic(rectangle(0.001, 0.2), 2.0, {{-0.6123, 0.0}, 0.0}, {0.5 * k_speed, 0.0, 0.0})},
                    is_in_order, "bars");
  expect_no_passage({dynamic(disc(0.005), 1.0, {{0.6, 0.0}, 0.0}, {-0.5 * k_speed, 0.0, 0.0}),
                     dynamic(disc(0.01), 2.0, {{-0.6123, 0.0}, 0.0}, {0.5 * k_speed, 0.0, 0.0})},
                    is_in_order, "discs");
  expect_no_passage({dynamic_of_gyration(segment({0.0, -0.1}, {0.0, 0.1}), 1.0, 0.04 / 12.0, {{0.6, 0.0}, 0.0},
                                         {-0.5 * k_speed, 0.0, 0.0}),
                     dynamic(disc(0.01), 2.0, {{-0.6123, 0.0}, 0.0}, {0.5 * k_speed, 0.0, 0.0})},
                    is_in_order, "rod and disc");
}

TEST(Fast, WallThatMovesTakesBodiesAlong) {
  expect_no_passage({dynamic(disc(0.01), 1.0, {{0.61234, 0.0}, 0.0}),
                     kinematic(segment({0.0, -1.0}, {0.0, 1.0}), {}, {k_speed, 0.0, 0.0})},
                    is_in_order, "moving wall");
}

TEST(Fast, BallStaysInABoxOfFourSegments) {
  const auto is_inside = [](const State& state) {
    const Vector2 place = state.bodies.back().pose.position;
    return std::abs(place.x) < 0.1 && std::abs(place.y) < 0.1;
  };
  expect_no_passage({fixed(segment({-0.1, -0.1}, {0.1, -0.1})), fixed(segment({0.1, -0.1}, {0.1, 0.1})),
                     fixed(segment({0.1, 0.1}, {-0.1, 0.1})), fixed(segment({-0.1, 0.1}, {-0.1, -0.1})),
                     dynamic(disc(0.01), 1.0, {}, {k_speed, 0.7 * k_speed, 30.0})},
                    is_inside, "ball in a box");
}

TEST(Fast, BodiesDoNotSinkIntoTerrain) {
  const auto is_above = [](const State& state) { return state.bodies.back().pose.position.y > 0.0; };
  const Body ground = fixed(Terrain{{{-100.0, 0.0}, {0.0, 0.0}, {100.0, 0.0}}});
  expect_no_passage({ground, dynamic(disc(0.01), 1.0, {{0.0, 0.71234}, 0.0}, {20.0, -k_speed, 0.0})}, is_above, "disc");
  expect_no_passage({ground, dynamic(square(0.02), 1.0, {{0.0, 0.71234}, 0.4}, {20.0, -k_speed, 0.0})}, is_above,
                    "square");
}

// Boxes that land at 9 m/s, 9 cm per step of 10 ms.
Scene falling_heap(ContactLaw contact_law, std::uint64_t seed) {
  problems::Random random(40 + seed);
  std::vector<Body> bodies = {fixed(level()), fixed(wall_on_the_left(-1.2)), fixed(wall_on_the_right(1.2))};
  for (int i = 0; i < 56; ++i) {
    const double x = 0.3 * (i % 7 - 3) + random.uniform(-5e-3, 5e-3), y = 0.2 + 0.3 * (i / 7);
    bodies.push_back(dynamic(square(0.2), 1.0, {{x, y}, random.uniform(-k_pi, k_pi)}, {0.0, -9.0, 0.0}));
  }
  return scene_of(contact_law, bodies);
}

struct Landing {
  double depth = 0.0;    // [m] the deepest overlap
  double created = 0.0;  // [J] reported
};

// Energy rises by no more than is reported.
Landing land(const Scene& scene, ContactSolver solver) {
  SimulateSettings settings = {.step_size = 0.01, .duration = 0.4, .keeps_contacts = false};
  settings.step.solver = solver;
  Simulation simulation(scene, settings);
  const EnergyLedger start = energies(scene, simulation.state());
  double last = start.kinetic + start.potential;
  const double round_off = 1e-12 * last;
  Landing landing;
  while (!simulation.is_done()) {
    simulation.advance();
    const StepReport& report = simulation.report();
    const double now = report.energy.kinetic + report.energy.potential;
    EXPECT_LE(now - last, report.energy.created + round_off) << "at " << simulation.time() << " s";
    last = now;
    landing.created += report.energy.created;
    for (const ContactRecord& record : report.contacts) landing.depth = std::max(landing.depth, -record.contact.gap);
  }
  return landing;
}

// Each box stops before the next one is far in it, also where it meets others first, or stops because it meets them.
TEST(Fast, BoxesThatFallTogetherDoNotRunIntoEachOther) {
  constexpr double accepted_depth = 0.005;  // [m] they turn by up to 0.4 rad per step
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    for (const ContactSolver solver : {ContactSolver::exact, ContactSolver::fast}) {
      EXPECT_LT(land(falling_heap(law(0.5), seed), solver).depth, accepted_depth)
          << "seed " << seed << (solver == ContactSolver::fast ? ", fast" : "");
    }
  }
}

// Where impacts lose nothing, what bodies that stop on their way do not fall is energy made.
TEST(Fast, EnergyThatStopsMakeIsReported) {
  double created = 0.0;
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    created += land(falling_heap(law(0.0, 1.0), seed), ContactSolver::exact).created;
  }
  EXPECT_GT(created, 0.0);
}

// Bodies of every shape, of masses a million times apart, in a closed box, as fast as 55 of their sizes per second.
struct Crush {
  Scene scene;
  double size, step_size;
};

Crush crush(std::uint64_t seed) {
  problems::Random random(seed);
  const double size = random.log_uniform(-1.3, 1.3), speed = std::exp(random.uniform(-2.0, 4.0)) * size;
  const int num_bodies = 1 + static_cast<int>(seed % 12);
  std::vector<Body> bodies = {fixed(level()), fixed(wall_on_the_left(-8.0 * size)),
                              fixed(wall_on_the_right(8.0 * size)), fixed(ceiling(20.0 * size))};
  for (int i = 0; i < num_bodies; ++i) {
    const Shape shapes[] = {square(size),     rectangle(size, 0.05 * size), regular_polygon(3 + i % 6, size),
                            disc(0.5 * size), ellipse(size, 0.3 * size),    capsule(size, 0.1 * size)};
    const auto velocity = [&] { return random.uniform(-1.0, 1.0) * speed; };
    const Pose pose{{(i % 4 - 1.5) * 3.0 * size, (2 + 3 * (i / 4)) * size}, random.uniform(-3.0, 3.0)};
    const double mass = random.log_uniform(-10.0, 10.0);
    bodies.push_back(dynamic(shapes[random.below(6)], mass, pose, {velocity(), velocity(), velocity() / size}));
  }
  const double friction = 0.4 * static_cast<double>(random.below(3));
  const double restitution = 0.5 * static_cast<double>(random.below(3));
  const double turn_per_step = 0.3;  // [rad] at most
  const double step_size = std::min(std::exp(random.uniform(-8.0, -3.5)), turn_per_step * size / speed);
  return {scene_of(law(friction, restitution), bodies), size, step_size};
}

bool is_in_the_box(const State& state, double size) {
  return std::all_of(state.bodies.begin() + 4, state.bodies.end(), [&](const auto& body) {
    const Vector2 p = body.pose.position;
    return std::abs(p.x) <= 8.0 * size && p.y >= 0.0 && p.y <= 20.0 * size && std::isfinite(body.velocity[2]);
  });
}

// Light bodies between heavy ones are pressed against the walls, and do not come out on their other side.
TEST(Fast, BodiesOfAllMassesStayInAClosedBox) {
  constexpr int num_steps = 150;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const Crush c = crush(seed);
    SimulateSettings settings = {
        .step_size = c.step_size, .duration = num_steps * c.step_size, .keeps_contacts = false};
    if (seed % 2 == 1) settings.step.solver = ContactSolver::fast;
    Simulation simulation(c.scene, settings);
    const bool is_out =
        run_until(simulation, [&](const State& state, const StepReport&) { return !is_in_the_box(state, c.size); });
    EXPECT_FALSE(is_out) << "seed " << seed << ", step size " << c.step_size << ", at " << simulation.time() << " s";
  }
}

}  // namespace
}  // namespace tumble::physics
