// The laws of mechanics and contact in every step of the scenes in scenes/, and of scenes at random.
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "closed_form.hpp"
#include "laws.hpp"
#include "named_scenes.hpp"
#include "random.hpp"
#include "scene_builder.hpp"
#include <gtest/gtest.h>

namespace tumble::physics {
namespace {

// The first broken law of each kind, with the time, and the largest overlap from a time on. Every step is held to the
// residual that it reports; all but `accepted_inexact_steps` have to be solved.
std::map<std::string, std::string> first_faults(const Scene& scene, double step_size, double duration, double* depth,
                                                int accepted_inexact_steps = 0, double depth_from = 0.0) {
  std::map<std::string, std::string> faults;
  Simulation simulation = start(scene, step_size, duration);
  State before = simulation.state();
  while (!simulation.is_done()) {
    simulation.advance();
    const State& after = simulation.state();
    const StepReport& report = simulation.report();
    for (const std::string& fault : broken_laws(scene, step_size, before, after, report)) {
      const std::string kind = fault.substr(0, fault.find(':'));
      faults.try_emplace(kind, fault + ", at " + std::to_string(after.time) + " s");
    }
    if (depth && after.time >= depth_from) {
      for (const ContactRecord& record : report.contacts) *depth = std::max(*depth, -record.contact.gap);
    }
    before = after;
  }
  EXPECT_TRUE(simulation.trajectory().is_complete);
  EXPECT_LE(simulation.trajectory().num_inexact_steps, accepted_inexact_steps);
  return faults;
}

void expect_laws(const Scene& scene, double step_size, double duration, const std::string& what,
                 int accepted_inexact_steps = 0) {
  for (const auto& [kind, fault] : first_faults(scene, step_size, duration, nullptr, accepted_inexact_steps))
    ADD_FAILURE() << what << ": " << fault;
}

// Of jammed concave bodies, in 3000 steps: see docs/theory/step.md.
int accepted_inexact_steps(const std::string& scene) { return scene == "pile" ? 10 : 0; }

class NamedScene : public testing::TestWithParam<std::string> {};

TEST_P(NamedScene, KeepsTheLaws) {
  const Scene scene = named_scene(GetParam());
  ASSERT_NO_THROW(expect_laws(scene, scene.step_size, scene.duration, GetParam(), accepted_inexact_steps(GetParam())));
}

// Bodies may overlap by what a step does not see to third order, but not more and more.
TEST_P(NamedScene, DoesNotSink) {
  constexpr double accepted_depth = 1e-5;  // [m]
  const Scene scene = named_scene(GetParam());
  double depth = 0.0;
  // At its step of 2 ms, boxes of the pile that turn at 20 rad/s while they fall overlap by twice that.
  const double from = GetParam() == "pile" ? 0.5 * scene.duration : 0.0;
  ASSERT_NO_THROW(
      first_faults(scene, scene.step_size, scene.duration, &depth, accepted_inexact_steps(GetParam()), from));
  EXPECT_LT(depth, accepted_depth);
}

TEST(NamedScenes, APileDoesNotSinkWhileItFalls) {
  constexpr double accepted_depth = 1e-5;  // [m]
  const Scene scene = named_scene("pile");
  double depth = 0.0;
  ASSERT_NO_THROW(first_faults(scene, 1e-3, scene.duration, &depth, accepted_inexact_steps("pile")));
  EXPECT_LT(depth, accepted_depth);
}

TEST(NamedScenes, APileComesToRest) {
  const Scene scene = named_scene("pile");
  Simulation simulation = start(scene, scene.step_size, scene.duration);
  while (!simulation.is_done()) simulation.advance();
  EXPECT_TRUE(simulation.trajectory().is_complete);
  EXPECT_LT(simulation.report().energy.kinetic, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Physics, NamedScene, testing::ValuesIn(scene_names()),
                         [](const auto& scene) { return scene.param; });

// A few bodies of all shapes in a box, with spin, all of one law.
Scene random_scene(problems::Random& random, double friction, double restitution) {
  std::vector<Body> bodies = {fixed(level()), fixed(wall_on_the_left(-0.6)), fixed(wall_on_the_right(0.6))};
  const Shape shapes[] = {disc(0.1),
                          square(0.2),
                          ellipse(0.15, 0.08),
                          capsule(0.2, 0.06),
                          regular_polygon(5, 0.12),
                          rectangle(0.3, 0.1, 0.02)};
  for (int i = 0; i < 6; ++i) {
    const double x = i % 2 == 0 ? -0.25 : 0.25, y = 0.3 + 0.4 * (i / 2);
    const double mass = random.log_uniform(-2.0, 2.0);
    const double angle = random.uniform(0.0, 6.3);
    const double v_x = random.uniform(-1.0, 1.0), v_y = random.uniform(-1.0, 1.0), w = random.uniform(-8.0, 8.0);
    bodies.push_back(dynamic(shapes[i], mass, {{x, y}, angle}, {v_x, v_y, w}));
  }
  return scene_of(law(friction, restitution), bodies);
}

TEST(RandomScenes, KeepTheLaws) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    problems::Random random(seed);
    const double friction = random.uniform(0.0, 1.0), restitution = seed % 2 == 0 ? 0.0 : random.uniform(0.1, 1.0);
    expect_laws(random_scene(random, friction, restitution), 1e-3, 1.5, "seed " + std::to_string(seed));
  }
}

TEST(RandomScenes, NeverGainEnergyWithoutRestitution) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    problems::Random random(100 + seed);
    const Scene scene = random_scene(random, random.uniform(0.0, 1.5), 0.0);
    Simulation simulation = start(scene, 1e-3, 2.0);
    const EnergyLedger first = energies(scene, simulation.state());
    double last = first.kinetic + first.potential, rise = 0.0;
    run_until(simulation, [&](const State&, const StepReport& report) {
      const double now = report.energy.kinetic + report.energy.potential;
      rise = std::max(rise, now - last);
      last = now;
      return false;
    });
    EXPECT_LE(rise, 1e-12 * (first.kinetic + first.potential)) << "seed " << seed;  // round-off of the sums
  }
}

}  // namespace
}  // namespace tumble::physics
