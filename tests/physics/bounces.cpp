// Bodies that bounce.
#include <algorithm>
#include <cmath>

#include "closed_form.hpp"
#include "scene_builder.hpp"

namespace tumble::physics {
namespace {

constexpr double k_height = 1.0;  // [m] of the fall
constexpr double k_radius = 0.1;
// Each of the impacts is late by up to a step, and of those that a step resolves there are log(1 / h) or so: the error
// is h log(1 / h).
constexpr double k_order_of_many = 0.9;

Scene ball_above_floor(double restitution) {
  return scene_of(law(0.3, restitution),
                  {fixed(level()), dynamic(disc(k_radius), 0.3, {{0.0, k_radius + k_height}, 0.0})});
}

// How high a body that flies will rise, above where it would touch the floor.
double apex(const BodyState& body, double lowest) {
  return body.pose.position.y - lowest + body.velocity[1] * body.velocity[1] / (2.0 * k_g);
}

// After the first impact `height` is e^2 h, after the second e^4 h, ... [models: bounce]
double rebound_height(const Scene& scene, double lowest, double restitution, int bounces, double step_size) {
  Simulation simulation = start(scene, step_size, 10.0);
  int count = 0;
  run_until(simulation,
            [&](const State&, const StepReport& report) { return has_impulse(report) && ++count == bounces; });
  return relative(apex(simulation.state().bodies[1], lowest), k_height * std::pow(restitution, 2.0 * bounces));
}

// Impacts are sqrt(2 h / g) (1 + 2 (e + e^2 + ...)) after the start.
double impact_times(double step_size) {
  constexpr double e = 0.5;
  Simulation simulation = start(ball_above_floor(e), step_size, 3.0);
  const double first = std::sqrt(2.0 * k_height / k_g);
  double right = first, flight = 2.0 * first, largest = 0.0;
  int count = 0;
  run_until(simulation, [&](const State& state, const StepReport& report) {
    if (!has_impulse(report)) return false;
    largest = std::max(largest, relative(state.time, right));
    flight *= e;
    right += flight;
    return ++count == 5;
  });
  return count == 5 ? largest : 1.0;
}

// It comes to rest after infinitely many bounces at sqrt(2 h / g) (1 + e) / (1 - e).
double end_of_bouncing(double restitution, double step_size) {
  Simulation simulation = start(ball_above_floor(restitution), step_size, 6.0);
  double last_flight = 0.0;
  run_until(simulation, [&](const State& state, const StepReport& report) {
    if (!has_impulse(report)) last_flight = state.time;
    return false;
  });
  return relative(last_flight, std::sqrt(2.0 * k_height / k_g) * (1.0 + restitution) / (1.0 - restitution));
}

// On a slope without friction the second impact is 4 e (1 + e) h sin(a) further down.
double distance_on_slope(double step_size) {
  constexpr double e = 0.6;
  const double angle = radians(30.0);
  const Scene scene = scene_of(
      law(0.0, e),
      {fixed(slope(angle)), dynamic(disc(k_radius), 0.3, {{0.0, k_radius / std::cos(angle) + k_height}, 0.0})});
  Simulation simulation = start(scene, step_size, 3.0);
  int count = 0;
  double first = 0.0, second = 0.0;
  run_until(simulation, [&](const State& state, const StepReport& report) {
    if (!has_impulse(report)) return false;
    (count == 0 ? first : second) = dot(state.bodies[1].pose.position, up_slope(angle));
    return ++count == 2;
  });
  return relative(first - second, 4.0 * e * (1.0 + e) * k_height * std::sin(angle));
}

// A square that falls flat bounces like a ball, without a turn.
double flat_square(double step_size) {
  const Scene scene =
      scene_of(law(0.3, 0.5), {fixed(level()), dynamic(square(0.2), 0.3, {{0.0, 0.1 + k_height}, 0.0})});
  Simulation simulation = start(scene, step_size, 1.0);
  run_until(simulation, [](const State&, const StepReport& report) { return has_impulse(report); });
  const BodyState& body = simulation.state().bodies[1];
  return std::max(relative(apex(body, 0.1), 0.25 * k_height), std::abs(body.velocity[2]));
}

double flat_ellipse(double step_size) {
  const Scene scene =
      scene_of(law(0.3, 0.5), {fixed(level()), dynamic(ellipse(0.2, 0.1), 0.3, {{0.0, 0.1 + k_height}, 0.0})});
  return rebound_height(scene, 0.1, 0.5, 1, step_size);
}

// Between floor and ceiling each impact leaves the share e of the speed.
double floor_and_ceiling(double step_size) {
  const Scene scene =
      without_gravity(scene_of(law(0.3, 0.9), {fixed(level()), fixed(ceiling(1.0)),
                                               dynamic(disc(k_radius), 0.3, {{0.0, 0.5}, 0.0}, {0.0, 5.0, 0.0})}));
  Simulation simulation = start(scene, step_size, 4.0);
  int count = 0;
  run_until(simulation, [&](const State&, const StepReport& report) { return has_impulse(report) && ++count == 8; });
  return count == 8 ? relative(simulation.state().bodies[2].velocity[1], 5.0 * std::pow(0.9, 8)) : 1.0;
}

// In a corner of two walls at a right angle an elastic ball returns the way it came.
double corner(double step_size) {
  const Scene scene =
      without_gravity(scene_of(law(0.0, 1.0), {fixed(level()), fixed(wall_on_the_right(1.0)),
                                               dynamic(disc(k_radius), 0.3, {{0.0, 0.5}, 0.0}, {2.0, -1.0, 0.0})}));
  const State end = state_after(scene, step_size, 1.0);
  return std::max(relative(end.bodies[2].velocity[0], -2.0), relative(end.bodies[2].velocity[1], 1.0));
}

// Off a wall that moves with V: v' = V - e (v - V).
double moving_wall(double step_size) {
  const Scene scene =
      without_gravity(scene_of(law(0.0, 0.7), {kinematic(rectangle(0.2, 2.0), {{1.0, 0.0}, 0.0}, {-1.5, 0.0, 0.0}),
                                               dynamic(disc(k_radius), 0.3, {}, {2.0, 0.0, 0.0})}));
  const State end = state_after(scene, step_size, 0.5);
  return relative(end.bodies[1].velocity[0], -1.5 - 0.7 * (2.0 + 1.5));
}

// A small elastic ball a gap d above a large one that bounces off the floor: they meet d / (2 v) later, when both fall
// g tau slower or faster, and part as two free masses do.
double two_balls_dropped(double step_size) {
  constexpr double large = 3.0, small = 1.0, gap = 0.2;
  const Scene scene =
      scene_of(law(0.0, 1.0), {fixed(level()), dynamic(disc(k_radius), large, {{0.0, k_radius + k_height}, 0.0}),
                               dynamic(disc(k_radius), small, {{0.0, 3.0 * k_radius + k_height + gap}, 0.0})});
  Simulation simulation = start(scene, step_size, 1.0);
  run_until(simulation, [](const State&, const StepReport& report) { return impulse_between(report, 1, 2).y > 0.0; });
  const double v = std::sqrt(2.0 * k_g * k_height), tau = gap / (2.0 * v);
  const double lower = v - k_g * tau, upper = -v - k_g * tau;
  const double after = ((small - large) * upper + 2.0 * large * lower) / (small + large);
  const double place = 3.0 * k_radius + v * tau - 0.5 * k_g * tau * tau;
  return relative(apex(simulation.state().bodies[2], 3.0 * k_radius),
                  place - 3.0 * k_radius + after * after / (2.0 * k_g));
}

}  // namespace

std::vector<ClosedForm> bounces() {
  const auto ball = [](double restitution, int bounces) {
    return [=](double h) { return rebound_height(ball_above_floor(restitution), k_radius, restitution, bounces, h); };
  };
  return {
      {"ball, e = 0.5: height of the first rebound", "e^2 h", 0, k_round_off, ball(0.5, 1)},
      {"ball, e = 0.8: height of the first rebound", "e^2 h", 0, k_round_off, ball(0.8, 1)},
      {"ball, e = 0.8: height of the third rebound", "e^6 h", 0, k_round_off, ball(0.8, 3)},
      {"ball, e = 1: height of the tenth rebound", "h", 0, k_round_off, ball(1.0, 10)},
      {"ball, e = 0.5: times of five impacts", "sqrt(2 h / g) (1 + 2 e + 2 e^2 + ...)", 1, 1e-2, impact_times},
      {"ball, e = 0.5: end of bouncing", "sqrt(2 h / g) (1 + e) / (1 - e)", k_order_of_many, 1e-2,
       [](double h) { return end_of_bouncing(0.5, h); }},
      {"ball, e = 0.8: end of bouncing", "sqrt(2 h / g) (1 + e) / (1 - e)", k_order_of_many, 1e-2,
       [](double h) { return end_of_bouncing(0.8, h); }},
      {"square falls flat, e = 0.5: height, no turn", "e^2 h", 0, k_round_off, flat_square},
      {"ellipse falls flat, e = 0.5: height", "e^2 h", 0, k_round_off, flat_ellipse},
      {"ball on a slope of 30 deg, e = 0.6: way to the second impact", "4 e (1 + e) h sin a", 1, 2e-2,
       distance_on_slope},
      {"ball between floor and ceiling, e = 0.9: speed after 8 impacts", "e^8 v", 0, k_round_off, floor_and_ceiling},
      {"elastic ball in a corner: velocity", "-v", 0, k_round_off, corner},
      {"ball off a moving wall, e = 0.7: speed", "V - e (v - V)", 0, k_round_off, moving_wall},
      {"two elastic balls, dropped one above the other: height of the upper", "((m - M) u + 2 M v) / (m + M)", 1, 1e-2,
       two_balls_dropped},
  };
}

}  // namespace tumble::physics
