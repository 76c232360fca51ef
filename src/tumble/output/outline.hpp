// Shapes as lines of a picture.
#pragma once

#include <vector>

#include "tumble/output/view.hpp"
#include "tumble/scene/scene.hpp"

namespace tumble::output {

enum class LineKind {
  closed,  // around a body
  wall,    // a segment without thickness
  ground,  // solid on its right side
};

// The outline of a part in the frame of its body, in pixels, y up; round sides as many short ones.
struct PartOutline {
  LineKind kind = LineKind::closed;
  std::vector<Vector2> points;  // counter-clockwise, of ground along its direction
  double surface_speed = 0.0;   // [px / s] of a conveyor
};

// What lets a rotation be read: a spoke of round bodies, a dot of the others.
struct Mark {
  Vector2 from, to;     // a spoke; both the same: a dot
  double radius = 0.0;  // of the dot [px]
};

struct BodyOutline {
  std::vector<PartOutline> parts;
  Mark mark;
  double radius = 0.0;  // everything is within, about the origin of the body [px]
};

// Half-planes become ground as long as the view, on a body at its pose at the start.
BodyOutline outline_of(const Body& body, const View& view);

// A point of an outline in the picture, the body being at `centre` [px].
inline Point placed(Vector2 point, Point centre, const Frame& turn) {
  const Vector2 p = direction_to_world(turn, point);
  return {centre.x + p.x, centre.y - p.y};
}

// The part of a closed line inside the area, as one closed line; cairo knows no coordinates of more than some
// thousands.
std::vector<Point> clipped(std::vector<Point> points, const Area& area);

// The part of a line from a to b inside the area; false if there is none.
bool clip_line(Point& a, Point& b, const Area& area);

}  // namespace tumble::output
