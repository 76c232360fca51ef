// How the gap of a contact changes while its two bodies move.
#pragma once

#include "tumble/geometry/contact_point.hpp"
#include "tumble/math/vector.hpp"
#include "tumble/math/vector2.hpp"

namespace tumble {

// How a body moves: the position of the point that `velocity` (v_x, v_y, omega) is that of, its centre of mass for one.
struct Motion {
  Vector2 position;  // [m]
  Vector3 velocity{};
};

// d(gap)/dt [m/s]: n . (velocity of point_b - velocity of point_a), the points taken as points of the bodies.
double gap_rate(const ContactPoint& contact, const Motion& a, const Motion& b);

// d^2(gap)/dt^2 [m/s^2] while both bodies keep v and omega, exactly: what is known of the surfaces at the contact,
// their normals and curvatures, decides it. Each surface stands for its circle of curvature, a corner for a circle of
// radius 0:
//   circle and circle   gap = |c_b - c_a| - rho_a - rho_b, with the centres c fixed in the bodies;
//   side and circle     gap = n . (c_b - s) - rho_b, with n and a point s of the side turning with a; the same for b.
// For two sides, which no contact of find_contacts has, that of a and the corner at point_b. Where two centres coincide
// the gap has no second derivative; the part that is infinite there is left out.
double gap_curvature(const ContactPoint& contact, const Motion& a, const Motion& b);

}  // namespace tumble
