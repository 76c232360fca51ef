// The rows of a contact in the Jacobians J_n, J_t.
#pragma once

#include <cmath>

#include "tumble/geometry/contact_point.hpp"
#include "tumble/lcp/contact_system.hpp"

namespace tumble {

// Where the impulse acts on a and on b. Bodies that touch are pushed at one place, so that angular momentum is
// conserved: on the flat one of the two surfaces, so that all contacts on one side lie on one line; where none is flat,
// half-way between them. Bodies that are apart are pushed where they will touch: each at its own point.
struct ContactPlaces {
  Vector2 on_a, on_b;
};

inline ContactPlaces contact_places(const Contact& contact, bool is_apart) {
  if (is_apart) return {contact.point_a, contact.point_b};
  Vector2 place = 0.5 * (contact.point_a + contact.point_b);
  if (std::isinf(contact.radius_b)) place = contact.point_b;
  if (std::isinf(contact.radius_a)) place = contact.point_a;
  return {place, place};
}

// J_n and J_t of the bodies at (frame origins) centre_a, centre_b, r = place - centre:
//   J_n = (n_x, n_y, r x n),  J_t = (t_x, t_y, r x t),  t the normal turned right; for a with the opposite sign.
// Offsets and friction are 0, bodies those of the contact.
inline BodyContact contact_rows(const Contact& contact, const ContactPlaces& places, Vector2 centre_a,
                                Vector2 centre_b) {
  const Vector2 n = contact.normal, t = turned_right(n);
  const Vector2 r_a = places.on_a - centre_a, r_b = places.on_b - centre_b;
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
