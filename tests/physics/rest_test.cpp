// Bodies at rest stay at rest, and bodies that fall come to rest.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "closed_form.hpp"
#include "random.hpp"
#include "scene_builder.hpp"
#include <gtest/gtest.h>

namespace tumble::physics {
namespace {

constexpr double k_step_size = 1e-3;
constexpr double k_long = 60.0;            // [s]
constexpr double k_accepted_drift = 1e-9;  // [m], [rad]
constexpr double k_accepted_depth = 1e-6;  // [m]
constexpr double k_rest_energy = 1e-12;    // [J]
constexpr double k_settling_time = 0.3;    // [s] after the last impact
constexpr double k_quiet_time = 1.0;       // [s] after which a body is taken to stay at rest

struct LongRun {
  double drift = 0.0;  // [m, rad] largest of all bodies, from `since` on
  double depth = 0.0;  // [m] largest overlap
};

LongRun run_long(const Scene& scene, double since, double step_size = k_step_size, double duration = k_long) {
  Simulation simulation = start(scene, step_size, duration);
  LongRun result;
  std::vector<BodyState> first = simulation.state().bodies;
  bool has_begun = since == 0.0;
  run_until(simulation, [&](const State& state, const StepReport& report) {
    for (const ContactRecord& record : report.contacts) result.depth = std::max(result.depth, -record.contact.gap);
    if (!has_begun && state.time >= since) {
      has_begun = true;
      first = state.bodies;
    }
    if (!has_begun) return false;
    for (std::size_t i = 0; i < first.size(); ++i) {
      const Pose &from = first[i].pose, &to = state.bodies[i].pose;
      result.drift = std::max({result.drift, length(to.position - from.position), std::abs(to.angle - from.angle)});
    }
    return false;
  });
  return result;
}

void expect_rest(const Scene& scene, double since, const std::string& what) {
  const LongRun run = run_long(scene, since);
  EXPECT_LT(run.drift, k_accepted_drift) << what;
  EXPECT_LT(run.depth, k_accepted_depth) << what;
}

// Shapes that lie flat, their centre so far above the ground.
struct Lying {
  const char* name;
  Shape shape;
  double height;
};

std::vector<Lying> lying_shapes() {
  const double apothem = std::sqrt(3.0) / 2.0;
  return {{"square", square(0.2), 0.1},
          {"flat rectangle", rectangle(0.5, 0.1), 0.05},
          {"hexagon", regular_polygon(6, 0.2), 0.2 * apothem},
          {"triangle", regular_polygon(3, 0.2), 0.1},
          {"rounded square", square(0.2, 0.03), 0.1},
          {"capsule", capsule(0.3, 0.05), 0.05}};
}

TEST(Rest, BodiesStayOnASlopeJustBelowTheAngleOfFriction) {
  for (const double friction : {0.2, 0.4}) {
    const double angle = 0.999 * std::atan(friction);
    for (const Lying& lying : lying_shapes()) {
      expect_rest(
          scene_of(law(friction), {fixed(slope(angle)), dynamic(lying.shape, 0.3, on_slope(angle, 0.0, lying.height))}),
          0.0, lying.name);
    }
  }
}

TEST(Rest, BodiesSlideOnASlopeJustAboveTheAngleOfFriction) {
  for (const double friction : {0.2, 0.4}) {
    const double angle = 1.001 * std::atan(friction);
    const double right = k_g * (std::sin(angle) - friction * std::cos(angle));
    for (const Lying& lying : lying_shapes()) {
      const Scene scene =
          scene_of(law(friction), {fixed(slope(angle)), dynamic(lying.shape, 0.3, on_slope(angle, 0.0, lying.height))});
      const State end = state_after(scene, k_step_size, 1.0);
      const Vector2 velocity = {end.bodies[1].velocity[0], end.bodies[1].velocity[1]};
      // The acceleration is the difference of two that are 500 times larger, each with the round-off of a thousand
      // steps.
      EXPECT_LT(relative(-dot(velocity, up_slope(angle)), right * end.time), 1e-10) << lying.name;
    }
  }
}

Scene stack(const std::vector<double>& masses, double gap, ContactLaw contact_law) {
  std::vector<Body> bodies = {fixed(level())};
  for (std::size_t i = 0; i < masses.size(); ++i) {
    bodies.push_back(
        dynamic(square(0.25), masses[i], {{0.0, 0.125 + gap + (0.25 + gap) * static_cast<double>(i)}, 0.0}));
  }
  return scene_of(contact_law, bodies);
}

TEST(Rest, StackOfTenStands) {
  const std::vector<double> masses(10, 0.5);
  expect_rest(stack(masses, 0.0, law(0.5)), 0.0, "without gaps");
  expect_rest(stack(masses, 1e-4, law(0.5)), 0.5, "0.1 mm apart");
  expect_rest(stack(masses, 0.0, law(0.5, 0.5)), 0.0, "without gaps, e = 0.5");
}

TEST(Rest, StackOfTenBouncesAndStands) {
  expect_rest(stack(std::vector<double>(10, 0.5), 1e-4, law(0.5, 0.5)), 2.0, "0.1 mm apart, e = 0.5");
}

TEST(Rest, LightAndHeavyStandOnEachOther) {
  expect_rest(stack({1.0, 1e6}, 0.0, law(0.5)), 0.0, "heavy on light");
  expect_rest(stack({1e6, 1.0}, 0.0, law(0.5)), 0.0, "light on heavy");
  expect_rest(stack({1.0, 1e6, 1.0, 1e6}, 0.0, law(0.5)), 0.0, "in turn");
  expect_rest(stack({1.0, 1e6}, 1e-4, law(0.5)), 0.5, "heavy on light, 0.1 mm apart");
  expect_rest(stack({1e6, 1.0}, 1e-4, law(0.5)), 0.5, "light on heavy, 0.1 mm apart");
}

struct Structure {
  const char* name;
  std::vector<Body> bodies;
};

// All stand by friction of 0.5, static or kinetic.
std::vector<Structure> structures() {
  std::vector<Body> pyramid = {fixed(level())};
  for (int row = 0; row < 4; ++row) {
    for (int i = 0; i < 4 - row; ++i) {
      pyramid.push_back(dynamic(rectangle(0.25, 0.2), 0.5, {{0.13 * row + 0.26 * i, 0.1 + 0.2 * row}, 0.0}));
    }
  }
  const std::vector<Body> lintel = {fixed(level()), dynamic(rectangle(0.2, 1.0), 3.0, {{-0.5, 0.5}, 0.0}),
                                    dynamic(rectangle(0.2, 1.0), 3.0, {{0.5, 0.5}, 0.0}),
                                    dynamic(rectangle(1.3, 0.2), 2.0, {{0.05, 1.1}, 0.0})};
  const double lean = radians(65.0);
  const std::vector<Body> ladder = {fixed(level()), fixed(wall_on_the_left(0.0)),
                                    dynamic_of_gyration(segment({-0.5, 0.0}, {0.5, 0.0}), 1.0, 1.0 / 12.0,
                                                        {{0.5 * std::cos(lean), 0.5 * std::sin(lean)}, -lean})};
  constexpr double R = 0.125;
  const std::vector<Body> discs = {fixed(level()),
                                   fixed(wall_on_the_left(-2.0 * R)),
                                   fixed(wall_on_the_right(2.0 * R)),
                                   dynamic(disc(R), 0.5, {{-R, R}, 0.0}),
                                   dynamic(disc(R), 0.5, {{R, R}, 0.0}),
                                   dynamic(disc(R), 0.5, {{0.0, R + std::sqrt(3.0) * R}, 0.0})};
  const double angle = radians(20.0);
  const std::vector<Body> squares = {fixed(slope(angle)), dynamic(square(0.2), 1.0, on_slope(angle, 0.0, 0.1)),
                                     dynamic(square(0.2), 1.0, on_slope(angle, 0.02, 0.3))};
  return {{"pyramid", pyramid},
          {"lintel", lintel},
          {"ladder", ladder},
          {"three discs", discs},
          {"squares on a slope", squares}};
}

void expect_to_stand(const Structure& structure, ContactLaw contact_law) {
  for (const double step_size : {1e-4, 1e-3, 1e-2, 5e-2}) {
    const LongRun run = run_long(scene_of(contact_law, structure.bodies), 0.0, step_size, 3000.0 * step_size);
    EXPECT_LT(run.drift, k_accepted_drift)
        << structure.name << ", step size " << step_size << ", e " << contact_law.restitution;
    EXPECT_LT(run.depth, k_accepted_drift) << structure.name << ", step size " << step_size;
  }
}

TEST(Rest, StructuresStandAtAllStepSizes) {
  for (const Structure& structure : structures()) {
    expect_to_stand(structure, law(0.5));
    expect_to_stand(structure, law(0.5, 0.5));
    expect_to_stand(structure, static_and_kinetic(0.6, 0.3));
  }
}

// Kinetic energy below 1e-12 J from 0.3 s after the last impact on, and the time v / (friction g) that the body
// slides on from there.
void expect_to_settle(const Scene& scene, double duration, const std::string& what) {
  Simulation simulation = start(scene, k_step_size, duration);
  double last_impact = 0.0, last_motion = 0.0, speed = 0.0;
  run_until(simulation, [&](const State& state, const StepReport& report) {
    for (const ContactRecord& record : report.contacts) {
      if (record.restitution == 0.0 || record.normal_impulse == 0.0) continue;
      last_impact = state.time;
      speed = std::abs(state.bodies[1].velocity[0]);
    }
    if (report.energy.kinetic >= k_rest_energy) last_motion = state.time;
    return state.time > last_motion + k_quiet_time;
  });
  EXPECT_LT(last_motion, last_impact + k_settling_time + speed / (scene.materials[0].law.friction * k_g)) << what;
  EXPECT_LT(last_motion, duration - k_quiet_time) << what;
}

TEST(Rest, DroppedPolygonsSettle) {
  for (const double restitution : {0.2, 0.5, 0.7}) {
    for (const double friction : {0.1, 0.3, 0.8}) {
      for (const double angle : {0.0, 0.1, 0.5236, 0.7, 2.0}) {
        for (const Lying& lying : lying_shapes()) {
          const Scene scene =
              scene_of(law(friction, restitution),
                       {fixed(level()), dynamic(lying.shape, 0.3, {{0.0, 0.8}, angle}, {0.3, -0.2, 0.0})});
          expect_to_settle(scene, 8.0,
                           std::string(lying.name) + ", angle " + std::to_string(angle) + ", friction " +
                               std::to_string(friction) + ", e " + std::to_string(restitution));
        }
      }
    }
  }
}

// Polygons and capsules that fall onto each other in a box, of masses from 0.3 to 3 kg: in the end nothing moves, also
// with restitution. (Discs and ellipses may roll and rock on.)
TEST(Rest, PilesSettle) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    problems::Random random(700 + seed);
    std::vector<Body> bodies = {fixed(level()), fixed(wall_on_the_left(-0.6)), fixed(wall_on_the_right(0.6))};
    for (int i = 0; i < 8; ++i) {
      const Shape shapes[] = {square(0.2), regular_polygon(3 + i % 5, 0.12), capsule(0.12, 0.05)};
      const Pose pose = {{-0.4 + 0.27 * (i % 4) + random.uniform(0.0, 0.02), 0.2 + 0.35 * (i / 4)},
                         random.uniform(0.0, 6.3)};
      const double mass = random.log_uniform(-1.7, 1.6), v = random.uniform(-0.5, 0.5), w = random.uniform(-2.0, 2.0);
      bodies.push_back(dynamic(shapes[random.below(3)], mass, pose, {v, -0.5, w}));
    }
    const double restitution = seed % 3 == 0 ? 0.0 : seed % 3 == 1 ? 0.3 : 0.7;
    const Scene scene = scene_of(law(random.uniform(0.3, 0.8), restitution), bodies);
    const State end = state_after(scene, k_step_size, 6.0);
    EXPECT_LT(energies(scene, end).kinetic, k_rest_energy) << "seed " << seed << ", e " << restitution;
  }
}

}  // namespace
}  // namespace tumble::physics
