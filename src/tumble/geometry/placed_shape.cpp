#include "tumble/geometry/placed_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tumble {
namespace {

// Box about the position of a body, moved there. A little more than round-off is added, so that no contact within
// `margin` is lost to it.
Box moved_box(Vector2 position, Vector2 low, Vector2 high, double margin) {
  constexpr double k_round_off = 4.0 * std::numeric_limits<double>::epsilon();
  const double size = std::abs(position.x) + std::abs(position.y) + (high.x - low.x) + (high.y - low.y);
  const double m = margin + k_round_off * size;
  return {{position.x + (low.x - m), position.y + (low.y - m)}, {position.x + (high.x + m), position.y + (high.y + m)}};
}

Box box_of(const PlacedPolygon& shape, double margin) {
  Vector2 low = shape.corners[0].vertex, high = low;
  for (const PlacedPolygon::Corner& corner : shape.corners) {
    low = {std::min(low.x, corner.vertex.x), std::min(low.y, corner.vertex.y)};
    high = {std::max(high.x, corner.vertex.x), std::max(high.y, corner.vertex.y)};
  }
  return moved_box(shape.position, low, high, margin + shape.rounding);
}

Box box_of(const PlacedHalfPlane&, double) {
  constexpr double k_infinity = std::numeric_limits<double>::infinity();
  return {{-k_infinity, -k_infinity}, {k_infinity, k_infinity}};
}

}  // namespace

PlacedPolygon::PlacedPolygon(const RoundedPolygon& shape) : rounding(shape.rounding) {
  const std::size_t n = shape.vertices.size();
  for (std::size_t i = 0; i < n; ++i) {
    Corner corner{shape.vertices[i], {}, 0.0};
    if (n > 1) {
      const Vector2 side = shape.vertices[i + 1 < n ? i + 1 : 0] - corner.vertex;
      corner.normal = turned_right((1.0 / length(side)) * side);
    }
    local.push_back(corner);
  }
  corners = local;
}

PlacedShape placed_shape(const Shape& shape) {
  if (const auto* polygon = std::get_if<RoundedPolygon>(&shape)) return PlacedPolygon(*polygon);
  if (const auto* plane = std::get_if<HalfPlane>(&shape)) return PlacedHalfPlane(*plane);
  throw std::invalid_argument("contacts of ellipses and terrain are not there yet");
}

void place(PlacedPolygon& shape, const Frame& frame) {
  shape.position = frame.position;
  for (std::size_t i = 0; i < shape.corners.size(); ++i) {
    PlacedPolygon::Corner& corner = shape.corners[i];
    corner.vertex = direction_to_world(frame, shape.local[i].vertex);
    corner.normal = direction_to_world(frame, shape.local[i].normal);
    corner.offset = dot(corner.normal, corner.vertex);
  }
}

void place(PlacedHalfPlane& shape, const Frame& frame) {
  shape.position = frame.position;
  shape.normal = direction_to_world(frame, shape.local_normal);
}

void place(PlacedShape& shape, const Frame& frame) {
  std::visit([&](auto& s) { place(s, frame); }, shape);
}

Box bounding_box(const PlacedShape& shape, double margin) {
  return std::visit([&](const auto& s) { return box_of(s, margin); }, shape);
}

}  // namespace tumble
