// Where friction gives way and where bodies tip over: the threshold of the simulation, found by bisection.
#include <algorithm>
#include <cmath>

#include "closed_form.hpp"
#include "scene_builder.hpp"

namespace tumble::physics {
namespace {

constexpr int k_num_steps = 20;
constexpr double k_accepted = 1e-6;  // [-]

// Between 0.8 and 1.25 of the right value: relative error of the value above which `holds` is true, or below which.
template <class Holds>
double threshold_error(double right, Holds holds) {
  double low = 0.8 * right, high = 1.25 * right;
  const bool holds_high = holds(high);
  if (holds(low) == holds_high) return 1.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (holds(middle) == holds_high ? high : low) = middle;
  }
  return relative(0.5 * (low + high), right);
}

// No contact slips in the first steps.
bool sticks(const Scene& scene, double step_size) {
  Simulation simulation = start(scene, step_size, k_num_steps * step_size);
  return !run_until(simulation, [](const State&, const StepReport& report) { return has_slip(report); });
}

// The last body does not turn in the first steps.
bool stays_upright(const Scene& scene, double step_size) {
  Simulation simulation = start(scene, step_size, k_num_steps * step_size);
  // Round-off turns it by 1e-16 rad / step_size per step or so; a millionth of weight at its corner by 1e-6 rad/s and
  // more.
  return !run_until(simulation, [](const State& state, const StepReport&) {
    return std::abs(state.bodies.back().velocity[2]) > 1e-9;
  });
}

double square_on_slope(double degrees, double step_size) {
  const double angle = radians(degrees);
  return threshold_error(std::tan(angle), [&](double friction) {
    return sticks(scene_of(law(friction), {fixed(slope(angle)), dynamic(square(0.2), 0.3, on_slope(angle, 0.0, 0.1))}),
                  step_size);
  });
}

// Rolls without slip for friction above tan(a) / (1 + R^2 / k^2).
double round_on_slope(double gyration, double step_size) {
  const double angle = radians(20.0), radius = 0.1;
  return threshold_error(std::tan(angle) / (1.0 + 1.0 / gyration), [&](double friction) {
    return sticks(
        scene_of(law(friction), {fixed(slope(angle)), dynamic_of_gyration(disc(radius), 0.3, gyration * radius * radius,
                                                                          on_slope(angle, 0.0, radius))}),
        step_size);
  });
}

double tipping_on_slope(double step_size) {
  return threshold_error(0.2 / 0.4, [&](double tangent) {
    const double angle = std::atan(tangent);
    return stays_upright(
        scene_of(law(2.0), {fixed(slope(angle)), dynamic(rectangle(0.2, 0.4), 0.3, on_slope(angle, 0.0, 0.2))}),
        step_size);
  });
}

Body pushed(Body body, double force, double above_centre) {
  body.wrenches = {{0.0, {force, 0.0}, -force * above_centre}};
  return body;
}

double force_to_slide(ContactLaw contact_law, double step_size) {
  return threshold_error(contact_law.static_friction * 0.3 * k_g, [&](double force) {
    return sticks(
        scene_of(contact_law, {fixed(level()), pushed(dynamic(square(0.2), 0.3, {{0.0, 0.1}, 0.0}), force, 0.0)}),
        step_size);
  });
}

// Pushed slowly at a height of more than b / (2 friction) it tips instead of sliding.
double height_to_tip(double step_size) {
  constexpr double b = 0.2, h = 0.8, friction = 0.3, mass = 0.3;
  return threshold_error(b / (2.0 * friction), [&](double height) {
    const double force = friction * mass * k_g;  // that of sliding
    return stays_upright(
        scene_of(law(friction), {fixed(level()), pushed(dynamic(rectangle(b, h), mass, {{0.0, 0.5 * h}, 0.0}), force,
                                                        height - 0.5 * h)}),
        step_size);
  });
}

// Pushed fast it slides, and tips if pushed above h / 2 + (b - friction h) m g / (2 F).
double height_to_tip_while_sliding(double step_size) {
  constexpr double b = 0.2, h = 0.5, friction = 0.3, mass = 0.3, force = 1.5;
  return threshold_error(0.5 * h + (b - friction * h) * mass * k_g / (2.0 * force), [&](double height) {
    return stays_upright(
        scene_of(law(friction), {fixed(level()), pushed(dynamic(rectangle(b, h), mass, {{0.0, 0.5 * h}, 0.0}), force,
                                                        height - 0.5 * h)}),
        step_size);
  });
}

double overhang(double step_size) {
  return threshold_error(0.5, [&](double out) {
    return stays_upright(scene_of(law(0.5), {fixed(rectangle(1.0, 0.2), {{-0.5, -0.1}, 0.0}),
                                             dynamic(rectangle(1.0, 0.2), 1.0, {{out - 0.5, 0.1}, 0.0})}),
                         step_size);
  });
}

Scene ladder(double angle, ContactLaw floor, ContactLaw wall) {
  Scene scene = scene_of(floor, {fixed(level()), fixed(wall_on_the_left(0.0)),
                                 dynamic_of_gyration(segment({-0.5, 0.0}, {0.5, 0.0}), 2.0, 1.0 / 12.0,
                                                     {{0.5 * std::cos(angle), 0.5 * std::sin(angle)}, -angle})});
  scene.materials.push_back({"wall", wall});
  scene.bodies[1].parts[0].material = 1;
  scene.pairs = {{0, 1, wall}};
  return scene;
}

double ladder_at_smooth_wall(double step_size) {
  const double angle = radians(60.0);
  return threshold_error(1.0 / (2.0 * std::tan(angle)),
                         [&](double friction) { return sticks(ladder(angle, law(friction), law(0.0)), step_size); });
}

// Both ends slip: tan(a) = (1 - mu^2) / (2 mu), mu = tan(45 deg - a / 2).
double ladder_at_rough_wall(double step_size) {
  const double angle = radians(60.0);
  return threshold_error(std::tan(radians(45.0) - 0.5 * angle), [&](double friction) {
    return sticks(ladder(angle, law(friction), law(friction)), step_size);
  });
}

double pressed_to_a_wall(double step_size) {
  return threshold_error(0.3 * k_g / 0.5, [&](double force) {
    return sticks(
        scene_of(law(0.5), {fixed(wall_on_the_right(0.1)), pushed(dynamic(square(0.2), 0.3, {}), force, 0.0)}),
        step_size);
  });
}

// A board is pulled out from under a box by more than (mu_box + mu_floor) (m + M) g.
double board_under_a_box(double step_size) {
  constexpr double m = 0.5, M = 1.0, g = k_g;
  return threshold_error((0.4 + 0.2) * (m + M) * g, [&](double force) {
    Scene scene =
        scene_of(law(0.2), {fixed(level()), pushed(dynamic(rectangle(2.0, 0.1), M, {{0.0, 0.05}, 0.0}), force, 0.0),
                            dynamic(square(0.2), m, {{0.0, 0.2}, 0.0})});
    scene.materials.push_back({"box", law(0.4)});
    scene.bodies[2].parts[0].material = 1;
    scene.pairs = {{0, 1, law(0.4)}};
    Simulation simulation = start(scene, step_size, k_num_steps * step_size);
    return !run_until(simulation, [](const State& state, const StepReport&) {
      return std::abs(state.bodies[1].velocity[0] - state.bodies[2].velocity[0]) > 1e-12;
    });
  });
}

// The friction that a block needs at its new corner when it rocks: h (1 - r) / (b (1 + r)) [Housner's ratio r].
double rocking_block(double step_size) {
  constexpr double b = 0.1, h = 0.4;
  const double r = 1.0 - 1.5 * b * b / (b * b + h * h);
  return threshold_error(h * (1.0 - r) / (b * (1.0 + r)), [&](double friction) {
    const Scene scene = without_gravity(scene_of(
        law(friction), {fixed(level()), dynamic(rectangle(2.0 * b, 2.0 * h), 1.0, {{b, h}, 0.0}, {h, -b, -1.0})}));
    Simulation simulation = start(scene, step_size, step_size);
    simulation.advance();
    return !has_slip(simulation.report());
  });
}

bool sticks_at_impact(const Scene& scene, double step_size) {
  Simulation simulation = start(scene, step_size, 1.0);
  run_until(simulation, [](const State&, const StepReport& report) { return has_impulse(report); });
  return !has_slip(simulation.report());
}

// An oblique disc grips for friction above v_t / (3 (1 + e) v_n).
double oblique_disc(double step_size) {
  return threshold_error(1.0 / (3.0 * 1.5 * 2.0), [&](double friction) {
    return sticks_at_impact(
        without_gravity(scene_of(law(friction, 0.5),
                                 {fixed(level()), dynamic(disc(0.1), 0.3, {{0.0, 0.15}, 0.0}, {1.0, -2.0, 0.0})})),
        step_size);
  });
}

// A square of any size at an angle falls straight on its corner: it slips back for friction below |B_nt| / B_tt.
double corner(double step_size) {
  const double angle = radians(30.0);
  const double right = 1.5 * std::cos(2.0 * angle) / (1.0 + 1.5 * (1.0 + std::sin(2.0 * angle)));
  return threshold_error(right, [&](double friction) {
    const double height = 0.1 * (std::sin(angle) + std::cos(angle)) + 0.05;
    return sticks_at_impact(
        without_gravity(scene_of(
            law(friction, 0.5), {fixed(level()), dynamic(square(0.2), 0.3, {{0.0, height}, angle}, {0.0, -2.0, 0.0})})),
        step_size);
  });
}

// A table tilts with w about the place of the box: at the angle where g sin(a) = friction (g cos(a) - w^2 h), h the
// height of its centre above the table, it slips.
double tilting_table(double step_size) {
  constexpr double friction = 0.3, w = 0.5, h = 0.1;
  const Scene scene = scene_of(law(friction), {kinematic(rectangle(2.0, 0.2), {{0.0, -0.1}, 0.0}, {}),
                                               dynamic(square(2.0 * h), 0.3, {{0.0, h}, 0.0})});
  Scene turning = scene;
  turning.bodies[0].parts[0].shape = moved(rectangle(2.0, 0.2), {{0.0, -0.1}, 0.0});
  turning.bodies[0].pose = {};
  turning.bodies[0].velocity = {0.0, 0.0, w};
  turning.bodies[1].velocity = {-w * h, 0.0, w};
  Simulation simulation = start(turning, step_size, 2.0);
  run_until(simulation, [](const State&, const StepReport& report) { return has_slip(report); });
  // sin(a) = friction (cos(a) - q), q = w^2 h / g.
  const double q = w * w * h / k_g, phi = std::atan(friction);
  const double right = phi - std::asin(q * std::sin(phi));
  return relative(simulation.state().bodies[0].pose.angle, right);
}

}  // namespace

std::vector<ClosedForm> thresholds() {
  const auto slope_of = [](double degrees) { return [=](double h) { return square_on_slope(degrees, h); }; };
  const auto rolls_on = [](double gyration) { return [=](double h) { return round_on_slope(gyration, h); }; };
  return {
      {"square on a slope of 17 deg sticks: friction", "tan a", 0, k_accepted, slope_of(17)},
      {"square on a slope of 40 deg sticks: friction", "tan a", 0, k_accepted, slope_of(40)},
      {"disc on a slope grips: friction", "tan(a) / 3", 0, k_accepted, rolls_on(0.5)},
      {"hoop on a slope grips: friction", "tan(a) / 2", 0, k_accepted, rolls_on(1.0)},
      {"box on a slope tips: tangent of the angle", "b / h", 0, k_accepted, tipping_on_slope},
      {"box slides: force", "mu m g", 0, k_accepted, [](double h) { return force_to_slide(law(0.3), h); }},
      {"box slides, static friction: force", "mu_s m g", 0, k_accepted,
       [](double h) { return force_to_slide(static_and_kinetic(0.4, 0.3), h); }},
      {"box tips before it slides: height of the push", "b / (2 mu)", 0, k_accepted, height_to_tip},
      {"box tips while it slides: height of the push", "h / 2 + (b - mu h) m g / (2 F)", 0, k_accepted,
       height_to_tip_while_sliding},
      {"plank tips over an edge: overhang", "b / 2", 0, k_accepted, overhang},
      {"ladder at a smooth wall holds: friction", "1 / (2 tan a)", 0, k_accepted, ladder_at_smooth_wall},
      {"ladder at a rough wall holds: friction", "tan(45 deg - a / 2)", 0, k_accepted, ladder_at_rough_wall},
      {"box pressed to a wall holds: force", "m g / mu", 0, k_accepted, pressed_to_a_wall},
      {"board slips from under a box: force", "(mu_1 + mu_2) (m + M) g", 0, k_accepted, board_under_a_box},
      {"rocking block grips at its new corner: friction", "h (1 - r) / (b (1 + r))", 0, k_accepted, rocking_block},
      {"oblique disc grips: friction", "v_t / (3 (1 + e) v_n)", 0, k_accepted, oblique_disc},
      {"square on its corner grips: friction", "abs(B_nt) / B_tt", 0, k_accepted, corner},
      {"box on a tilting table slips: angle", "sin a = mu (cos a - w^2 h / g)", 1, 1e-2, tilting_table},
  };
}

}  // namespace tumble::physics
