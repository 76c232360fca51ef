#include "tumble/geometry/placed_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

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

}  // namespace

Box bounding_box(const PlacedPolygon& shape, double margin) {
  Vector2 low = shape.corners[0].vertex, high = low;
  for (const PlacedPolygon::Corner& corner : shape.corners) {
    low = {std::min(low.x, corner.vertex.x), std::min(low.y, corner.vertex.y)};
    high = {std::max(high.x, corner.vertex.x), std::max(high.y, corner.vertex.y)};
  }
  return moved_box(shape.position, low, high, margin + shape.rounding);
}

Box bounding_box(const PlacedTerrain& shape, double margin) {
  Box box = shape.blocks[0];
  for (const Box& block : shape.blocks) box = united(box, block);
  return moved_box(shape.position, box.low, box.high, margin);
}

Box bounding_box(const PlacedEllipse& shape, double margin) {
  const double p = shape.semi_axis_x, q = shape.semi_axis_y;
  const Vector2 half = {length({p * shape.axis.x, q * shape.axis.y}), length({p * shape.axis.y, q * shape.axis.x})};
  return moved_box(shape.position, shape.centre - half, shape.centre + half, margin);
}

Box bounding_box(const PlacedHalfPlane&, double) {
  constexpr double k_infinity = std::numeric_limits<double>::infinity();
  return {{-k_infinity, -k_infinity}, {k_infinity, k_infinity}};
}

PlacedPolygon::PlacedPolygon(const RoundedPolygon& shape)
    : num_corners(static_cast<int>(shape.vertices.size())), rounding(shape.rounding) {
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

PlacedEllipse::PlacedEllipse(const Ellipse& shape)
    : semi_axis_x(shape.semi_axis_x),
      semi_axis_y(shape.semi_axis_y),
      centre(shape.pose.position),
      local(frame_of(shape.pose)) {
  axis = {local.cos, local.sin};
}

PlacedTerrain::PlacedTerrain(const Terrain& shape) {
  for (std::size_t i = 0; i < shape.points.size(); ++i) {
    Point point{shape.points[i], {}, 0.0};
    if (i + 1 < shape.points.size()) {
      const Vector2 run = shape.points[i + 1] - shape.points[i];
      point.length = tumble::length(run);
      point.normal = turned_left((1.0 / point.length) * run);
    } else {
      point.normal = local.back().normal;
    }
    local.push_back(point);
  }
  points = local;
  blocks.resize((local.size() - 1 + k_block - 1) / k_block);
}

PlacedShape placed_shape(const Shape& shape) {
  return std::visit(
      [](const auto& s) -> PlacedShape {
        using S = std::decay_t<decltype(s)>;
        if constexpr (std::is_same_v<S, RoundedPolygon>) return PlacedPolygon(s);
        if constexpr (std::is_same_v<S, Ellipse>) return PlacedEllipse(s);
        if constexpr (std::is_same_v<S, HalfPlane>) return PlacedHalfPlane(s);
        if constexpr (std::is_same_v<S, Terrain>) return PlacedTerrain(s);
      },
      shape);
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

void place(PlacedEllipse& shape, const Frame& frame) {
  shape.position = frame.position;
  shape.centre = direction_to_world(frame, shape.local.position);
  shape.axis = direction_to_world(frame, {shape.local.cos, shape.local.sin});
}

void place(PlacedHalfPlane& shape, const Frame& frame) {
  shape.position = frame.position;
  shape.normal = direction_to_world(frame, shape.local_normal);
}

void place(PlacedTerrain& shape, const Frame& frame) {
  shape.position = frame.position;
  for (std::size_t i = 0; i < shape.points.size(); ++i) {
    shape.points[i].point = direction_to_world(frame, shape.local[i].point);
    shape.points[i].normal = direction_to_world(frame, shape.local[i].normal);
  }
  for (std::size_t k = 0; k < shape.blocks.size(); ++k) {
    const std::size_t first = k * PlacedTerrain::k_block;
    Box& box = shape.blocks[k];
    box = {shape.points[first].point, shape.points[first].point};
    for (std::size_t i = first; i <= first + PlacedTerrain::k_block && i < shape.points.size(); ++i) {
      box = united(box, {shape.points[i].point, shape.points[i].point});
    }
  }
}

void place(PlacedShape& shape, const Frame& frame) {
  std::visit([&](auto& s) { place(s, frame); }, shape);
}

Box bounding_box(const PlacedShape& shape, double margin) {
  return std::visit([&](const auto& s) { return bounding_box(s, margin); }, shape);
}

}  // namespace tumble
