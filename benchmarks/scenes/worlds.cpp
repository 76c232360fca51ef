#include "worlds.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../lcp/random.hpp"

#include "tumble/math/format.hpp"

namespace tumble::bench {
namespace {

constexpr double k_side = 0.2;  // [m] of every box
constexpr double k_mass = 0.3;  // [kg]

Outline box(double left, double right, double bottom, double top) {
  return {{{left, bottom}, {right, bottom}, {right, top}, {left, top}}, 0.0};
}

// The ground y = 0, down to 1 m below.
Outline ground(double half_width) { return box(-half_width, half_width, -1.0, 0.0); }

WorldBody square_at(const Pose& pose) {
  constexpr double half = 0.5 * k_side;
  return {box(-half, half, -half, half), k_mass, k_mass * k_side * k_side / 6.0, pose, {}};
}

World bouncing(const char* name) {
  World world;
  world.name = name;
  world.question = Question::bounce;
  world.walls = {ground(10.0)};
  world.friction = 0.3;
  world.restitution = 0.5;
  world.duration = 1.5;
  return world;
}

// A wall 1 m thick along the left of the way from one point to another; right of it is free.
Outline wall_left_of(Vector2 from, Vector2 to) {
  const Vector2 along = to - from;
  const Vector2 left = (1.0 / length(along)) * turned_left(along);
  return {{from, to, to + left, from + left}, 0.0};
}

Outline mirrored(const Outline& outline) {
  Outline other = outline;
  for (Vector2& p : other.vertices) p.x = -p.x;
  std::reverse(other.vertices.begin(), other.vertices.end());
  return other;
}

}  // namespace

World dropped_square() {
  World world = bouncing("one square");
  world.bodies = {square_at({{0.0, 1.5}, std::numbers::pi / 6.0})};
  world.bodies[0].velocity = {0.0, -0.2, 0.0};
  return world;
}

World dropped_ball() {
  World world = bouncing("one ball");
  constexpr double radius = 0.1;
  world.bodies = {
      {Outline{{{0.0, 0.0}}, radius}, k_mass, 0.5 * k_mass * radius * radius, {{0.0, 1.1}, 0.0}, {1.0, 0.0, 0.0}}};
  return world;
}

World squares_side_by_side(int count) {
  constexpr double distance = 4.0;
  World world = bouncing("");
  world.name = tumble::format("{} squares side by side", count);
  world.walls = {ground(0.5 * distance * count + 10.0)};
  problems::Random random(1);
  for (int i = 0; i < count; ++i) {
    const double x = distance * (i - 0.5 * (count - 1));
    world.bodies.push_back(square_at({{x, 1.5}, random.uniform(0.0, 2.0 * std::numbers::pi)}));
    world.bodies.back().velocity = {0.0, -0.2, 0.0};
  }
  return world;
}

World tower(int count) {
  World world;
  world.name = tumble::format("tower of {} boxes", count);
  world.question = Question::stand;
  world.walls = {ground(10.0)};
  for (int i = 0; i < count; ++i) world.bodies.push_back(square_at({{0.0, k_side * (i + 0.5)}, 0.0}));
  world.friction = 0.5;
  world.duration = 10.0;
  return world;
}

World pile(int count) {
  // Each box starts at its own angle in a cell that its circumcircle (0.2829 m wide) fits in, jitter included.
  constexpr double cell = 0.3, jitter = 0.005;
  const int columns = static_cast<int>(std::ceil(std::sqrt(count)));
  const int rows = (count + columns - 1) / columns;
  const double half_width = 0.5 * cell * columns + 0.05;
  const double half_floor = 0.5 * half_width;
  const double rise = (half_width - half_floor) / std::numbers::sqrt3;  // a slope of 30 degrees
  const double first_row = rise + 0.2;
  const double top = first_row + cell * rows;

  World world;
  world.name = tumble::format("pile of {} boxes", count);
  world.question = Question::pile;
  world.friction = 0.5;
  world.duration = 3.0;
  const Outline slope = wall_left_of({half_width, rise}, {half_floor, 0.0});
  const Outline side = wall_left_of({half_width, top}, {half_width, rise});
  world.walls = {ground(half_width + 1.0), slope, mirrored(slope), side, mirrored(side)};
  problems::Random random(1);
  for (int i = 0; i < count; ++i) {
    const double x = cell * (i % columns - 0.5 * (columns - 1)) + random.uniform(-jitter, jitter);
    const double y = first_row + cell * (i / columns) + random.uniform(-jitter, jitter);
    world.bodies.push_back(square_at({{x, y}, random.uniform(-std::numbers::pi, std::numbers::pi)}));
  }
  return world;
}

}  // namespace tumble::bench
