// Position correction. See docs/theory/step.md.
#include <algorithm>
#include <cmath>

#include "tumble/step/step_parts.hpp"

namespace tumble {
namespace {

using Index = std::size_t;

constexpr double k_round_off = 1e-12;  // [-] of the size of the bodies: overlap below is none
constexpr double k_unmoved = 1e-15;    // [-] of the same: the sweeps have arrived
constexpr int k_max_sweeps = 1000;     // what overlap they leave is met by those of the next step
constexpr int k_fast_sweeps = 10;      // of the fast solver

// Both bodies of a contact: f(body, row of the normal).
template <typename F>
void for_bodies(const BodyContact& rows, const F& f) {
  if (rows.body_a >= 0) f(static_cast<Index>(rows.body_a), rows.normal_a);
  if (rows.body_b >= 0) f(static_cast<Index>(rows.body_b), rows.normal_b);
}

double overlap_after(const StepWorkspace::Parts& parts, const StepContact& c, double h) {
  double gap = c.gap_at_start + c.way_bend + h * c.rows.offset;
  for_bodies(c.rows, [&](Index b, const Vector3& row) { gap += dot(row, parts.travel[b]) + dot(row, parts.shift[b]); });
  return -gap;
}

}  // namespace

bool separate(StepWorkspace::Parts& parts, IslandContacts contacts, double h, const StepSettings& settings,
              double lost) {
  const int max_sweeps = settings.solver == ContactSolver::fast ? k_fast_sweeps : k_max_sweeps;
  const auto at = [&](int i) -> StepContact& { return parts.contacts[static_cast<Index>(i)]; };
  // The bend of the way that was found, with slips that impacts may have changed.
  const auto motion_of = [&](int body) {
    const auto b = static_cast<Index>(body);
    Motion motion{parts.poses[b].position, parts.velocity[b]};
    if (parts.inverse_mass[b][0] > 0.0) {
      for (Index j = 0; j < 3; ++j) motion.velocity[j] = parts.travel[b][j] / h;
    }
    return motion;
  };
  for (const int i : contacts) {
    StepContact& c = at(i);
    if (!c.is_ahead) c.way_bend = bend_of(c.contact, motion_of(c.contact.body_a), motion_of(c.contact.body_b), h);
  }
  const bool has_overlap = std::any_of(contacts.begin(), contacts.end(), [&](int i) {
    double size = 0.0;
    for_bodies(at(i).rows, [&](Index b, const Vector3&) { size = std::max(size, parts.radius[b]); });
    return overlap_after(parts, at(i), h) > k_round_off * size;
  });
  if (!has_overlap) return false;

  // Projected Gauss-Seidel on the multipliers of gap >= 0.
  for (const int i : contacts) at(i).push = 0.0;
  for (int sweep = 0; sweep < max_sweeps; ++sweep) {
    bool has_moved = false;
    for (const int i : contacts) {
      StepContact& c = at(i);
      double response = 0.0, size = 0.0;
      for_bodies(c.rows, [&](Index b, const Vector3& n) {
        for (Index j = 0; j < 3; ++j) response += n[j] * n[j] * parts.inverse_mass[b][j];
        size = std::max(size, parts.radius[b]);
      });
      const double push = std::max(0.0, c.push + overlap_after(parts, c, h) / response);
      has_moved = has_moved || std::abs(push - c.push) * response > k_unmoved * size;
      for_bodies(c.rows, [&](Index b, const Vector3& n) {
        for (Index j = 0; j < 3; ++j) parts.shift[b][j] += parts.inverse_mass[b][j] * n[j] * (push - c.push);
      });
      c.push = push;
    }
    if (!has_moved) break;
  }

  double work = 0.0;  // against the forces
  for (const int body : parts.island_body) {
    const auto b = static_cast<Index>(body);
    work -= dot(parts.force[b], parts.shift[b]);
  }
  const double paid = std::max(lost, 0.0);
  const double share = work > paid ? paid / work : 1.0;
  for (const int body : parts.island_body) {
    const auto b = static_cast<Index>(body);
    for (Index j = 0; j < 3; ++j) parts.travel[b][j] += share * parts.shift[b][j];
    parts.shift[b] = {};
  }
  return true;
}

}  // namespace tumble
