// Bodies that slide, or that friction holds.
#include <algorithm>
#include <cmath>

#include "closed_form.hpp"
#include "scene_builder.hpp"

namespace tumble::physics {
namespace {

constexpr double k_side = 0.2, k_mass = 0.3, k_half = 0.5 * k_side;

// A square on a slope, its velocity along it.
Scene square_on_slope(double angle, ContactLaw contact_law, double speed) {
  const Vector2 up = up_slope(angle);
  return scene_of(contact_law, {fixed(slope(angle)), dynamic(square(k_side), k_mass, on_slope(angle, 0.0, k_half),
                                                             {speed * up.x, speed * up.y, 0.0})});
}

double along(const Vector3& velocity, double angle) {
  return velocity[0] * std::cos(angle) + velocity[1] * std::sin(angle);
}

double deceleration(double step_size) {
  const State end = state_after(square_on_slope(0.0, law(0.3), 2.0), step_size, 0.5);
  return relative(end.bodies[1].velocity[0], 2.0 - 0.3 * k_g * end.time);
}

double sliding_way(double step_size) {
  const State end = state_after(square_on_slope(0.0, law(0.3), 2.0), step_size, 1.0);
  return std::max(relative(end.bodies[1].pose.position.x, 4.0 / (2.0 * 0.3 * k_g)),
                  std::abs(end.bodies[1].velocity[0]));
}

double sliding_time(double step_size) {
  Simulation simulation = start(square_on_slope(0.0, law(0.3), 2.0), step_size, 1.0);
  run_until(simulation, [](const State&, const StepReport& report) { return !has_slip(report); });
  return relative(simulation.time(), 2.0 / (0.3 * k_g));
}

double down_the_slope(double degrees, double friction, double step_size) {
  const double angle = radians(degrees);
  const State end = state_after(square_on_slope(angle, law(friction), 0.0), step_size, 1.0);
  return relative(along(end.bodies[1].velocity, angle),
                  -k_g * (std::sin(angle) - friction * std::cos(angle)) * end.time);
}

double way_down_the_slope(double step_size) {
  const double angle = radians(30.0);
  const State end = state_after(square_on_slope(angle, law(0.3), 0.0), step_size, 1.0);
  const Vector2 way = end.bodies[1].pose.position - on_slope(angle, 0.0, k_half).position;
  return relative(-dot(way, up_slope(angle)),
                  0.5 * k_g * (std::sin(angle) - 0.3 * std::cos(angle)) * end.time * end.time);
}

// Up a slope of 20 deg at 2 m/s: v^2 / (2 g (sin + friction cos)) far.
double way_up_the_slope(double step_size) {
  const double angle = radians(20.0);
  Simulation simulation = start(square_on_slope(angle, law(0.3), 2.0), step_size, 1.0);
  double highest = 0.0;
  run_until(simulation, [&](const State& state, const StepReport&) {
    highest =
        std::max(highest, dot(state.bodies[1].pose.position - on_slope(angle, 0.0, k_half).position, up_slope(angle)));
    return false;
  });
  return relative(highest, 4.0 / (2.0 * k_g * (std::sin(angle) + 0.3 * std::cos(angle))));
}

// And back where it started, sqrt((sin - friction cos) / (sin + friction cos)) of its speed is left.
double speed_back(double step_size) {
  const double angle = radians(20.0);
  Simulation simulation = start(square_on_slope(angle, law(0.3), 2.0), step_size, 3.0);
  run_until(simulation, [&](const State& state, const StepReport&) {
    const Vector2 way = state.bodies[1].pose.position - on_slope(angle, 0.0, k_half).position;
    return along(state.bodies[1].velocity, angle) < 0.0 && dot(way, up_slope(angle)) <= 0.0;
  });
  const double s = std::sin(angle), c = 0.3 * std::cos(angle);
  return relative(-along(simulation.state().bodies[1].velocity, angle), 2.0 * std::sqrt((s - c) / (s + c)));
}

double holding_force(double step_size) {
  const double angle = radians(15.0);
  Simulation simulation = start(square_on_slope(angle, law(0.3), 0.0), step_size, 0.1);
  run_until(simulation, [](const State&, const StepReport&) { return false; });
  const Vector2 impulse = impulse_between(simulation.report(), 0, 1);
  return std::max(relative(dot(impulse, up_slope(angle)) / step_size, k_mass * k_g * std::sin(angle)),
                  relative(dot(impulse, turned_left(up_slope(angle))) / step_size, k_mass * k_g * std::cos(angle)));
}

// Pulled along the floor by a rope at an angle: a = (F cos - friction (m g - F sin)) / m.
double pulled_by_a_rope(double step_size) {
  const double angle = radians(35.0), force = 2.0;
  Scene scene = square_on_slope(0.0, law(0.3), 0.0);
  scene.bodies[1].wrenches = {{0.0, force * up_slope(angle), 0.0}};
  const State end = state_after(scene, step_size, 1.0);
  const double a = (force * std::cos(angle) - 0.3 * (k_mass * k_g - force * std::sin(angle))) / k_mass;
  return relative(end.bodies[1].velocity[0], a * end.time);
}

// Pressed to a wall by F it slides down with a = g - friction F / m.
double pressed_to_a_wall(double step_size) {
  Body body = dynamic(square(k_side), k_mass, {{-k_half, 0.0}, 0.0});
  body.wrenches = {{0.0, {4.0, 0.0}, 0.0}};
  const State end = state_after(scene_of(law(0.5), {fixed(wall_on_the_right(0.0)), body}), step_size, 0.5);
  return relative(-end.bodies[1].velocity[1], (k_g - 0.5 * 4.0 / k_mass) * end.time);
}

// Static friction 0.5 holds on 25 deg until a push; then the kinetic one, 0.3, does not.
double static_and_kinetic_friction(double step_size) {
  const double angle = radians(25.0);
  Scene scene = square_on_slope(angle, static_and_kinetic(0.5, 0.3), 0.0);
  const State held = state_after(scene, step_size, 0.5);
  const Vector2 up = up_slope(angle);
  scene.bodies[1].velocity = {-0.1 * up.x, -0.1 * up.y, 0.0};
  const State pushed = state_after(scene, step_size, 0.5);
  return std::max(std::abs(along(held.bodies[1].velocity, angle)),
                  relative(-along(pushed.bodies[1].velocity, angle),
                           0.1 + k_g * (std::sin(angle) - 0.3 * std::cos(angle)) * pushed.time));
}

// On a conveyor of speed V a square slips for V / (friction g), V^2 / (2 friction g) behind.
Scene conveyor() {
  Scene scene = square_on_slope(0.0, law(0.3), 0.0);
  scene.bodies[0].parts[0].surface_speed = 1.5;
  return scene;
}

double conveyor_time(double step_size) {
  Simulation simulation = start(conveyor(), step_size, 1.0);
  run_until(simulation, [](const State&, const StepReport& report) { return !has_slip(report); });
  return relative(simulation.time(), 1.5 / (0.3 * k_g));
}

double conveyor_slip(double step_size) {
  const State end = state_after(conveyor(), step_size, 1.0);
  return std::max(relative(1.5 * end.time - end.bodies[1].pose.position.x, 1.5 * 1.5 / (2.0 * 0.3 * k_g)),
                  std::abs(end.bodies[1].velocity[0] - 1.5));
}

// A smooth pusher holds a box at its speed with friction m g. (One with friction could carry a part of the weight.)
double pusher(double step_size) {
  Scene scene =
      scene_of(law(0.4), {fixed(level()), kinematic(disc(0.1), {{-k_half - 0.1, k_half}, 0.0}, {0.5, 0.0, 0.0}),
                          dynamic(square(k_side), k_mass, {{0.0, k_half}, 0.0})});
  scene.materials.push_back({"smooth", law(0.0)});
  scene.bodies[1].parts[0].material = 1;
  Simulation simulation = start(scene, step_size, 0.5);
  run_until(simulation, [](const State&, const StepReport&) { return false; });
  return std::max(relative(impulse_between(simulation.report(), 1, 2).x / step_size, 0.4 * k_mass * k_g),
                  relative(simulation.state().bodies[2].velocity[0], 0.5));
}

// A block on a wedge that is free to slide: the wedge backs away with A = N (sin - mu cos) / M, the block runs down it
// with g sin + A cos - mu N / m, N = m g cos / (1 + m / M sin (sin - mu cos)). [Beer & Johnston, Vector Mechanics]
double wedge(double friction, double step_size) {
  const double angle = radians(30.0), M = 2.0, m = 0.5;
  const double s = std::sin(angle), c = std::cos(angle);
  Scene scene;
  scene.materials = {{"smooth", law(0.0)}, {"rough", law(friction)}};
  // Drawn about its centroid: slope from its left end up to the right.
  const double length = 1.2, height = length * std::tan(angle);
  const RoundedPolygon shape{
      {{-2.0 / 3.0 * length, -height / 3.0}, {length / 3.0, -height / 3.0}, {length / 3.0, 2.0 / 3.0 * height}}};
  const Body wedge = dynamic(shape, M, {{2.0 / 3.0 * length, height / 3.0}, 0.0});
  Body block = dynamic(square(k_side), m, on_slope(angle, 0.9, k_half));
  block.parts[0].material = 1;
  scene.bodies = {fixed(level()), wedge, block};
  scene.pairs = {{0, 1, law(friction)}};
  const State end = state_after(scene, step_size, 0.3);
  const double N = m * k_g * c / (1.0 + m / M * s * (s - friction * c));
  const double A = N * (s - friction * c) / M;
  const double a = k_g * s + A * c - friction * N / m;
  return std::max(relative(end.bodies[1].velocity[0], A * end.time),
                  relative(end.bodies[2].velocity[0], (A - a * c) * end.time));
}

// A box on a board that is pulled away under it.
double pulled_board(double step_size) {
  constexpr double force = 20.0, m = 0.5, M = 1.0, mu = 0.4;
  Body board = dynamic(rectangle(4.0, 0.1), M, {{0.0, 0.05}, 0.0});
  board.wrenches = {{0.0, {force, 0.0}, 0.0}};
  const Scene scene =
      scene_of(law(mu), {fixed(level()), board, dynamic(square(k_side), m, {{0.0, 0.1 + k_half}, 0.0})});
  const State end = state_after(scene, step_size, 0.3);
  return std::max(relative(end.bodies[2].velocity[0], mu * k_g * end.time),
                  relative(end.bodies[1].velocity[0], (force - mu * m * k_g - mu * (m + M) * k_g) / M * end.time));
}

// A smooth ladder slides down from sin(a_0): it leaves the wall at sin(a) = 2/3 sin(a_0).
double ladder(double step_size) {
  const double first = radians(70.0);
  const Scene scene =
      scene_of(law(0.0), {fixed(level()), fixed(wall_on_the_left(0.0)),
                          dynamic_of_gyration(segment({-0.5, 0.0}, {0.5, 0.0}), 1.0, 1.0 / 12.0,
                                              {{0.5 * std::cos(first), 0.5 * std::sin(first)}, -first})});
  Simulation simulation = start(scene, step_size, 2.0);
  const bool has_left = run_until(
      simulation, [](const State&, const StepReport& report) { return impulse_between(report, 1, 2).x == 0.0; });
  return has_left ? relative(std::sin(-simulation.state().bodies[2].pose.angle), 2.0 / 3.0 * std::sin(first)) : 1.0;
}

// A smooth disc slides off a fixed one: it leaves at cos(a) = 2/3 cos(a_0).
double off_a_disc(double step_size) {
  const double first = radians(10.0);
  const Scene scene = disc_on_a_disc(0.0, first);
  Simulation simulation = start(scene, step_size, 3.0);
  double cosine = 0.0;  // at the last push: it may be pushed in every other step only
  run_until(simulation, [&](const State& state, const StepReport& report) {
    const Vector2 place = state.bodies[1].pose.position;
    if (has_impulse(report)) cosine = place.y / length(place);
    return false;
  });
  return relative(cosine, 2.0 / 3.0 * std::cos(first));
}

// On the way it presses the fixed disc with m g (3 cos(a) - 2 cos(a_0)).
double force_on_a_disc(double step_size) {
  const double first = radians(10.0);
  const Scene scene = disc_on_a_disc(0.0, first);
  Simulation simulation = start(scene, step_size, 3.0);
  const auto cosine = [](const State& state) {
    const Vector2 place = state.bodies[1].pose.position;
    return place.y / length(place);
  };
  run_until(simulation, [&](const State& state, const StepReport&) { return cosine(state) < std::cos(radians(40.0)); });
  return relative(length(impulse_between(simulation.report(), 0, 1)) / step_size,
                  k_g * (3.0 * cosine(simulation.state()) - 2.0 * std::cos(first)));
}

}  // namespace

std::vector<ClosedForm> slides() {
  return {
      {"square slides to rest: speed on the way", "v - mu g t", 0, k_round_off, deceleration},
      {"square slides to rest: way", "v^2 / (2 mu g)", 1, 1e-2, sliding_way},
      {"square slides to rest: time", "v / (mu g)", 1, 1e-2, sliding_time},
      {"slope of 30 deg, friction 0.3: acceleration", "g (sin - mu cos)", 0, k_round_off,
       [](double h) { return down_the_slope(30, 0.3, h); }},
      {"slope of 30 deg, smooth: acceleration", "g sin", 0, k_round_off,
       [](double h) { return down_the_slope(30, 0.0, h); }},
      {"slope of 60 deg, friction 0.9: acceleration", "g (sin - mu cos)", 0, k_round_off,
       [](double h) { return down_the_slope(60, 0.9, h); }},
      {"slope of 30 deg, friction 0.3: way", "g (sin - mu cos) t^2 / 2", 1, 1e-2, way_down_the_slope},
      {"up a slope of 20 deg: way", "v^2 / (2 g (sin + mu cos))", 1, 1e-2, way_up_the_slope},
      {"up a slope of 20 deg and back: speed", "v sqrt((sin - mu cos) / (sin + mu cos))", 1, 1e-2, speed_back},
      {"slope of 15 deg: holding force", "m g sin, m g cos", 0, k_round_off, holding_force},
      {"pulled by a rope: acceleration", "(F cos - mu (m g - F sin)) / m", 0, k_round_off, pulled_by_a_rope},
      {"pressed to a wall: acceleration", "g - mu F / m", 0, k_round_off, pressed_to_a_wall},
      {"static and kinetic friction: held, then acceleration", "g (sin - mu cos)", 0, k_round_off,
       static_and_kinetic_friction},
      {"conveyor: time of slip", "V / (mu g)", 1, 1e-2, conveyor_time},
      {"conveyor: way of slip", "V^2 / (2 mu g)", 1, 1e-2, conveyor_slip},
      {"pusher: force, speed of the box", "mu m g", 0, 1e-9, pusher},
      {"block on a smooth wedge that is free: velocities", "A = N sin / M", 0, 1e-11,
       [](double h) { return wedge(0.0, h); }},
      {"block on a rough wedge that is free: velocities", "A = N (sin - mu cos) / M", 0, 1e-11,
       [](double h) { return wedge(0.2, h); }},
      {"box on a board that is pulled away: velocities", "mu g t, (F - mu m g - mu (m + M) g) t / M", 0, k_round_off,
       pulled_board},
      {"smooth ladder: angle at which it leaves the wall", "sin a = 2/3 sin a_0", 1, 2e-2, ladder},

      {"smooth disc slides off a fixed disc: angle at which it leaves", "cos a = 2/3 cos a_0", 1, 2e-2, off_a_disc},
      {"smooth disc slides off a fixed disc: force at 40 deg", "m g (3 cos a - 2 cos a_0)", 1, 2e-2, force_on_a_disc},
  };
}

}  // namespace tumble::physics
