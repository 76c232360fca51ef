// The contacts of two shapes: gap, normal and points, also while they are apart.
#pragma once

#include <vector>

#include "tumble/geometry/contact_point.hpp"
#include "tumble/math/pose.hpp"
#include "tumble/scene/shape.hpp"

namespace tumble {

// Appends the contacts with gap <= reach of two shapes, given the frames of their bodies:
//   - the two closest points, or, where the shapes overlap, those of least penetration: gap is the distance between
//     the shapes (exact to 1e-12 of their size; 1e-10 with an ellipse), or minus the depth;
//   - where sides face each other, the other end of the stretch that they share, so that a body can stand on a side.
//     Each end is a corner of one shape above a side of the other; gap and normal are those of that corner and side.
// The order of the contacts and their features depend on the shapes alone, not on where they are. Exchanging a and b
// exchanges the points and turns the normals round, bit for bit.
// Shapes with no area between them, terrain against terrain for one, have no contacts.
void find_contacts(const Shape& a, const Frame& frame_a, const Shape& b, const Frame& frame_b, double reach,
                   std::vector<ContactPoint>& contacts);

}  // namespace tumble
