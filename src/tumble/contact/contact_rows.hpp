// The rows of a contact in the Jacobians J_n, J_t.
#pragma once

#include <cmath>

#include "tumble/geometry/contact_point.hpp"
#include "tumble/lcp/contact_system.hpp"

namespace tumble {

// Where the impulse acts: on the flat one of the two surfaces, so that all contacts on one side lie on one line; where
// none is flat, half-way between them. One place for both bodies: angular momentum is conserved.
inline Vector2 contact_place(const Contact& contact) {
  if (std::isinf(contact.radius_a)) return contact.point_a;
  if (std::isinf(contact.radius_b)) return contact.point_b;
  return 0.5 * (contact.point_a + contact.point_b);
}

// J_n and J_t of the bodies at (frame origins) centre_a, centre_b, r = contact_place - centre:
//   J_n = (n_x, n_y, r x n),  J_t = (t_x, t_y, r x t),  t the normal turned right; for a with the opposite sign.
// Offsets and friction are 0, bodies those of the contact.
inline BodyContact contact_rows(const Contact& contact, Vector2 place, Vector2 centre_a, Vector2 centre_b) {
  const Vector2 n = contact.normal, t = turned_right(n);
  const Vector2 r_a = place - centre_a, r_b = place - centre_b;
  BodyContact rows;
  rows.body_a = contact.body_a;
  rows.body_b = contact.body_b;
  rows.normal_a = {-n.x, -n.y, -cross(r_a, n)};
  rows.normal_b = {n.x, n.y, cross(r_b, n)};
  rows.tangent_a = {-t.x, -t.y, -cross(r_a, t)};
  rows.tangent_b = {t.x, t.y, cross(r_b, t)};
  return rows;
}

}  // namespace tumble
