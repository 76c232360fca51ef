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
  for_bodies(c.rows, [&](Index b, const Vector3& row) { gap += dot(row, parts.travel[b]); });
  return -gap;
}

// What does not change in the sweeps.
SeparationRow row_of(const StepWorkspace::Parts& parts, const StepContact& c, double h) {
  SeparationRow row{c.gap_at_start + c.way_bend + h * c.rows.offset, 0.0, 0.0, 0.0, 0, {}};
  for_bodies(c.rows, [&](Index b, const Vector3& n) {
    SeparationRow::Side& side = row.sides[row.num_sides++];
    side = {b, n, {}, dot(n, parts.travel[b])};
    for (Index j = 0; j < 3; ++j) {
      side.response[j] = parts.inverse_mass[b][j] * n[j];
      row.response += n[j] * n[j] * parts.inverse_mass[b][j];
    }
    row.size = std::max(row.size, parts.radius[b]);
  });
  return row;
}

// One step of projected Gauss-Seidel on the multiplier of gap >= 0. True if it moved something.
bool sweep(SeparationRow& row, std::vector<Vector3>& shift) {
  double gap = row.gap;
  for (Index k = 0; k < row.num_sides; ++k) {
    const SeparationRow::Side& side = row.sides[k];
    gap += side.travel + dot(side.normal, shift[side.body]);
  }
  const double push = std::max(0.0, row.push - gap / row.response), more = push - row.push;
  if (more == 0.0) return false;
  for (Index k = 0; k < row.num_sides; ++k) {
    const SeparationRow::Side& side = row.sides[k];
    for (Index j = 0; j < 3; ++j) shift[side.body][j] += side.response[j] * more;
  }
  row.push = push;
  return std::abs(more) * row.response > k_unmoved * row.size;
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

  parts.separation.clear();
  for (const int i : contacts) parts.separation.push_back(row_of(parts, at(i), h));
  for (int count = 0; count < max_sweeps; ++count) {
    bool has_moved = false;
    for (SeparationRow& row : parts.separation) has_moved = sweep(row, parts.shift) || has_moved;
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
