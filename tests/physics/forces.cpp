// Bodies that stand: contact impulses over the step size are the forces of statics.
#include <algorithm>
#include <cmath>

#include "closed_form.hpp"
#include "scene_builder.hpp"

namespace tumble::physics {
namespace {

StepReport report_at_rest(const Scene& scene, double step_size) {
  Simulation simulation = start(scene, step_size, 20.0 * step_size);
  run_until(simulation, [](const State&, const StepReport&) { return false; });
  return simulation.report();
}

Vector2 force_between(const StepReport& report, int body_a, int body_b, double step_size) {
  return (1.0 / step_size) * impulse_between(report, body_a, body_b);
}

// Each box carries the weight of all above.
double stack(const std::vector<double>& masses, double step_size) {
  std::vector<Body> bodies = {fixed(level())};
  for (std::size_t i = 0; i < masses.size(); ++i) {
    bodies.push_back(dynamic(square(0.25), masses[i], {{0.0, 0.125 + 0.25 * static_cast<double>(i)}, 0.0}));
  }
  const StepReport report = report_at_rest(scene_of(law(0.5), bodies), step_size);
  double largest = 0.0, weight = 0.0;
  for (std::size_t i = masses.size(); i-- > 0;) {
    weight += masses[i] * k_g;
    largest = std::max(
        largest, relative(force_between(report, static_cast<int>(i), static_cast<int>(i) + 1, step_size).y, weight));
  }
  return largest;
}

// Two boxes on each other on a slope: m g (sin, cos) of what lies above.
double stack_on_a_slope(double step_size) {
  const double angle = radians(12.0);
  const Scene scene = scene_of(law(0.5), {fixed(slope(angle)), dynamic(square(0.2), 1.0, on_slope(angle, 0.0, 0.1)),
                                          dynamic(square(0.2), 2.0, on_slope(angle, 0.0, 0.3))});
  const StepReport report = report_at_rest(scene, step_size);
  const Vector2 below = force_between(report, 0, 1, step_size), above = force_between(report, 1, 2, step_size);
  return std::max(
      {relative(below.y, 3.0 * k_g), std::abs(below.x) / k_g, relative(above.y, 2.0 * k_g), std::abs(above.x) / k_g});
}

// A plank on two supports with a load: lever rule.
double plank_with_a_load(double step_size) {
  constexpr double plank = 2.0, load = 3.0, half = 1.0, place = 0.4;
  const Scene scene = scene_of(law(0.5), {fixed(disc(0.1), {{-half, -0.1}, 0.0}), fixed(disc(0.1), {{half, -0.1}, 0.0}),
                                          dynamic(rectangle(2.4, 0.1), plank, {{0.0, 0.05}, 0.0}),
                                          dynamic(disc(0.05), load, {{place, 0.15}, 0.0})});
  const StepReport report = report_at_rest(scene, step_size);
  const double left = k_g * (0.5 * plank + load * (half - place) / (2.0 * half));
  const double right = k_g * (0.5 * plank + load * (half + place) / (2.0 * half));
  return std::max(relative(force_between(report, 0, 2, step_size).y, left),
                  relative(force_between(report, 1, 2, step_size).y, right));
}

// A smooth disc in a groove of slopes a and b: N_a = m g sin b / sin(a + b).
double groove(double step_size) {
  const double a = radians(50.0), b = radians(25.0), mass = 0.7, radius = 0.1;
  // The centre is `radius` from both sides: on their bisector through the origin.
  const double reach = radius / std::sin(0.5 * (k_pi - a - b)), middle = a + 0.5 * (k_pi - a - b);
  const Scene scene =
      scene_of(law(0.0), {fixed(slope(a)), fixed(slope(-b)),
                          dynamic(disc(radius), mass, {{reach * std::cos(middle), reach * std::sin(middle)}, 0.0})});
  const StepReport report = report_at_rest(scene, step_size);
  return std::max(relative(length(force_between(report, 0, 2, step_size)), mass * k_g * std::sin(b) / std::sin(a + b)),
                  relative(length(force_between(report, 1, 2, step_size)), mass * k_g * std::sin(a) / std::sin(a + b)));
}

// Three smooth discs between walls, one on two: the walls hold m g / (2 sqrt(3)).
double three_discs(double step_size) {
  constexpr double radius = 0.125, mass = 0.5;
  const double top = radius + std::sqrt(3.0) * radius;
  const Scene scene = scene_of(
      law(0.0), {fixed(level()), fixed(wall_on_the_left(-2.0 * radius)), fixed(wall_on_the_right(2.0 * radius)),
                 dynamic(disc(radius), mass, {{-radius, radius}, 0.0}),
                 dynamic(disc(radius), mass, {{radius, radius}, 0.0}), dynamic(disc(radius), mass, {{0.0, top}, 0.0})});
  const StepReport report = report_at_rest(scene, step_size);
  return std::max(relative(force_between(report, 1, 3, step_size).x, mass * k_g / (2.0 * std::sqrt(3.0))),
                  relative(force_between(report, 0, 4, step_size).y, 1.5 * mass * k_g));
}

// A ladder at a smooth wall presses it with m g / (2 tan a).
double ladder(double step_size) {
  const double angle = radians(65.0), mass = 2.0;
  Scene scene = scene_of(law(0.5), {fixed(level()), fixed(wall_on_the_left(0.0)),
                                    dynamic_of_gyration(segment({-0.5, 0.0}, {0.5, 0.0}), mass, 1.0 / 12.0,
                                                        {{0.5 * std::cos(angle), 0.5 * std::sin(angle)}, -angle})});
  scene.materials.push_back({"smooth", law(0.0)});
  scene.bodies[1].parts[0].material = 1;
  const StepReport report = report_at_rest(scene, step_size);
  const double right = mass * k_g / (2.0 * std::tan(angle));
  const Vector2 floor = force_between(report, 0, 2, step_size);
  return std::max({relative(force_between(report, 1, 2, step_size).x, right), relative(-floor.x, right),
                   relative(floor.y, mass * k_g)});
}

}  // namespace

std::vector<ClosedForm> forces() {
  const auto stacked = [](std::vector<double> masses) { return [=](double h) { return stack(masses, h); }; };
  const char* weight = "weight of what lies above";
  return {
      {"stack of three boxes: forces", weight, 0, k_round_off, stacked({0.3, 0.3, 0.3})},
      {"stack of ten boxes of 1 to 10 kg: forces", weight, 0, k_round_off, stacked({1, 7, 3, 10, 2, 9, 4, 8, 5, 6})},
      {"a million kg on one kg: forces", weight, 0, 1e-8, stacked({1, 1e6})},
      {"one kg on a million kg: forces", weight, 0, k_round_off, stacked({1e6, 1})},
      {"two boxes on a slope: forces", weight, 0, k_round_off, stack_on_a_slope},
      {"plank with a load: forces of the supports", "lever rule", 0, k_round_off, plank_with_a_load},
      {"smooth disc in a groove: forces", "m g sin b / sin(a + b)", 0, k_round_off, groove},
      {"three smooth discs between walls: forces", "m g / (2 sqrt 3)", 0, 1e-11, three_discs},
      {"ladder at a smooth wall: forces", "m g / (2 tan a)", 0, k_round_off, ladder},
  };
}

}  // namespace tumble::physics
