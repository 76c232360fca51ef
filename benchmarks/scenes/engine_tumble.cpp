// Tumble itself.
#include <memory>

#include "engine.hpp"

#include "tumble/math/format.hpp"
#include "tumble/step/time_step.hpp"

namespace tumble::bench {
namespace {

Part part_of(const Outline& outline) { return {RoundedPolygon{outline.vertices, outline.radius}}; }

Scene scene_of(const World& world) {
  Scene scene;
  scene.gravity = {0.0, -world.gravity};
  scene.materials = {{"all", {world.friction, world.friction, world.restitution}}};
  Body& walls = scene.bodies.emplace_back();
  walls.name = "walls";
  walls.kind = BodyKind::fixed;
  for (const Outline& wall : world.walls) walls.parts.push_back(part_of(wall));
  for (const WorldBody& body : world.bodies) {
    Body& b = scene.bodies.emplace_back();
    b.parts = {part_of(body.outline)};
    b.mass = body.mass;
    b.moment_of_inertia = body.moment_of_inertia;
    b.pose = body.pose;
    b.velocity = body.velocity;
  }
  return scene;
}

struct Simulated {
  Scene scene;
  StepWorkspace workspace;
  State state;

  explicit Simulated(const World& world) : scene(scene_of(world)), workspace(scene), state(initial_state(scene)) {}
};

Engine tumble_engine(std::string settings, const StepSettings& step) {
  const auto build = [=](const World& world, double step_size) {
    const auto shared = std::make_shared<Simulated>(world);
    const auto advance = [=](int count) {
      for (int i = 0; i < count; ++i) time_step(shared->scene, step_size, step, shared->state, shared->workspace);
    };
    const auto motion = [=](int body) {
      const BodyState& b = shared->state.bodies[static_cast<std::size_t>(body) + 1];  // after the walls
      return Motion{b.pose, b.velocity};
    };
    return Run{advance, motion, [=] { return static_cast<int>(shared->state.contacts.size()); }};
  };
  return {"Tumble", std::move(settings), "computes in double; every step of the exact setting solves its LCP to 1e-10",
          build};
}

}  // namespace

std::vector<Engine> tumble_engines() {
  return {tumble_engine("exact", {ContactSolver::exact}), tumble_engine("fast", {ContactSolver::fast})};
}

}  // namespace tumble::bench
