// From metres to pixels: what a picture shows, and where its axes have ticks.
#pragma once

#include <string>
#include <vector>

#include "tumble/geometry/placed_shape.hpp"
#include "tumble/math/vector2.hpp"
#include "tumble/trajectory/trajectory.hpp"

namespace tumble::output {

struct Point {
  double x;
  double y;
};

// A part of the picture [px], y down.
struct Area {
  double left;
  double top;
  double width;
  double height;

  double right() const { return left + width; }
  double bottom() const { return top + height; }
};

// What of the world a picture shows.
struct Sight {
  Box box;                  // [m]
  double smallest = 0.0;    // [m] > 0: as much as that is shown in each direction, room around a body at rest
  bool has_ground = false;  // a half-plane carries what is in the box
};

// Where all that moves is during the whole run; of the fixed world what is near, and the boundary of half-planes unless
// it is so far away that bodies would shrink to specks for its sake. Where a few bodies leave the others far behind,
// the place of the others. Throws std::invalid_argument if that is too large or too small to be drawn, or
// the trajectory inconsistent.
Sight sight_of(const Trajectory& trajectory);

// Equal scales along x and y. Positions are taken relative to the middle first, so that a picture far from
// the origin keeps its detail.
struct View {
  Area area;
  Vector2 middle;  // [m], in the middle of the area
  double scale;    // [px / m]

  Point to_pixel(Vector2 position) const {
    return {area.left + 0.5 * area.width + (position.x - middle.x) * scale,
            area.top + 0.5 * area.height - (position.y - middle.y) * scale};
  }
};

// The sight as large as it fits between the margins [px] of the area.
struct Margins {
  double side;
  double top;
  double bottom;
};
View fit_view(const Sight& sight, const Area& area, const Margins& margins);

struct Tick {
  double pixel;
  std::string label;
};

struct Axis {
  std::vector<Tick> ticks;
  std::string unit;  // "m", or "m from 1e+09 m" where the labels would be too long to tell apart
};

// At most about `count` ticks at 1, 2 or 5 times a power of ten.
Axis axis_x(const View& view, int count);
Axis axis_y(const View& view, int count);

// Of a line on which `low` lies at the pixel `start` and `high` at `end`; `unit` as above.
Axis axis_along(double low, double high, double start, double end, int count, const std::string& unit);

// 1, 2 or 5 times a power of ten: the largest not above `value` > 0, and the smallest not below it.
double round_down_nicely(double value);
double round_up_nicely(double value);

}  // namespace tumble::output
