// Steps of scenes take no memory from the heap once their workspace has grown.
#include "../allocations.hpp"
#include <gtest/gtest.h>

#include "tumble/step/time_step.hpp"

namespace tumble::test {
namespace {

constexpr int k_steps = 1000;

Scene on_ground(double friction, double restitution) {
  Scene scene;
  scene.materials = {{"all", {friction, friction, restitution}}};
  Body& ground = scene.bodies.emplace_back();
  ground.kind = BodyKind::fixed;
  ground.parts = {{RoundedPolygon{{{-10, -1}, {10, -1}, {10, 0}, {-10, 0}}, 0.0}}};
  return scene;
}

void add_box(Scene& scene, const Pose& pose) {
  Body& body = scene.bodies.emplace_back();
  body.parts = {{square(0.2)}};
  set_mass(body, 0.3);
  body.pose = pose;
}

// In `k_steps` steps after `warm_up` steps: how many of them took memory, and how many contacts were closed in them.
struct Seen {
  long allocating_steps = 0, contacts = 0;
};
Seen allocations_of(const Scene& scene, int warm_up, ContactSolver solver = ContactSolver::exact) {
  StepWorkspace workspace(scene);
  State state = initial_state(scene);
  Seen seen;
  for (int i = 0; i < warm_up + k_steps; ++i) {
    const long before = num_allocations();
    time_step(scene, 0.01, {solver}, state, workspace);
    if (i < warm_up) continue;
    seen.allocating_steps += num_allocations() != before ? 1 : 0;
    seen.contacts += static_cast<long>(state.contacts.size());
  }
  return seen;
}

class StepAllocations : public testing::Test {
 protected:
  void SetUp() override {
    if (!counts_allocations()) GTEST_SKIP() << "only glibc without a sanitizer lets a program count all of them";
  }
};

// Fast impacts and slow ones, on corners and sides: it never loses energy.
TEST_F(StepAllocations, ABouncingSquareMakesNone) {
  Scene scene = on_ground(0.0, 1.0);
  add_box(scene, {{0, 1.5}, 0.5});
  const Seen seen = allocations_of(scene, 5 * k_steps);
  EXPECT_EQ(seen.allocating_steps, 0);
  EXPECT_GT(seen.contacts, 10);
}

TEST_F(StepAllocations, ATowerMakesNone) {
  Scene scene = on_ground(0.5, 0.0);
  for (int i = 0; i < 10; ++i) add_box(scene, {{0, 0.2 * (i + 0.5)}, 0});
  for (const ContactSolver solver : {ContactSolver::exact, ContactSolver::fast}) {
    const Seen seen = allocations_of(scene, 100, solver);
    EXPECT_EQ(seen.allocating_steps, 0);
    EXPECT_GT(seen.contacts, 19 * k_steps);
  }
}

TEST_F(StepAllocations, APileMakesNone) {
  Scene scene = on_ground(0.5, 0.0);
  for (int i = 0; i < 10; ++i) add_box(scene, {{0.11 * (i % 3) - 0.1, 0.2 + 0.3 * i}, 0.7 * i});
  for (const ContactSolver solver : {ContactSolver::exact, ContactSolver::fast}) {
    const Seen seen = allocations_of(scene, 600, solver);
    EXPECT_EQ(seen.allocating_steps, 0);
    EXPECT_GT(seen.contacts, 10 * k_steps);
  }
}

// With more contacts than the fast solver solves exactly.
TEST_F(StepAllocations, APyramidMakesNoneWithTheFastSolver) {
  Scene scene = on_ground(0.5, 0.0);
  for (int row = 0; row < 8; ++row) {
    for (int i = row; i < 8; ++i) add_box(scene, {{0.22 * (i - 0.5 * row), 0.2 * (row + 0.5)}, 0});
  }
  const Seen seen = allocations_of(scene, 600, ContactSolver::fast);
  EXPECT_EQ(seen.allocating_steps, 0);
  EXPECT_GT(seen.contacts, 60 * k_steps);
}

}  // namespace
}  // namespace tumble::test
