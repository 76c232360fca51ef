// Shapes as the pair functions take them: in the world's axes, about the position of their body. Differences of
// positions come first in every formula, so that no digits are lost far from the origin.
#pragma once

#include <algorithm>
#include <variant>
#include <vector>

#include "tumble/math/pose.hpp"
#include "tumble/scene/shape.hpp"

namespace tumble {

// With sides along the axes.
struct Box {
  Vector2 low, high;
};

inline bool overlap(const Box& a, const Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

// The least box around both.
inline Box united(const Box& a, const Box& b) {
  return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
          {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
}

struct PlacedPolygon {
  // A corner and the side that leaves it, counter-clockwise.
  struct Corner {
    Vector2 vertex;
    Vector2 normal;       // of the side, outward, of length 1
    double offset = 0.0;  // normal . vertex
  };
  explicit PlacedPolygon(const RoundedPolygon& shape);

  int count() const { return num_corners; }
  int sides() const { return count() < 2 ? 0 : count(); }  // both faces of a segment are sides
  int next(int i) const { return i + 1 < count() ? i + 1 : 0; }
  int previous(int i) const { return i > 0 ? i - 1 : count() - 1; }

  std::vector<Corner> corners;
  int num_corners = 0;
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

struct PlacedEllipse {
  explicit PlacedEllipse(const Ellipse& shape);

  double semi_axis_x = 0.0, semi_axis_y = 0.0;
  Vector2 centre;  // about the position of the body
  Vector2 axis;    // direction of the first axis, of length 1
  Vector2 position;
  Frame local;
};

struct PlacedTerrain {
  // A point and the segment that leaves it; the last point has none and keeps the directions of the one before.
  struct Point {
    Vector2 point;
    Vector2 normal;  // out of the ground: the direction of the segment turned left
    double length = 0.0;
  };
  explicit PlacedTerrain(const Terrain& shape);

  int segments() const { return static_cast<int>(points.size()) - 1; }

  std::vector<Point> points;
  std::vector<Box> blocks;  // of k_block segments each
  Vector2 position;
  std::vector<Point> local;

  static constexpr int k_block = 16;
};

using PlacedShape = std::variant<PlacedPolygon, PlacedEllipse, PlacedHalfPlane, PlacedTerrain>;

PlacedShape placed_shape(const Shape& shape);

void place(PlacedPolygon& shape, const Frame& frame);
void place(PlacedEllipse& shape, const Frame& frame);
void place(PlacedHalfPlane& shape, const Frame& frame);
void place(PlacedTerrain& shape, const Frame& frame);
void place(PlacedShape& shape, const Frame& frame);

// A box in the world frame of everything within `margin` of the shape. Infinite for half-planes.
Box bounding_box(const PlacedPolygon& shape, double margin);
Box bounding_box(const PlacedEllipse& shape, double margin);
Box bounding_box(const PlacedHalfPlane& shape, double margin);
Box bounding_box(const PlacedTerrain& shape, double margin);
Box bounding_box(const PlacedShape& shape, double margin);

// A shape and where it is.
class MovedShape {
 public:
  MovedShape(const Shape& shape, const Pose& pose) : placed_(placed_shape(shape)), pose_(pose) {
    place(placed_, frame_of(pose));
  }

  // False if it is there already.
  bool move_to(const Pose& pose) {
    if (pose == pose_) return false;
    pose_ = pose;
    place(placed_, frame_of(pose));
    return true;
  }
  const PlacedShape& placed() const { return placed_; }

 private:
  PlacedShape placed_;
  Pose pose_;
};

}  // namespace tumble
