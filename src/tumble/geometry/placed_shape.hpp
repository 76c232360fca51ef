// Shapes as the pair functions take them: in the world's axes, about the position of their body. Differences of
// positions come first in every formula, so that no digits are lost far from the origin.
#pragma once

#include <variant>
#include <vector>

#include "tumble/math/pose.hpp"
#include "tumble/scene/shape.hpp"

namespace tumble {

struct PlacedPolygon {
  // A corner and the side that leaves it, counter-clockwise.
  struct Corner {
    Vector2 vertex;
    Vector2 normal;       // of the side, outward, of length 1
    double offset = 0.0;  // normal . vertex
  };
  explicit PlacedPolygon(const RoundedPolygon& shape);

  int count() const { return static_cast<int>(corners.size()); }
  int sides() const { return count() < 2 ? 0 : count(); }  // both faces of a segment are sides
  int next(int i) const { return i + 1 < count() ? i + 1 : 0; }
  int previous(int i) const { return i > 0 ? i - 1 : count() - 1; }

  std::vector<Corner> corners;
  double rounding = 0.0;
  Vector2 position;  // of the body
  std::vector<Corner> local;
};

struct PlacedHalfPlane {
  explicit PlacedHalfPlane(const HalfPlane& shape)
      : normal(shape.normal), offset(shape.offset), local_normal(shape.normal) {}

  Vector2 normal;
  double offset = 0.0;
  Vector2 position;
  Vector2 local_normal;
};

using PlacedShape = std::variant<PlacedPolygon, PlacedHalfPlane>;

PlacedShape placed_shape(const Shape& shape);

void place(PlacedPolygon& shape, const Frame& frame);
void place(PlacedHalfPlane& shape, const Frame& frame);
void place(PlacedShape& shape, const Frame& frame);

// Bounding boxes in the world frame.
struct Box {
  Vector2 low, high;
};

inline bool overlap(const Box& a, const Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

// A box of everything within `margin` of the shape. Infinite for half-planes.
Box bounding_box(const PlacedShape& shape, double margin);

}  // namespace tumble
