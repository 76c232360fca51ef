// Single impacts. Where there is no gravity they are exact at every step size.
#include <algorithm>
#include <cmath>

#include "closed_form.hpp"
#include "scene_builder.hpp"

namespace tumble::physics {
namespace {

double distance(const Vector3& a, const Vector3& b) {
  double sum = 0.0;
  for (std::size_t j = 0; j < 3; ++j) sum += (a[j] - b[j]) * (a[j] - b[j]);
  return std::sqrt(sum);
}

double relative_distance(const Vector3& value, const Vector3& right) {
  return distance(value, right) / distance(right, {});
}

// The velocity of body 1 after its first impact with the floor.
Vector3 velocity_after_impact(const Scene& scene, double step_size) {
  Simulation simulation = start(scene, step_size, 1.0);
  run_until(simulation, [](const State&, const StepReport& report) { return has_impulse(report); });
  return simulation.state().bodies[1].velocity;
}

// A body that hits the floor with one corner, in numbers that are rounded to 8 digits behind the point: Newton's law in
// one LCP. From independent computations with the inverse inertia at the contact.
struct CornerImpact {
  const char* name;
  double degrees;
  Vector3 before;
  double friction, restitution;
  Vector3 after;
};
constexpr double k_digits = 1e-8;

// A square of side 0.2 m, turned by `degrees` from flat.
constexpr CornerImpact k_squares[] = {
    {"square at 20 deg, falls straight: slips back", 20, {0, -2, 0}, 0.3, 0.5, {0.75560496, 0.51868320, -8.05318660}},
    {"square at 20 deg, fast to the right: sticks", 20, {3, -2, 0}, 0.3, 0.5, {2.70993606, -0.26366394, -21.14308397}},
    {"square at 20 deg, to the left: slips", 20, {-1, -2, 0}, 0.3, 0.5, {-0.24439504, 0.51868320, -8.05318660}},
    {"square at 30 deg, to the right: sticks", 30, {0.2, -2, 0}, 0.5, 0.5, {0.70245191, 0.81177858, -5.14230485}},
    {"square at 30 deg, to the left: sticks", 30, {-0.5, -2, 0}, 0.5, 0.5, {0.21262024, 0.94302858, -1.55648816}},
    {"square on its corner, falls straight: rises straight", 45, {0, -2, 0}, 0.3, 0.5, {0, 1, 0}},
    {"square on its corner, to the right: sticks", 45, {1, -2, 0}, 0.3, 0.5, {0.75, 1, -5.30330086}},
};

// A uniform rod of length 1 m at `degrees` from the floor; its lower end, on the left, hits.
constexpr CornerImpact k_rods[] = {
    {"rod at 45 deg, friction 0.5: slips", 45, {0, -1, 0}, 0.5, 0.5, {0.42857143, -0.14285714, -1.81827458}},
    {"rod at 45 deg, friction 0.7: sticks", 45, {0, -1, 0}, 0.7, 0.5, {0.5625, -0.0625, -1.59099026}},
    {"rod at 30 deg, friction 0.5: slips", 30, {0, -1, 0}, 0.5, 0.5, {0.28840819, -0.42318362, -2.13200125}},
    {"rod at 60 deg, friction 0.5: sticks", 60, {0, -1, 0}, 0.5, 0.5, {0.48713929, 0.21875, -1.125}},
};

double square_impact(const CornerImpact& impact, double step_size) {
  const double t = radians(impact.degrees);
  const double height = 0.1 * (std::sin(t) + std::cos(t));
  const Scene scene = without_gravity(
      scene_of(law(impact.friction, impact.restitution),
               {fixed(level()), dynamic(square(0.2), 0.3, {{0.0, height + 0.0456789}, t}, impact.before)}));
  return relative_distance(velocity_after_impact(scene, step_size), impact.after);
}

Body rod(Pose pose, Vector3 velocity) {
  return dynamic_of_gyration(segment({-0.5, 0.0}, {0.5, 0.0}), 1.0, 1.0 / 12.0, pose, velocity);
}

double rod_impact(const CornerImpact& impact, double step_size) {
  const double t = radians(impact.degrees);
  const Scene scene =
      without_gravity(scene_of(law(impact.friction, impact.restitution),
                               {fixed(level()), rod({{0.0, 0.5 * std::sin(t) + 0.0456789}, t}, impact.before)}));
  return relative_distance(velocity_after_impact(scene, step_size), impact.after);
}

// A level rod that hits a peg at d from its centre: P = (1 + e) v / (1 / m + d^2 / I).
double flat_rod(double step_size) {
  constexpr double d = 0.45, e = 0.5;
  const Scene scene = without_gravity(
      scene_of(law(0.4, e), {fixed(disc(0.1), {{-d, -0.1}, 0.0}), rod({{0.0, 0.0456789}, 0.0}, {0.0, -1.0, 0.0})}));
  const double P = (1.0 + e) / (1.0 + 12.0 * d * d);
  return relative_distance(velocity_after_impact(scene, step_size), {0.0, -1.0 + P, -12.0 * d * P});
}

// Newton's law with friction can create energy: by this share [models: E1, E2]; a step that does says so.
double created_energy(double degrees, Vector3 before, double friction, double restitution, double ratio,
                      double step_size) {
  const double t = radians(degrees);
  const Scene scene = without_gravity(
      scene_of(law(friction, restitution), {fixed(level()), rod({{0.0, 0.5 * std::sin(t)}, t}, before)}));
  Simulation simulation = start(scene, step_size, 1.0);
  const double kinetic = energies(scene, simulation.state()).kinetic;
  run_until(simulation, [](const State&, const StepReport& report) { return has_impulse(report); });
  const EnergyLedger& energy = simulation.report().energy;
  return std::max(relative(energy.kinetic / kinetic, ratio), relative(energy.created, energy.kinetic - kinetic));
}

// A disc, hoop or sphere (square of gyration over square of radius) hits the floor with v and spin w. Its slip v_t + R
// w is stopped by P_t = -m slip / (1 + R^2 / k^2), if that is within friction times (1 + e) m v_n.
double oblique(double gyration, Vector3 before, double friction, double restitution, bool sticks, double step_size) {
  constexpr double radius = 0.1, mass = 0.3;
  const double square_of_gyration = gyration * radius * radius;
  const Scene scene = without_gravity(scene_of(
      law(friction, restitution), {fixed(level()), dynamic_of_gyration(disc(radius), mass, square_of_gyration,
                                                                       {{0.0, radius + 0.0456789}, 0.0}, before)}));
  const double slip = before[0] + radius * before[2];
  const double normal_impulse = -(1.0 + restitution) * mass * before[1];
  const double stopping = -mass * slip / (1.0 + 1.0 / gyration);
  const double impulse = sticks ? stopping : std::copysign(friction * normal_impulse, -slip);
  if (sticks != (std::abs(stopping) <= friction * normal_impulse)) return 1.0;
  const Vector3 after = {before[0] + impulse / mass, -restitution * before[1],
                         before[2] + impulse * radius / (mass * square_of_gyration)};
  return relative_distance(velocity_after_impact(scene, step_size), after);
}

// A disc that spins is dropped: it gets the speed friction (1 + e) sqrt(2 g h) along the floor.
double dropped_with_spin(double step_size) {
  const Scene scene =
      scene_of(law(0.3, 0.5), {fixed(level()), dynamic(disc(0.1), 0.3, {{0.0, 1.1}, 0.0}, {0.0, 0.0, -200.0})});
  return relative(velocity_after_impact(scene, step_size)[0], 0.3 * 1.5 * std::sqrt(2.0 * k_g));
}

// Two bodies, of which the first hits the second: velocities after.
std::array<Vector3, 2> after_collision(const Scene& scene, double step_size) {
  Simulation simulation = start(without_gravity(scene), step_size, 1.0);
  run_until(simulation, [](const State&, const StepReport& report) { return has_impulse(report); });
  return {simulation.state().bodies[0].velocity, simulation.state().bodies[1].velocity};
}

double central_collision(double step_size) {
  const Scene scene = scene_of(
      law(0.3, 0.5), {dynamic(disc(0.1), 1.0, {}, {1.0, 0.0, 0.0}), dynamic(disc(0.15), 2.0, {{0.3, 0.0}, 0.0})});
  const auto [a, b] = after_collision(scene, step_size);
  return std::max(distance(a, {}), distance(b, {0.5, 0.0, 0.0}));
}

// Two discs that meet along x, spin and slip: slip is stopped by 1/3 of its speed times the reduced mass, if friction
// lets it; u_t = v_b - v_a across the line of centres - (R_a w_a + R_b w_b).
double discs_with_spin(double friction, bool sticks, double step_size) {
  constexpr double m_a = 1.0, m_b = 2.0, r_a = 0.1, r_b = 0.15, e = 0.5;
  const Vector3 v_a = {1.0, 0.4, 3.0}, v_b = {-0.5, -0.2, 8.0};
  // From where they fly together until their line of centres is the x-axis.
  constexpr double time = 0.0456789;
  const Scene scene =
      scene_of(law(friction, e), {dynamic(disc(r_a), m_a, {{-v_a[0] * time, -v_a[1] * time}, 0.0}, v_a),
                                  dynamic(disc(r_b), m_b, {{r_a + r_b - v_b[0] * time, -v_b[1] * time}, 0.0}, v_b)});
  const double reduced = 1.0 / (1.0 / m_a + 1.0 / m_b);
  const double normal = (1.0 + e) * reduced * (v_a[0] - v_b[0]);  // on b, along x
  const double slip = v_b[1] - v_a[1] - (r_a * v_a[2] + r_b * v_b[2]);
  const double tangential = sticks ? -reduced * slip / 3.0 : std::copysign(friction * normal, -slip);  // on b, along y
  if (sticks != (std::abs(reduced * slip / 3.0) <= friction * normal)) return 1.0;
  const Vector3 right_a = {v_a[0] - normal / m_a, v_a[1] - tangential / m_a, v_a[2] - 2.0 * tangential / (m_a * r_a)};
  const Vector3 right_b = {v_b[0] + normal / m_b, v_b[1] + tangential / m_b, v_b[2] - 2.0 * tangential / (m_b * r_b)};
  const auto [a, b] = after_collision(scene, step_size);
  return std::max(relative_distance(a, right_a), relative_distance(b, right_b));
}

// A disc hits a box off its centre, without friction: J = (1 + e) v / (1 / m + 1 / M + d^2 / I).
double off_centre(double step_size) {
  constexpr double d = 0.12;
  const Scene scene = scene_of(law(0.0, 0.6), {dynamic(disc(0.1), 1.0, {{-0.3, d}, 0.0}, {2.0, 0.0, 0.0}),
                                               dynamic(rectangle(0.2, 0.4), 1.5, {})});
  const double inertia = scene.bodies[1].moment_of_inertia;
  const double J = 1.6 * 2.0 / (1.0 / 1.0 + 1.0 / 1.5 + d * d / inertia);
  const auto [a, b] = after_collision(scene, step_size);
  return std::max(distance(a, {2.0 - J, 0.0, 0.0}), relative_distance(b, {J / 1.5, 0.0, -d * J / inertia}));
}

// Equal elastic discs without friction part at a right angle.
double billiard(double step_size) {
  const Scene scene = scene_of(
      law(0.0, 1.0), {dynamic(disc(0.1), 1.0, {{-0.5, 0.1}, 0.0}, {2.0, 0.0, 0.0}), dynamic(disc(0.1), 1.0, {})});
  const auto [a, b] = after_collision(scene, step_size);
  return std::abs(a[0] * b[0] + a[1] * b[1]) / (std::hypot(a[0], a[1]) * std::hypot(b[0], b[1]));
}

Scene balls_in_a_row(int count, double gap) {
  std::vector<Body> balls;
  for (int i = 0; i < count; ++i) {
    balls.push_back(dynamic(disc(0.125), 1.0, {{i * (0.25 + gap) - (i == 0 ? 0.1 : 0.0), 0.0}, 0.0},
                            {i == 0 ? 1.0 : 0.0, 0.0, 0.0}));
  }
  return without_gravity(scene_of(law(0.0, 1.0), balls));
}

// Balls with gaps between them hand the motion on to the last one.
double cradle_with_gaps(double step_size) {
  const State end = state_after(balls_in_a_row(5, 0.03), step_size, 1.0);
  double largest = std::abs(end.bodies[4].velocity[0] - 1.0);
  for (std::size_t i = 0; i < 4; ++i) largest = std::max(largest, std::abs(end.bodies[i].velocity[0]));
  return largest;
}

// Three balls, two of which touch: Newton's law for both contacts at once gives (-1/3, 2/3, 2/3). Energy and momentum
// allow others.
double cradle_that_touches(double step_size) {
  const State end = state_after(balls_in_a_row(3, 0.0), step_size, 1.0);
  return std::max({std::abs(end.bodies[0].velocity[0] + 1.0 / 3.0), std::abs(end.bodies[1].velocity[0] - 2.0 / 3.0),
                   std::abs(end.bodies[2].velocity[0] - 2.0 / 3.0)});
}

// Painleve's rod: friction 1.5, tan(angle) = 2, sliding left at 1 m/s. No finite force; for small steps an impact
// without collision, P = (0.4, 0.3) N s.
double painleve(double step_size) {
  const double t = std::atan(2.0);
  const Scene scene =
      scene_of(law(1.5), {fixed(level()), rod({{0.5 * std::cos(t), 0.5 * std::sin(t)}, t}, {-1.0, 0.0, 0.0})});
  return relative_distance(velocity_after_impact(scene, step_size), {-0.6, 0.3, 1.34164079});
}

// The same rod with friction 1.2 slides with the normal force m g / (1 + 3 cos^2 - 3 friction sin cos).
double below_painleve(double step_size) {
  const double t = std::atan(2.0), friction = 1.2;
  const Scene scene =
      scene_of(law(friction), {fixed(level()), rod({{0.5 * std::cos(t), 0.5 * std::sin(t)}, t}, {-1.0, 0.0, 0.0})});
  Simulation simulation = start(scene, step_size, 1.0);
  run_until(simulation, [](const State&, const StepReport& report) { return has_impulse(report); });
  const double force = impulse_between(simulation.report(), 0, 1).y / step_size;
  return relative(force, k_g / (1.0 + 3.0 * std::cos(t) * std::cos(t) - 3.0 * friction * std::sin(t) * std::cos(t)));
}

}  // namespace

std::vector<ClosedForm> impacts() {
  std::vector<ClosedForm> all;
  const char* one_lcp = "one LCP with Newton's law";
  for (const CornerImpact& impact : k_squares) {
    all.push_back({impact.name, one_lcp, 0, k_digits, [&](double h) { return square_impact(impact, h); }});
  }
  for (const CornerImpact& impact : k_rods) {
    all.push_back({impact.name, one_lcp, 0, k_digits, [&](double h) { return rod_impact(impact, h); }});
  }
  const auto disc_case = [&](const char* name, double gyration, Vector3 before, double friction, double restitution,
                             bool sticks) {
    all.push_back({name, sticks ? "P_t = -m slip / (1 + R^2 / k^2)" : "P_t = friction (1 + e) m v_n", 0, k_round_off,
                   [=](double h) { return oblique(gyration, before, friction, restitution, sticks, h); }});
  };
  disc_case("disc, oblique: grips", 0.5, {1, -2, 0}, 0.3, 0.5, true);
  disc_case("disc, oblique and fast: slides", 0.5, {5, -2, 0}, 0.3, 0.5, false);
  disc_case("disc with backspin: grips and returns", 0.5, {0.5, -2, 20}, 0.5, 0.5, true);
  disc_case("disc with much topspin: slides and gains speed", 0.5, {1, -2, -200}, 0.3, 0.5, false);
  disc_case("hoop, oblique: grips", 1.0, {1, -2, 0}, 0.3, 0.5, true);
  disc_case("hoop with spin: slides", 1.0, {1, -2, 90}, 0.2, 0.8, false);
  // A solid sphere as in the experiments of Kharaz et al. 2001: friction 0.092, e = 0.98, 3.9 m/s.
  const double speed = 3.9;
  disc_case("sphere at 60 deg: slides", 0.4, {speed * std::sin(radians(60)), -speed * std::cos(radians(60)), 0}, 0.092,
            0.98, false);
  disc_case("sphere at 20 deg: grips", 0.4, {speed * std::sin(radians(20)), -speed * std::cos(radians(20)), 0}, 0.092,
            0.98, true);
  const std::vector<ClosedForm> others = {
      {"level rod hits a peg", "P = (1 + e) v / (1 / m + d^2 / I)", 0, k_round_off, flat_rod},
      {"rod gains energy under Newton's law, e = 1", "K / K_0 = 1.183466", 0, 1e-6,
       [](double h) {
         return created_energy(50, {0.5, -1, 0}, 0.5, 1.0, 1.183466, h);
       }},
      {"rod with spin gains energy, e = 0.9", "K / K_0 = 1.265086", 0, 1e-6,
       [](double h) {
         return created_energy(45, {0, -1, 4}, 0.5, 0.9, 1.265086, h);
       }},
      {"disc dropped with spin: speed along the floor", "friction (1 + e) sqrt(2 g h)", 1, 1e-2, dropped_with_spin},
      {"discs of 1 and 2 kg, central, e = 0.5", "J = (1 + e) v / (1 / m + 1 / M)", 0, k_round_off, central_collision},
      {"discs with spin: grip", "P_t = -m_red slip / 3", 1, 1e-2,
       [](double h) { return discs_with_spin(0.5, true, h); }},
      {"discs with spin: slide", "P_t = friction P_n", 1, 1e-2,
       [](double h) { return discs_with_spin(0.1, false, h); }},
      {"disc hits a box off its centre", "J = (1 + e) v / (1 / m + 1 / M + d^2 / I)", 0, k_round_off, off_centre},
      {"billiard: right angle", "v_a . v_b = 0", 0, k_round_off, billiard},
      {"five balls with gaps: only the last one moves", "(0, 0, 0, 0, v)", 0, k_round_off, cradle_with_gaps},
      {"three balls, two touch", "(-1/3, 2/3, 2/3) v, simultaneous Newton impacts", 0, k_round_off,
       cradle_that_touches},
      {"Painleve's rod, friction 1.5: impact without collision", "P = (0.4, 0.3), v = (-0.6, 0.3, 1.3416)", 1, 2e-2,
       painleve},
      {"Painleve's rod, friction 1.2: normal force", "m g / (1 + 3 c^2 - 3 mu s c)", 0, k_round_off, below_painleve},
  };
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

}  // namespace tumble::physics
