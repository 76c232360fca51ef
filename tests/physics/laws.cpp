#include "laws.hpp"

#include <algorithm>
#include <cmath>

#include "tumble/math/format.hpp"

namespace tumble::physics {
namespace {

constexpr double k_round_off = 1e-13;         // [-] of what is summed, a few terms
constexpr double k_ledger_round_off = 1e-12;  // [-] the same for energies, whose terms are products
constexpr double k_closed_gap = 1e-12;        // [m] below is touch
constexpr double k_rounded_residual = 1e-12;  // [-] what a step may be off beyond the residual that it reports
constexpr double k_force_round_off = 1e-10;   // [-] of impulses that are found by the velocities they cause

std::string describe(const ContactRecord& c) {
  return tumble::format(
      "contact {}/{} (gap {:.3g}, bend {:.3g}, mode {}, impulse ({:.6g}, {:.6g}), u ({:.6g}, {:.6g}) -> ({:.6g}, "
      "{:.6g}))",
      c.contact.body_a, c.contact.body_b, c.contact.gap, c.bend, to_string(c.mode), c.normal_impulse,
      c.friction_impulse, c.normal_velocity, c.tangential_velocity, c.normal_velocity_after,
      c.tangential_velocity_after);
}

// A sum that remembers how large its terms were.
struct Sum {
  double value = 0.0, size = 0.0;
  void add(double term) {
    value += term;
    size += std::abs(term);
  }
};

// [m/s] of what contact velocities are sums of: speeds before and after, and what impulses change them by.
double size_of_speeds(const Scene& scene, const StepReport& report) {
  double largest = 0.0;
  for (const ContactRecord& c : report.contacts) {
    if (c.mode == ContactMode::open) continue;
    double change = 0.0;
    for (const int i : {c.contact.body_a, c.contact.body_b}) {
      const Body& body = scene.bodies[static_cast<std::size_t>(i)];
      if (body.kind == BodyKind::dynamic) change += (c.normal_impulse + std::abs(c.friction_impulse)) / body.mass;
    }
    largest = std::max({largest, std::abs(c.normal_velocity), std::abs(c.tangential_velocity),
                        std::abs(c.normal_velocity_after), std::abs(c.tangential_velocity_after), change});
  }
  return largest;
}

}  // namespace

void check_momentum(const Scene& scene, double h, const State& before, const State& after, const StepReport& report,
                    std::vector<std::string>& broken) {
  std::vector<std::array<Sum, 3>> sums(scene.bodies.size());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (body.kind != BodyKind::dynamic) continue;
    const Vector3 wrench = mean_wrench(body, before.time, before.time + h);
    const Vector3 force = {body.mass * scene.gravity.x + wrench[0], body.mass * scene.gravity.y + wrench[1], wrench[2]};
    for (std::size_t j = 0; j < 3; ++j) {
      const double mass = j < 2 ? body.mass : body.moment_of_inertia;
      const double damping = j < 2 ? body.linear_damping : body.angular_damping;
      sums[i][j].add(-mass * after.bodies[i].velocity[j]);
      sums[i][j].add(mass * before.bodies[i].velocity[j] / (1.0 + h * damping));
      sums[i][j].add(h * force[j] / (1.0 + h * damping));
    }
  }
  for (const ContactRecord& c : report.contacts) {
    const Vector2 impulse = c.normal_impulse * c.contact.normal + c.friction_impulse * c.tangent;
    const auto push = [&](int body, double sign, Vector2 place) {
      const auto i = static_cast<std::size_t>(body);
      const Vector2 arm = place - before.bodies[i].pose.position;
      sums[i][0].add(sign * impulse.x);
      sums[i][1].add(sign * impulse.y);
      sums[i][2].add(sign * arm.x * impulse.y);
      sums[i][2].add(-sign * arm.y * impulse.x);
    };
    push(c.contact.body_a, -1.0, c.place_a);
    push(c.contact.body_b, 1.0, c.place_b);
  }
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (scene.bodies[i].kind != BodyKind::dynamic) continue;
    for (std::size_t j = 0; j < 3; ++j) {
      if (std::abs(sums[i][j].value) <= k_round_off * sums[i][j].size) continue;
      broken.push_back(tumble::format("momentum: {} of body {}, {:.3g} is missing, of {:.3g}", "xyw"[j], i,
                                      sums[i][j].value, sums[i][j].size));
    }
  }
}

namespace {

// What pushes does not pull; where nothing bounces, what pushes closes its gap or is closed.
void check_signorini(const ContactRecord& c, double h, double tolerance, bool bounces,
                     std::vector<std::string>& broken) {
  const auto blame = [&](const char* what) { broken.push_back(tumble::format("{}: {}", what, describe(c))); };
  const double closing = std::max(std::max(c.contact.gap, 0.0) + c.bend, 0.0) / h, u_n = c.normal_velocity_after;
  if (c.normal_impulse < 0.0) blame("a contact pulls");
  if (c.mode == ContactMode::open && (c.normal_impulse != 0.0 || c.friction_impulse != 0.0)) {
    blame("an open contact pushes");
  }
  if (c.normal_impulse == 0.0) return;
  // Closed by the way, if that goes with the velocity after; else by a way of its own. Tiny gaps count as closed.
  const double rest = std::min(std::abs(u_n), std::abs(u_n + closing));
  if (!bounces && rest > tolerance + k_closed_gap / h) blame("a contact pushes that does not close");
  if (c.restitution > 0.0 && u_n < -tolerance) blame("a contact that bounces does not open");
}

// Friction within its cone; full, and against the slip, where there is one.
// `slack` [N s]: what the impulse may be off where the velocity is by `tolerance`.
void check_coulomb(const ContactRecord& c, double tolerance, double slack, std::vector<std::string>& broken) {
  const auto blame = [&](const char* what) { broken.push_back(tumble::format("{}: {}", what, describe(c))); };
  const double P_n = c.normal_impulse, P_t = c.friction_impulse, u_t = c.tangential_velocity_after;
  if (std::abs(P_t) > c.law.static_friction * P_n * (1.0 + k_force_round_off)) blame("friction is outside its cone");
  if (c.mode == ContactMode::open || std::abs(u_t) <= tolerance) return;
  if (std::abs(P_t) > c.law.friction * P_n * (1.0 + k_force_round_off) + slack)
    blame("friction of a slip is that of sticking");
  if (c.law.friction > 0.0 && P_t * u_t > 0.0) blame("friction does not oppose the slip");
  if (std::abs(P_t) < c.law.friction * P_n * (1.0 - k_force_round_off) - slack) blame("friction of a slip is not full");
  if (c.mode == ContactMode::stick) blame("a contact slips that is said to stick");
  if ((c.mode == ContactMode::slip_left) != (u_t < 0.0)) blame("a contact slips to the other side than said");
}

}  // namespace

void check_contacts(const Scene& scene, double h, const State& before, const StepReport& report,
                    std::vector<std::string>& broken) {
  const double residual = (report.residual + k_rounded_residual) * size_of_speeds(scene, report);
  // Of a step that is not solved to round-off, impulses are off by what the residual can change them by.
  const auto mass_of = [&](int body) {
    const Body& b = scene.bodies[static_cast<std::size_t>(body)];
    return b.kind == BodyKind::dynamic ? b.mass : HUGE_VAL;
  };
  // Of gaps, by those of places [m/s].
  const auto rounding = [&](int body, Vector2 point) {
    return 1e-15 * (length(point) + length(before.bodies[static_cast<std::size_t>(body)].pose.position)) / h;
  };
  // Where impacts follow each other in one step, impulses are those of all of them, velocities those after the last.
  const bool bounces = std::any_of(report.contacts.begin(), report.contacts.end(),
                                   [](const ContactRecord& c) { return c.restitution > 0.0; });
  for (const ContactRecord& record : report.contacts) {
    const Contact& c = record.contact;
    const double tolerance = residual + rounding(c.body_a, c.point_a) + rounding(c.body_b, c.point_b);
    check_signorini(record, h, tolerance, bounces, broken);
    const double slack =
        report.residual * size_of_speeds(scene, report) * std::min(mass_of(c.body_a), mass_of(c.body_b));
    if (!bounces) check_coulomb(record, tolerance, slack, broken);
  }
}

void check_energy(const Scene& scene, const State& before, const State& after, const StepReport& report,
                  std::vector<std::string>& broken) {
  const EnergyLedger old = energies(scene, before), now = energies(scene, after);
  const EnergyLedger& energy = report.energy;
  Sum sum;
  for (const double term :
       {old.kinetic, old.potential, -energy.kinetic, -energy.potential, energy.external_work, -energy.friction_loss,
        -energy.impact_loss, -energy.damping_loss, energy.stabilisation_work}) {
    sum.add(term);
  }
  if (std::abs(sum.value) > k_ledger_round_off * sum.size) {
    broken.push_back(tumble::format("energy: {:.3g} J are missing, of {:.3g} J", sum.value, sum.size));
  }
  if (std::abs(now.kinetic - energy.kinetic) > k_ledger_round_off * now.kinetic)
    broken.push_back("kinetic energy is not that of the state");
  if (std::abs(now.potential - energy.potential) > k_ledger_round_off * sum.size)
    broken.push_back("potential energy is not that of the state");
  const double gain = energy.stabilisation_work - energy.friction_loss - energy.impact_loss;
  if (gain > energy.created + k_ledger_round_off * sum.size) {
    broken.push_back(tumble::format("energy: contacts gain {:.3g} J and report {:.3g} J, of {:.3g} J", gain,
                                    energy.created, sum.size));
  }
}

std::vector<std::string> broken_laws(const Scene& scene, double step_size, const State& before, const State& after,
                                     const StepReport& report) {
  std::vector<std::string> broken;
  check_momentum(scene, step_size, before, after, report, broken);
  check_contacts(scene, step_size, before, report, broken);
  check_energy(scene, before, after, report, broken);
  return broken;
}

}  // namespace tumble::physics
