// Bodies that roll.
#include <algorithm>
#include <cmath>

#include "closed_form.hpp"
#include "scene_builder.hpp"

namespace tumble::physics {
namespace {

constexpr double k_radius = 0.1, k_mass = 0.3;
constexpr double k_disc = 0.5, k_hoop = 1.0, k_sphere = 0.4;  // square of gyration over square of radius

Scene round_on_slope(double gyration, double angle, double friction, Vector3 velocity) {
  return scene_of(law(friction),
                  {fixed(slope(angle)), dynamic_of_gyration(disc(k_radius), k_mass, gyration * k_radius * k_radius,
                                                            on_slope(angle, 0.0, k_radius), velocity)});
}

// It starts with v and w. Slip v + R w ends after |slip| / (mu g (1 + 1 / k)), with v - slip k / (1 + k) at the end, k
// the gyration. [disc: v / (3 mu g), 2/3 v]
double time_of_rolling(double gyration, Vector3 velocity, double step_size) {
  Simulation simulation = start(round_on_slope(gyration, 0.0, 0.3, velocity), step_size, 4.0);
  run_until(simulation, [](const State&, const StepReport& report) { return !has_slip(report); });
  const double slip = std::abs(velocity[0] + k_radius * velocity[2]);
  return relative(simulation.time(), slip / (0.3 * k_g * (1.0 + 1.0 / gyration)));
}

double speed_of_rolling(double gyration, Vector3 velocity, double step_size) {
  const State end = state_after(round_on_slope(gyration, 0.0, 0.3, velocity), step_size, 3.0);
  const double slip = velocity[0] + k_radius * velocity[2];
  const double right = velocity[0] - slip * gyration / (1.0 + gyration);
  return std::max(relative(end.bodies[1].velocity[0], right), relative(end.bodies[1].velocity[2], -right / k_radius));
}

// Without spin at the start a disc rolls after 5 v^2 / (18 mu g), with 2/3 v from v / (3 mu g) on.
double way_of_rolling(double step_size) {
  constexpr double v = 2.0, mu = 0.3;
  const State end = state_after(round_on_slope(k_disc, 0.0, mu, {v, 0.0, 0.0}), step_size, 1.0);
  const double right = 5.0 * v * v / (18.0 * mu * k_g) + 2.0 / 3.0 * v * (end.time - v / (3.0 * mu * k_g));
  return relative(end.bodies[1].pose.position.x, right);
}

double rolling_acceleration(double gyration, double step_size) {
  const double angle = radians(20.0);
  const State end = state_after(round_on_slope(gyration, angle, 0.5, {}), step_size, 1.0);
  const double right = k_g * std::sin(angle) / (1.0 + gyration) * end.time;
  const Vector3& v = end.bodies[1].velocity;
  return std::max(relative(std::hypot(v[0], v[1]), right), relative(v[2], right / k_radius));
}

// Too steep for friction 0.3: it slides and spins up.
double sliding_disc(double step_size) {
  const double angle = radians(45.0);
  const State end = state_after(round_on_slope(k_disc, angle, 0.3, {}), step_size, 1.0);
  const Vector3& v = end.bodies[1].velocity;
  return std::max(relative(std::hypot(v[0], v[1]), k_g * (std::sin(angle) - 0.3 * std::cos(angle)) * end.time),
                  relative(k_radius * v[2], 2.0 * 0.3 * k_g * std::cos(angle) * end.time));
}

// A disc on a belt of speed V rolls at V / 3 in the end.
double on_a_conveyor(double step_size) {
  Scene scene = round_on_slope(k_disc, 0.0, 0.3, {});
  scene.bodies[0].parts[0].surface_speed = 1.5;
  const State end = state_after(scene, step_size, 1.0);
  return std::max(relative(end.bodies[1].velocity[0], 0.5),
                  relative(end.bodies[1].velocity[2], 2.0 / 3.0 * 1.5 / k_radius));
}

// A plank M on two rollers m, pulled by F: the rollers go half as fast. a = F / (M + 3/4 m).
double plank_on_rollers(double step_size) {
  constexpr double M = 1.0, m = 0.4, force = 2.0;
  Body plank = dynamic(rectangle(4.0, 0.1), M, {{0.0, 2.0 * k_radius + 0.05}, 0.0});
  plank.wrenches = {{0.0, {force, 0.0}, 0.0}};
  const Scene scene = scene_of(law(0.8), {fixed(level()), plank, dynamic(disc(k_radius), m, {{-1.0, k_radius}, 0.0}),
                                          dynamic(disc(k_radius), m, {{1.0, k_radius}, 0.0})});
  const State end = state_after(scene, step_size, 0.5);
  const double right = force / (M + 0.75 * m) * end.time;
  return std::max({relative(end.bodies[1].velocity[0], right), relative(end.bodies[2].velocity[0], 0.5 * right),
                   relative(end.bodies[3].velocity[2], -0.5 * right / k_radius)});
}

// A disc r rolls off a fixed disc R: v^2 = 4/3 g (R + r) (cos a_0 - cos a).
double down_a_disc(double step_size) {
  const double first = radians(10.0), distance = 1.2;
  const Scene scene = disc_on_a_disc(2.0, first);
  Simulation simulation = start(scene, step_size, 3.0);
  const auto angle = [](const State& state) {
    return std::atan2(state.bodies[1].pose.position.x, state.bodies[1].pose.position.y);
  };
  run_until(simulation, [&](const State& state, const StepReport&) { return angle(state) >= radians(40.0); });
  const Vector3& v = simulation.state().bodies[1].velocity;
  return relative(v[0] * v[0] + v[1] * v[1],
                  4.0 / 3.0 * k_g * distance * (std::cos(first) - std::cos(angle(simulation.state()))));
}

// An ellipse on the floor, tilted by `a`: its centre is y = sqrt(a_x^2 sin^2 + a_y^2 cos^2) high, and x = y' from the
// contact along the floor.
struct EllipseOnFloor {
  double semi_axis_x, semi_axis_y;

  double height(double angle) const { return std::hypot(semi_axis_x * std::sin(angle), semi_axis_y * std::cos(angle)); }
  double offset(double angle) const {
    return (semi_axis_x * semi_axis_x - semi_axis_y * semi_axis_y) * std::sin(angle) * std::cos(angle) / height(angle);
  }
  double square_of_gyration() const { return (semi_axis_x * semi_axis_x + semi_axis_y * semi_axis_y) / 4.0; }
};
constexpr EllipseOnFloor k_ellipse = {0.2, 0.12};

Simulation rocking_ellipse(double angle, double friction, double step_size) {
  return start(scene_of(law(friction), {fixed(level()), dynamic(ellipse(k_ellipse.semi_axis_x, k_ellipse.semi_axis_y),
                                                                k_mass, {{0.0, k_ellipse.height(angle)}, angle})}),
               step_size, 3.0);
}

// Its spin as it comes through the bottom, from energy: with friction 1/2 (k^2 + r^2) w^2, r from contact to centre;
// without, the centre moves straight up and down and is at rest there.
double ellipse_spin(double friction, double step_size) {
  const double first = 0.5;
  Simulation simulation = rocking_ellipse(first, friction, step_size);
  run_until(simulation, [](const State& state, const StepReport&) { return state.bodies[1].pose.angle <= 0.0; });
  const double fall = k_ellipse.height(first) - k_ellipse.height(0.0);
  const double arm = friction > 0.0 ? k_ellipse.semi_axis_y : 0.0;
  return relative(-simulation.state().bodies[1].velocity[2],
                  std::sqrt(2.0 * k_g * fall / (k_ellipse.square_of_gyration() + arm * arm)));
}

// The time from rest at an angle to the bottom, by the energy at each angle a = a_0 cos(s):
//   t = integral of da / w, w^2 = 2 g (y(a_0) - y) / (k^2 + x^2 + y^2).
double quarter_period(double first) {
  constexpr int n = 2000;  // midpoints: the integrand is smooth and even about both ends, so this converges fast
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double s = 0.5 * k_pi * (i + 0.5) / n;
    const double angle = first * std::cos(s);
    const double x = k_ellipse.offset(angle), y = k_ellipse.height(angle);
    const double w =
        std::sqrt(2.0 * k_g * (k_ellipse.height(first) - y) / (k_ellipse.square_of_gyration() + x * x + y * y));
    sum += first * std::sin(s) / w;
  }
  return sum * 0.5 * k_pi / n;
}

double ellipse_period(double step_size) {
  const double first = 0.5;
  Simulation simulation = rocking_ellipse(first, 5.0, step_size);
  run_until(simulation, [](const State& state, const StepReport&) { return state.bodies[1].pose.angle <= 0.0; });
  return relative(simulation.time(), quarter_period(first));
}

// A wheel against a step of height s, no rebound: about its edge w' = w (1 - 2 s / (3 R)).
double wheel_meets_a_step(double step_size) {
  constexpr double R = 0.5, s = 0.1, v = 2.0;
  const double contact = std::sqrt(R * R - (R - s) * (R - s));
  const Scene scene =
      scene_of(law(3.0), {fixed(level()), fixed(rectangle(1.0, s), {{0.5 + contact + 0.05, 0.5 * s}, 0.0}),
                          dynamic(disc(R), 1.0, {{0.0, R}, 0.0}, {v, 0.0, -v / R})});
  Simulation simulation = start(scene, step_size, 0.1);
  run_until(simulation, [](const State&, const StepReport& report) { return impulse_between(report, 1, 2).y > 0.0; });
  finish_impact(simulation);
  return relative(simulation.state().bodies[2].velocity[2], -v / R * (1.0 - 2.0 * s / (3.0 * R)));
}

}  // namespace

std::vector<ClosedForm> rolls() {
  const Vector3 slide = {2.0, 0.0, 0.0}, back = {2.0, 0.0, 60.0}, spin = {0.0, 0.0, -80.0};
  const auto time = [](double gyration, Vector3 v) {
    return [=](double h) { return time_of_rolling(gyration, v, h); };
  };
  const auto speed = [](double gyration, Vector3 v) {
    return [=](double h) { return speed_of_rolling(gyration, v, h); };
  };
  const auto acceleration = [](double gyration) { return [=](double h) { return rolling_acceleration(gyration, h); }; };
  return {
      {"disc slides, then rolls: time", "v / (3 mu g)", 1, 1e-2, time(k_disc, slide)},
      {"disc slides, then rolls: way", "5 v^2 / (18 mu g) + 2/3 v (t - t_r)", 1, 1e-2, way_of_rolling},
      {"disc slides, then rolls: speed", "2/3 v", 0, k_round_off, speed(k_disc, slide)},
      {"hoop slides, then rolls: time", "v / (2 mu g)", 1, 1e-2, time(k_hoop, slide)},
      {"hoop slides, then rolls: speed", "v / 2", 0, k_round_off, speed(k_hoop, slide)},
      {"disc with backspin returns: speed", "(2 v - R w) / 3", 0, k_round_off, speed(k_disc, back)},
      {"disc spins on the spot, then rolls: time", "R w / (3 mu g)", 1, 1e-2, time(k_disc, spin)},
      {"sphere spins on the spot, then rolls: speed", "2/7 R w", 0, k_round_off, speed(k_sphere, spin)},
      {"disc rolls down 20 deg: acceleration", "2/3 g sin", 0, k_round_off, acceleration(k_disc)},
      {"hoop rolls down 20 deg: acceleration", "1/2 g sin", 0, k_round_off, acceleration(k_hoop)},
      {"sphere rolls down 20 deg: acceleration", "5/7 g sin", 0, k_round_off, acceleration(k_sphere)},
      {"disc slides down 45 deg: velocity, spin", "g (sin - mu cos) t, 2 mu g cos t / R", 0, k_round_off, sliding_disc},
      {"disc on a conveyor: speed, spin", "V / 3, 2/3 V / R", 0, k_round_off, on_a_conveyor},
      {"plank on two rollers: velocities", "F t / (M + 3/4 m)", 0, 1e-11, plank_on_rollers},
      {"disc rolls down a fixed disc: speed", "v^2 = 4/3 g (R + r) (cos a_0 - cos a)", 1, 1e-2, down_a_disc},
      {"ellipse rocks and rolls: spin at the bottom", "w^2 = 2 g (y_0 - b) / (k^2 + b^2)", 1, 1e-2,
       [](double h) { return ellipse_spin(5.0, h); }},
      {"ellipse rocks on ice: spin at the bottom", "w^2 = 2 g (y_0 - b) / k^2", 1, 1e-2,
       [](double h) { return ellipse_spin(0.0, h); }},
      {"ellipse rocks and rolls: quarter of the period", "integral of da / w", 1, 1e-2, ellipse_period},
      {"wheel meets a step: spin about its edge", "w (1 - 2 s / (3 R))", 1, 1e-2, wheel_meets_a_step},
  };
}

}  // namespace tumble::physics
