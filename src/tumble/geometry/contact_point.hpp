// Where two shapes touch, or would touch first.
#pragma once

#include <cstdint>

#include "tumble/math/vector2.hpp"

namespace tumble {

// A pair of points, one on the surface of a, one on that of b, and the normal between them; all in the world frame [m].
struct ContactPoint {
  Vector2 normal;    // of length 1, from a to b
  Vector2 point_a;   // on the surface of a
  Vector2 point_b;   // on the surface of b: point_b - point_a = gap * normal
  double gap = 0.0;  // < 0: overlap
  // Radii of curvature of the surfaces at the points [m]: 0 for a corner, infinity for a flat side. The centres of
  // curvature, point_a - radius_a normal and point_b + radius_b normal, are points of the bodies, by which the gap is
  // known to second order in the motion (`gap_curvature`).
  double radius_a = 0.0;
  double radius_b = 0.0;
  std::uint32_t feature = 0;  // which corners or sides of the two shapes touch: the same number for the same features
};

// A contact of two bodies.
struct Contact : ContactPoint {
  int body_a = 0, body_b = 0;  // indices into Scene::bodies, body_a < body_b
  int part_a = 0, part_b = 0;  // indices into Body::parts
};

}  // namespace tumble
