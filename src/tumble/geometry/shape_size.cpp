#include "tumble/geometry/shape_size.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace tumble {
namespace {

double farthest(const std::vector<Vector2>& points) {
  double largest = 0.0;
  for (const Vector2 point : points) largest = std::max(largest, length(point));
  return largest;
}

}  // namespace

double radius_of(const Shape& shape) {
  if (const auto* polygon = std::get_if<RoundedPolygon>(&shape)) return farthest(polygon->vertices) + polygon->rounding;
  if (const auto* ellipse = std::get_if<Ellipse>(&shape)) {
    return length(ellipse->pose.position) + std::max(ellipse->semi_axis_x, ellipse->semi_axis_y);
  }
  if (const auto* terrain = std::get_if<Terrain>(&shape)) return farthest(terrain->points);
  return HUGE_VAL;
}

double radius_of(const Body& body) {
  double largest = 0.0;
  for (const Part& part : body.parts) largest = std::max(largest, radius_of(part.shape));
  return largest;
}

ShapeSize size_of(const Shape& shape) {
  if (const auto* polygon = std::get_if<RoundedPolygon>(&shape)) {
    const std::vector<Vector2>& v = polygon->vertices;
    ShapeSize size{0.0, v.size() < 3 ? 0.0 : HUGE_VAL};
    for (std::size_t i = 0; i < v.size(); ++i) {
      const Vector2 side = v[(i + 1) % v.size()] - v[i];
      double width = 0.0;
      for (const Vector2 vertex : v) {
        size.radius = std::max(size.radius, 0.5 * length(vertex - v[i]));
        if (v.size() > 2) width = std::max(width, cross(side, vertex - v[i]) / length(side));
      }
      size.thickness = std::min(size.thickness, width);
    }
    return {size.radius + polygon->rounding, size.thickness + 2.0 * polygon->rounding};
  }
  if (const auto* ellipse = std::get_if<Ellipse>(&shape)) {
    return {std::max(ellipse->semi_axis_x, ellipse->semi_axis_y),
            2.0 * std::min(ellipse->semi_axis_x, ellipse->semi_axis_y)};
  }
  return {HUGE_VAL, HUGE_VAL};
}

}  // namespace tumble
