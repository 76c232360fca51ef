// Bodies that touch nothing.
#include <algorithm>
#include <cmath>

#include "closed_form.hpp"
#include "scene_builder.hpp"

namespace tumble::physics {
namespace {

// v' = -c v: v = v_0 e^(-c t).
double damped_speed(double step_size) {
  Body body = dynamic(disc(0.1), 2.0, {}, {3.0, 0.0, 0.0});
  body.linear_damping = 0.8;
  const State end = state_after(without_gravity(scene_of(law(0.0), {body})), step_size, 1.0);
  return relative(end.bodies[0].velocity[0], 3.0 * std::exp(-0.8 * end.time));
}

double damped_spin(double step_size) {
  Body body = dynamic(square(0.2), 2.0, {}, {0.0, 0.0, 7.0});
  body.angular_damping = 1.3;
  const State end = state_after(without_gravity(scene_of(law(0.0), {body})), step_size, 1.0);
  return relative(end.bodies[0].velocity[2], 7.0 * std::exp(-1.3 * end.time));
}

// v' = g - c v from rest: v = g / c (1 - e^(-c t)).
double damped_fall(double step_size) {
  Body body = dynamic(disc(0.1), 2.0, {});
  body.linear_damping = 0.8;
  const State end = state_after(scene_of(law(0.0), {body}), step_size, 1.0);
  return relative(-end.bodies[0].velocity[1], k_g / 0.8 * -std::expm1(-0.8 * end.time));
}

double terminal_speed(double step_size) {
  Body body = dynamic(disc(0.1), 2.0, {});
  body.linear_damping = 20.0;
  const State end = state_after(scene_of(law(0.0), {body}), step_size, 3.0);
  return relative(-end.bodies[0].velocity[1], k_g / 20.0);
}

double parabola(double step_size) {
  const State end =
      state_after(scene_of(law(0.0), {dynamic(square(0.2), 0.3, {{1.0, 2.0}, 0.5}, {3.0, 4.0, 5.0})}), step_size, 1.0);
  const double t = end.time;
  const BodyState& body = end.bodies[0];
  return std::max({relative(body.pose.position.x, 1.0 + 3.0 * t), relative(body.pose.angle, 0.5 + 5.0 * t),
                   std::abs(body.pose.position.y - (2.0 + 4.0 * t - 0.5 * k_g * t * t)) / 4.0,
                   std::abs(body.velocity[1] - (4.0 - k_g * t)) / k_g});
}

double constant_wrench(double step_size) {
  Body body = dynamic(square(0.3), 2.0, {});
  body.wrenches = {{0.0, {3.0, -1.0}, 0.06}};
  const double inertia = body.moment_of_inertia;
  const State end = state_after(without_gravity(scene_of(law(0.0), {body})), step_size, 1.0);
  const double t = end.time;
  const BodyState& b = end.bodies[0];
  return std::max({relative(b.velocity[0], 1.5 * t), relative(b.velocity[1], -0.5 * t),
                   relative(b.velocity[2], 0.06 / inertia * t), relative(b.pose.position.x, 0.75 * t * t),
                   relative(b.pose.angle, 0.03 / inertia * t * t)});
}

// A force from t_0 to t_1, neither on the grid: F (t_1 - t_0) = m v.
Scene pushed_for_a_while() {
  Body body = dynamic(square(0.3), 2.0, {});
  body.wrenches = {{0.1234567, {3.0, 0.0}, 0.0}, {0.4567891, {}, 0.0}};
  return without_gravity(scene_of(law(0.0), {body}));
}

double pulse_speed(double step_size) {
  const State end = state_after(pushed_for_a_while(), step_size, 1.0);
  return relative(end.bodies[0].velocity[0], 1.5 * (0.4567891 - 0.1234567));
}

double pulse_way(double step_size) {
  const State end = state_after(pushed_for_a_while(), step_size, 1.0);
  const double v = 1.5 * (0.4567891 - 0.1234567);
  return relative(end.bodies[0].pose.position.x, v * (end.time - 0.5 * (0.4567891 + 0.1234567)));
}

}  // namespace

std::vector<ClosedForm> flights() {
  return {
      {"flight of a spinning square: pose, velocity", "x = x_0 + v t + g t^2 / 2", 0, k_round_off, parabola},
      {"constant force and torque: pose, velocity", "x = F t^2 / (2 m)", 0, k_round_off, constant_wrench},
      {"force for a while, between steps: speed", "v = F (t_1 - t_0) / m", 0, k_round_off, pulse_speed},
      {"force for a while, between steps: way", "x = v (t - (t_0 + t_1) / 2)", 2, 1e-5, pulse_way},
      {"linear damping: speed", "v = v_0 e^(-c t)", 1, 1e-3, damped_speed},
      {"angular damping: spin", "w = w_0 e^(-c t)", 1, 1e-3, damped_spin},
      {"fall with damping: speed", "v = g / c (1 - e^(-c t))", 1, 1e-3, damped_fall},
      {"fall with damping: terminal speed", "v = g / c", 0, k_round_off, terminal_speed},
  };
}

}  // namespace tumble::physics
