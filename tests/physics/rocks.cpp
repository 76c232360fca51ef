// Bodies that rock, topple and fall over.
#include <algorithm>
#include <cmath>

#include "closed_form.hpp"
#include "scene_builder.hpp"

namespace tumble::physics {
namespace {

// A block 2 b wide and 2 h high on one of its lower corners, without rebound [Housner 1963].
struct Block {
  double b, h;

  double square_of_arm() const { return b * b + h * h; }
  double gyration_about_corner() const { return 4.0 / 3.0 * square_of_arm(); }
  double slenderness() const { return std::atan(b / h); }
  // What is left of the spin when it changes its corner: 1 - 3/2 sin^2(slenderness).
  double ratio() const { return 1.0 - 1.5 * b * b / square_of_arm(); }

  // On its lower left corner at the origin, tilted to the left by `angle`, turning about it with w.
  Scene scene(double angle, double w, double friction) const {
    const Vector2 arm = {b * std::cos(angle) - h * std::sin(angle), b * std::sin(angle) + h * std::cos(angle)};
    return scene_of(law(friction), {fixed(level()), dynamic(rectangle(2.0 * b, 2.0 * h), 1.0, {arm, angle},
                                                            {-w * arm.y, w * arm.x, w})});
  }
};

bool is_flat_impact(const StepReport& report) {
  const std::vector<ContactRecord>& c = report.contacts;
  return std::any_of(c.begin(), c.end(),
                     [](const ContactRecord& r) { return r.normal_impulse > 0.0 && r.contact.point_a.x > 0.01; });
}

// Its spin were it flat: [1/s] by energy, from soon after the impact.
double spin_when_flat(Block block, const BodyState& body) {
  const double w = body.velocity[2];
  return std::sqrt(w * w + 2.0 * k_g * (body.pose.position.y - block.h) / block.gyration_about_corner());
}

// Falls back from a small tilt onto its other corner.
double spin_after_rocking(Block block, double step_size) {
  const double angle = 0.02, w = -1.0;
  const Scene scene = block.scene(angle, w, 2.0);
  Simulation simulation = start(scene, step_size, 1.0);
  run_until(simulation, [](const State&, const StepReport& report) { return is_flat_impact(report); });
  finish_impact(simulation);
  const double before = spin_when_flat(block, {scene.bodies[1].pose, scene.bodies[1].velocity});
  return relative(spin_when_flat(block, simulation.state().bodies[1]), block.ratio() * before);
}

// The impact itself, flat and without gravity: P = m w (h (1 - r), b (1 + r)) at the new corner, none at the old one.
double impulse_of_rocking(double step_size) {
  const Block block = {0.1, 0.4};
  Simulation simulation = start(without_gravity(block.scene(0.0, -1.0, 2.0)), step_size, step_size);
  simulation.advance();
  double at_old = 0.0;
  for (const ContactRecord& record : simulation.report().contacts) {
    if (record.contact.point_a.x < 0.01) at_old += record.normal_impulse;
  }
  const Vector2 impulse = impulse_between(simulation.report(), 0, 1);
  return std::max({relative(-impulse.x, block.h * (1.0 - block.ratio())),
                   relative(impulse.y, block.b * (1.0 + block.ratio())), at_old,
                   relative(-simulation.state().bodies[1].velocity[2], block.ratio())});
}

// The time from rest at a tilt to the impact, from energy at each tilt a = a_0 sin(s):
//   t = integral of da / w, 1/2 (k^2 + R^2) w^2 = g R (cos(slenderness - a_0) - cos(slenderness - a)).
double rocking_time(Block block, double first) {
  constexpr int n = 20000;
  double sum = 0.0;
  const double R = std::sqrt(block.square_of_arm()), slenderness = block.slenderness();
  for (int i = 0; i < n; ++i) {
    const double s = 0.5 * k_pi * (i + 0.5) / n;
    const double angle = first * std::sin(s);
    const double w = std::sqrt(2.0 * k_g * R * (std::cos(slenderness - first) - std::cos(slenderness - angle)) /
                               block.gyration_about_corner());
    sum += first * std::cos(s) / w;
  }
  return sum * 0.5 * k_pi / n;
}

double time_of_rocking(double share, double step_size) {
  const Block block = {0.1, 0.4};
  const double first = share * block.slenderness();
  Simulation simulation = start(block.scene(first, 0.0, 2.0), step_size, 2.0);
  run_until(simulation, [](const State&, const StepReport& report) { return is_flat_impact(report); });
  return relative(simulation.time(), rocking_time(block, first));
}

// A square falls from its corner, 5 deg off balance, onto its side: w^2 = 2 g fall / (2/3 l^2), then 1/4 of it.
double toppling_square(double step_size) {
  const Block square = {0.1, 0.1};
  const Scene scene = square.scene(radians(40.0), 0.0, 2.0);
  Simulation simulation = start(scene, step_size, 2.0);
  run_until(simulation, [](const State&, const StepReport& report) { return is_flat_impact(report); });
  finish_impact(simulation);
  const double before = spin_when_flat(square, {scene.bodies[1].pose, {}});
  return relative(spin_when_flat(square, simulation.state().bodies[1]), 0.25 * before);
}

// A rod of length 1 m on the floor, tilted from the vertical by `angle`.
Scene falling_rod(double angle, double friction) {
  return scene_of(
      law(friction),
      {fixed(level()), dynamic_of_gyration(segment({-0.5, 0.0}, {0.5, 0.0}), 1.0, 1.0 / 12.0,
                                           {{0.5 * std::sin(angle), 0.5 * std::cos(angle)}, 0.5 * k_pi - angle})});
}

double tilt(const State& state) { return 0.5 * k_pi - state.bodies[1].pose.angle; }

// On ice its centre falls straight down: w^2 = g (cos a_0 - cos a) / (1/12 + sin^2(a) / 4).
double rod_on_ice(double step_size) {
  const double first = radians(5.0);
  Simulation simulation = start(falling_rod(first, 0.0), step_size, 2.0);
  run_until(simulation, [](const State& state, const StepReport&) { return tilt(state) >= radians(85.0); });
  const double a = tilt(simulation.state());
  const double right =
      std::sqrt(k_g * (std::cos(first) - std::cos(a)) / (1.0 / 12.0 + 0.25 * std::sin(a) * std::sin(a)));
  return std::max(relative(-simulation.state().bodies[1].velocity[2], right),
                  std::abs(simulation.state().bodies[1].velocity[0]));
}

// With friction 0.6 its foot stays where it is: w^2 = 3 g (cos a_0 - cos a) / L.
double rod_about_its_foot(double step_size) {
  const double first = radians(5.0);
  Simulation simulation = start(falling_rod(first, 0.6), step_size, 2.0);
  run_until(simulation, [](const State& state, const StepReport&) { return tilt(state) >= radians(45.0); });
  const double right = std::sqrt(3.0 * k_g * (std::cos(first) - std::cos(tilt(simulation.state()))));
  return relative(-simulation.state().bodies[1].velocity[2], right);
}

// A block that slides against a stop of height s tips about its edge: w = v (h - s) / (k^2 + b^2 + (h - s)^2).
double tips_over_a_stop(double step_size) {
  constexpr double b = 0.1, h = 0.2, s = 0.05, v = 1.0;
  const Scene scene =
      without_gravity(scene_of(law(0.0), {fixed(level()), fixed(rectangle(0.2, s), {{0.2 + b, 0.5 * s}, 0.0}),
                                          dynamic(rectangle(2.0 * b, 2.0 * h), 1.0, {{0.0, h}, 0.0}, {v, 0.0, 0.0})}));
  Simulation simulation = start(scene, step_size, 1.0);
  run_until(simulation, [](const State&, const StepReport& report) { return impulse_between(report, 1, 2).x < 0.0; });
  finish_impact(simulation);
  const double arm = h - s;
  return relative(-simulation.state().bodies[2].velocity[2], v * arm / ((b * b + h * h) / 3.0 + b * b + arm * arm));
}

}  // namespace

std::vector<ClosedForm> rocks() {
  const auto spin = [](double b, double h) { return [=](double step) { return spin_after_rocking({b, h}, step); }; };
  const auto time = [](double share) { return [=](double step) { return time_of_rocking(share, step); }; };
  return {
      {"block 1 : 4 changes its corner: spin", "w (1 - 3/2 sin^2) [Housner 1963]", 1, 2e-2, spin(0.1, 0.4)},
      {"block 1 : 2 changes its corner: spin", "w (1 - 3/2 sin^2) [Housner 1963]", 1, 2e-2, spin(0.2, 0.4)},
      {"square changes its corner: spin", "w / 4 [Housner 1963]", 1, 0.1, spin(0.2, 0.2)},
      {"block 1 : 4 changes its corner: impulse, spin", "m w (h (1 - r), b (1 + r))", 1, 1e-2, impulse_of_rocking},
      {"block rocks from 1/4 of its slenderness: time", "integral of da / w", 1, 1e-2, time(0.25)},
      {"block rocks from 1/2 of its slenderness: time", "integral of da / w", 1, 1e-2, time(0.5)},
      {"block rocks from 3/4 of its slenderness: time", "integral of da / w", 1, 1e-2, time(0.75)},
      {"square topples onto its side: spin", "sqrt(2 g fall / (2/3 l^2)) / 4", 1, 3e-2, toppling_square},
      {"rod falls over on ice: spin", "w^2 = g (cos a_0 - cos a) / (1/12 + sin^2(a) / 4)", 1, 1e-2, rod_on_ice},
      {"rod falls over about its foot: spin", "w^2 = 3 g (cos a_0 - cos a) / L", 1, 1e-2, rod_about_its_foot},
      {"block slides against a stop: spin", "v (h - s) / (k^2 + b^2 + (h - s)^2)", 1, 1e-2, tips_over_a_stop},
  };
}

}  // namespace tumble::physics
