// Position correction. See docs/theory/step.md.
#include <algorithm>
#include <cmath>

#include "tumble/step/step_parts.hpp"

namespace tumble {
namespace {

using Index = std::size_t;

constexpr double k_round_off = 1e-12;  // [-] of the size of the bodies: overlap below is none
constexpr double k_deep = 2e-3;        // [-] of the same: overlap above is met in this step, not in the next
constexpr double k_far = 0.25;         // [-] of the same: the way of one round, in which turns are nearly linear
constexpr int k_max_rounds = 4;

double gap_after(const StepWorkspace::Parts& parts, const StepContact& c, double h) {
  double gap = c.gap_at_start + c.way_bend + h * c.rows.offset;
  for_bodies(c.rows, [&](Index b, const Vector3& row, const Vector3&) { gap += dot(row, parts.travel[b]); });
  return gap;
}

// What is to be added to the travel of each body of the island: the LCP of frictionless contacts, with ways [m] for
// velocities and multipliers [kg m] for impulses.
void find_shifts(StepWorkspace::Parts& parts, IslandContacts contacts, double h, const StepSettings& settings) {
  const auto at = [&](int i) -> const StepContact& { return parts.contacts[static_cast<Index>(i)]; };
  if (contacts.size() == 1) {
    const StepContact& c = at(contacts[0]);
    double response = 0.0;
    for_bodies(c.rows, [&](Index b, const Vector3& n, const Vector3&) {
      for (Index j = 0; j < 3; ++j) response += n[j] * n[j] * parts.inverse_mass[b][j];
    });
    const double push = -gap_after(parts, c, h) / response;
    for_bodies(c.rows, [&](Index b, const Vector3& n, const Vector3&) {
      for (Index j = 0; j < 3; ++j) parts.shift[b][j] = parts.inverse_mass[b][j] * n[j] * push;
    });
    return;
  }
  IslandSolver& solver = parts.separator;
  solver.system.inverse_mass.clear();
  solver.system.velocity.assign(parts.island_body.size(), Vector3{});
  solver.system.contacts.clear();
  solver.modes.clear();
  solver.impulses.assign(2 * contacts.size(), 0.0);
  for (const int body : parts.island_body) {
    solver.system.inverse_mass.push_back(parts.inverse_mass[static_cast<Index>(body)]);
  }
  const auto local = [&](int body) { return body < 0 ? -1 : parts.local_body[static_cast<Index>(body)]; };
  for (const int i : contacts) {
    BodyContact& rows = solver.system.contacts.emplace_back(at(i).rows);
    rows.body_a = local(rows.body_a);
    rows.body_b = local(rows.body_b);
    rows.offset = gap_after(parts, at(i), h);
    rows.tangent_offset = 0.0;
    rows.friction = 0.0;
    solver.modes.push_back(rows.offset < 0.0 ? ContactMode::slip_right : ContactMode::open);
  }
  solver.solve({settings.solver, settings.num_sweeps});  // what overlap is left is met in the next step
  for (Index k = 0; k < parts.island_body.size(); ++k) {
    parts.shift[static_cast<Index>(parts.island_body[k])] = solver.velocity[k];
  }
}

// What turning adds to the gaps, of the travel found.
void find_way_bends(StepWorkspace::Parts& parts, IslandContacts contacts, double h) {
  for (const int i : contacts) {
    StepContact& c = parts.contacts[static_cast<Index>(i)];
    if (!c.is_ahead) {
      c.way_bend = bend_of_way(parts, c.contact, h);
      continue;
    }
    // Bodies that meet on their way may turn by much after it: their shapes are looked at where they end.
    c.way_bend = 0.0;
    if (c.mode == ContactMode::open) continue;
    set_way_velocity(h, parts, c.contact);
    c.way_bend = std::min(0.0, least_gap_at(parts, c.contact, parts.way_velocity, h) - gap_after(parts, c, h));
  }
}

// Any overlap deeper than the tolerance [-], of the size of the bodies.
bool has_overlap(const StepWorkspace::Parts& parts, IslandContacts contacts, double h, double tolerance) {
  return std::any_of(contacts.begin(), contacts.end(), [&](int i) {
    const StepContact& c = parts.contacts[static_cast<Index>(i)];
    double size = 0.0;
    for_bodies(c.rows, [&](Index b, const Vector3&, const Vector3&) { size = std::max(size, parts.radius[b]); });
    return gap_after(parts, c, h) < -tolerance * size;
  });
}

}  // namespace

bool separate(StepWorkspace::Parts& parts, IslandContacts contacts, double h, const StepSettings& settings,
              double lost) {
  double paid = std::max(lost, 0.0), tolerance = k_round_off;
  for (int round = 0; round < k_max_rounds; ++round) {
    find_way_bends(parts, contacts, h);
    if (!has_overlap(parts, contacts, h, tolerance)) return round > 0;
    list_bodies(parts, contacts);
    find_shifts(parts, contacts, h, settings);
    double work = 0.0;  // against the forces
    for (const int body : parts.island_body) {
      work -= dot(parts.force[static_cast<Index>(body)], parts.shift[static_cast<Index>(body)]);
    }
    double share = work > paid ? paid / work : 1.0;
    for (const int body : parts.island_body) {
      const auto b = static_cast<Index>(body);
      const Vector3& d = parts.shift[b];
      const double way = std::sqrt(d[0] * d[0] + d[1] * d[1]) + std::abs(d[2]) * parts.radius[b];
      share = std::min(share, k_far * parts.radius[b] / way);
    }
    for (const int body : parts.island_body) {
      const auto b = static_cast<Index>(body);
      for (Index j = 0; j < 3; ++j) parts.travel[b][j] += share * parts.shift[b][j];
    }
    forget_bodies(parts);
    if (!(share > 0.0)) return round > 0;
    paid = std::max(paid - share * work, 0.0);
    tolerance = k_deep;  // where the shifts turn bodies far, these turns add to the gaps in their turn
  }
  return true;
}

}  // namespace tumble
