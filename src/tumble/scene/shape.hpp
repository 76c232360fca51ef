// Shapes of bodies and of the fixed world, in the frame of the body that they belong to. SI units.
#pragma once

#include <variant>
#include <vector>

#include "tumble/math/pose.hpp"

namespace tumble {

// The points within `rounding` of a convex polygon: a disc (one vertex), a capsule (two), a polygon (no rounding), a
// rounded polygon. A wall without thickness is two vertices without rounding.
struct RoundedPolygon {
  std::vector<Vector2> vertices;  // counter-clockwise, strictly convex
  double rounding = 0.0;          // [m] >= 0

  friend bool operator==(const RoundedPolygon&, const RoundedPolygon&) = default;
};

struct Ellipse {
  double semi_axis_x = 0.0;  // [m] > 0, along x of `pose`
  double semi_axis_y = 0.0;
  Pose pose;  // of its centre and axes in the frame of the body

  friend bool operator==(const Ellipse&, const Ellipse&) = default;
};

// All points p with normal . p <= offset: solid below the line. Fixed bodies only.
struct HalfPlane {
  Vector2 normal;       // of length 1, out of the solid
  double offset = 0.0;  // [m]

  friend bool operator==(const HalfPlane&, const HalfPlane&) = default;
};

// Ground along a polyline, solid to the right of its direction (below it, for points from left to right). Its inner
// vertices are no corners for what slides along: contacts there take the normals of the segments. Fixed or kinematic
// bodies only.
struct Terrain {
  std::vector<Vector2> points;  // two or more, no two neighbours equal

  friend bool operator==(const Terrain&, const Terrain&) = default;
};

using Shape = std::variant<RoundedPolygon, Ellipse, HalfPlane, Terrain>;

// Short forms, each centred at the origin. They throw std::invalid_argument naming the field.
RoundedPolygon disc(double radius, Vector2 center = {});
RoundedPolygon rectangle(double width, double height, double rounding = 0.0);  // outer sizes
RoundedPolygon square(double side, double rounding = 0.0);
// The lowest side is level. Rounding included, the corners reach to `circumradius`.
RoundedPolygon regular_polygon(int corners, double circumradius, double rounding = 0.0);
RoundedPolygon capsule(double length, double radius);  // length between the centres of its ends, along x
RoundedPolygon segment(Vector2 from, Vector2 to);
Ellipse ellipse(double semi_axis_x, double semi_axis_y);
// The normal may have any length but 0.
HalfPlane half_plane(Vector2 normal, double offset = 0.0);

// The same shape moved within its body's frame.
Shape moved(const Shape& shape, const Pose& pose);

// Throws std::invalid_argument naming field and index: too few or too many vertices, NaN, not convex, clockwise, ...
void validate(const Shape& shape);

struct AreaMoments {
  double area = 0.0;          // [m^2]
  Vector2 centroid;           // [m]
  double polar_moment = 0.0;  // [m^4], integral of |p - centroid|^2
};

// Exact, roundings included; without area for half-planes, terrain and segments.
AreaMoments area_moments(const Shape& shape);

}  // namespace tumble
