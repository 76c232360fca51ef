// From metres to pixels: what a picture shows, and where its axes have ticks.
#pragma once

#include <string>
#include <vector>

#include "tumble/drop/drop.hpp"

namespace tumble::output {

struct Point {
  double x;
  double y;
};

// A part of the world [m], y up.
struct Box {
  double x_low;
  double x_high;
  double y_low;
  double y_high;
  bool has_ground;  // the line y = 0 is inside
};

// A part of the picture [px], y down.
struct Frame {
  double left;
  double top;
  double width;
  double height;

  double right() const { return left + width; }
  double bottom() const { return top + height; }
};

// Where the square is during the whole record, at any angle, and the ground unless it is so far away that the
// square would shrink to a speck for its sake. Throws std::invalid_argument if that is too large to be drawn.
Box box_of(const drop::Record& record);

// Equal scales along x and y. Positions are taken relative to the middle first, so that a picture far from
// the origin keeps its detail.
struct View {
  Frame frame;
  Point middle;  // [m], in the middle of the frame
  double scale;  // [px / m]
  double side;   // of the square [px]
  bool has_ground;

  Point to_pixel(double x, double y) const {
    return {frame.left + 0.5 * frame.width + (x - middle.x) * scale,
            frame.top + 0.5 * frame.height - (y - middle.y) * scale};
  }
};

// The box as large as it fits between the margins [px] of the frame.
struct Margins {
  double side;
  double top;
  double bottom;
};
View fit_view(const Box& box, double l, const Frame& frame, const Margins& margins);

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

// 1, 2 or 5 times a power of ten: the largest not above `value` > 0, and the smallest not below it.
double round_down_nicely(double value);
double round_up_nicely(double value);

}  // namespace tumble::output
