// Polygons that slide past each other's corners.
#pragma once

#include <optional>

#include "tumble/geometry/contact_point.hpp"
#include "tumble/geometry/placed_shape.hpp"

namespace tumble {

// Where two corners are closest, a body can pass on either side of the other one, and the line between the corners says
// little about which: for a square that slides over the joint between two level boxes it is horizontal. So: of all
// directions that are normal to a side and along which the polygons are apart, or overlap by at most `tolerance` [m],
// the contact in the one along which they are farthest apart once b has moved by `way` seen from a. Its points are a
// corner and the foot of its height on the line of the side, which may lie beyond the end of the side. Nothing for
// other shapes, or if there is no such direction.
std::optional<ContactPoint> passing_contact(const PlacedShape& a, const PlacedShape& b, Vector2 way, double tolerance);

}  // namespace tumble
