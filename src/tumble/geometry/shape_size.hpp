// How large shapes are.
#pragma once

#include "tumble/scene/scene.hpp"

namespace tumble {

// [m] Of the circle about the origin of the body's frame that holds the shape; infinite for a half-plane.
double radius_of(const Shape& shape);

// The largest of these of all parts.
double radius_of(const Body& body);

struct ShapeSize {
  double radius = 0.0;     // [m] of a circle that holds the shape
  double thickness = 0.0;  // [m] its smallest width
};

// Infinite for ground.
ShapeSize size_of(const Shape& shape);

}  // namespace tumble
