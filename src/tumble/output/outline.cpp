#include "tumble/output/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>

namespace tumble::output {
namespace {

constexpr double k_flatness = 0.06;  // [px] between an arc and the lines that stand for it
constexpr int k_most_lines = 2000;   // of one arc

constexpr double k_smallest_dot = 1.2;  // [px]
constexpr double k_largest_dot = 0.12;  // of the body

// Lines that stand for an arc of `angle` [rad].
int count_lines(double radius, double angle) {
  if (!(radius > k_flatness)) return 1;
  const double step = 2.0 * std::acos(1.0 - k_flatness / radius);
  return static_cast<int>(std::min(std::ceil(angle / step), static_cast<double>(k_most_lines)));
}

void add_arc(std::vector<Vector2>& points, Vector2 centre, double radius, double from, double angle) {
  const int lines = std::max(1, count_lines(radius, angle));
  for (int i = 0; i <= lines; ++i) {
    const double at = from + angle * i / lines;
    points.push_back(centre + radius * Vector2{std::cos(at), std::sin(at)});
  }
}

PartOutline outline(const RoundedPolygon& shape, const View& view, const Body&) {
  const double scale = view.scale;
  constexpr double k_turn = 2.0 * std::numbers::pi;
  PartOutline outline;
  const std::size_t n = shape.vertices.size();
  const double radius = scale * shape.rounding;
  if (n == 2 && radius == 0.0) outline.kind = LineKind::wall;
  const auto direction = [&](std::size_t i) {  // of the outward normal of the side that leaves vertex i
    const Vector2 side = shape.vertices[(i + 1) % n] - shape.vertices[i % n];
    return std::atan2(-side.x, side.y);
  };
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2 vertex = scale * shape.vertices[i];
    if (radius == 0.0) {
      outline.points.push_back(vertex);
    } else if (n == 1) {
      add_arc(outline.points, vertex, radius, 0.0, k_turn);
    } else {
      const double from = direction(i + n - 1);
      double angle = direction(i) - from;
      if (angle < 0.0) angle += k_turn;
      add_arc(outline.points, vertex, radius, from, angle);
    }
  }
  return outline;
}

PartOutline outline(const Ellipse& shape, const View& view, const Body&) {
  const double scale = view.scale;
  PartOutline outline;
  const Frame frame = frame_of(shape.pose);
  const int lines =
      std::max(8, count_lines(scale * std::max(shape.semi_axis_x, shape.semi_axis_y), 2.0 * std::numbers::pi));
  for (int i = 0; i < lines; ++i) {
    const double at = 2.0 * std::numbers::pi * i / lines;
    const Vector2 point = {shape.semi_axis_x * std::cos(at), shape.semi_axis_y * std::sin(at)};
    outline.points.push_back(scale * point_to_world(frame, point));
  }
  return outline;
}

PartOutline outline(const Terrain& shape, const View& view, const Body&) {
  PartOutline outline;
  outline.kind = LineKind::ground;
  for (const Vector2 point : shape.points) outline.points.push_back(view.scale * point);
  return outline;
}

PartOutline outline(const HalfPlane& shape, const View& view, const Body& body) {
  PartOutline outline;
  outline.kind = LineKind::ground;
  // About the point of the boundary that is nearest to the middle of the picture.
  const Vector2 middle = point_to_local(frame_of(body.pose), view.middle);
  const Vector2 foot = view.scale * (middle - (dot(shape.normal, middle) - shape.offset) * shape.normal);
  const Vector2 reach = (view.area.width + view.area.height) * turned_right(shape.normal);
  outline.points = {foot - reach, foot + reach};
  return outline;
}

Vector2 mean(const std::vector<Vector2>& points) {
  Vector2 sum;
  for (const Vector2 point : points) sum = sum + point;
  return 1.0 / static_cast<double>(points.size()) * sum;
}

Mark mark_of(const RoundedPolygon& shape, double scale) {
  const Vector2 first = scale * shape.vertices[0];
  if (shape.vertices.size() == 1) return {first, first + Vector2{scale * shape.rounding, 0.0}, 0.0};
  const Vector2 centre = scale * mean(shape.vertices);
  constexpr double k_place = 0.56;  // from the centre to the first corner
  const Vector2 place = centre + k_place * (first - centre);
  // In a narrow shape the dot is as wide as its sides leave room.
  double room = length(first - centre);
  const std::size_t n = shape.vertices.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2 a = scale * shape.vertices[i];
    const Vector2 side = scale * shape.vertices[(i + 1) % n] - a;
    room = std::min(room, cross(side, place - a) / length(side) + scale * shape.rounding);
  }
  return {place, place, std::max(0.39 * room, k_smallest_dot)};
}

Mark mark_of(const Ellipse& shape, double scale) {
  const Frame frame = frame_of(shape.pose);
  const Vector2 end =
      shape.semi_axis_x >= shape.semi_axis_y ? Vector2{shape.semi_axis_x, 0.0} : Vector2{0.0, shape.semi_axis_y};
  return {scale * shape.pose.position, scale * point_to_world(frame, end), 0.0};
}

Mark mark_of(const Terrain&, double) { return {}; }
Mark mark_of(const HalfPlane&, double) { return {}; }

double coordinate(Point p, bool along_x) { return along_x ? p.x : p.y; }

// The part of a closed line where sign * coordinate <= sign * bound.
std::vector<Point> clipped_by(const std::vector<Point>& points, bool along_x, double sign, double bound) {
  std::vector<Point> inside;
  const auto depth = [&](Point p) { return sign * (coordinate(p, along_x) - bound); };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point a = points[i], b = points[(i + 1) % points.size()];
    const double depth_a = depth(a), depth_b = depth(b);
    if (depth_a <= 0.0) inside.push_back(a);
    if ((depth_a < 0.0 && depth_b > 0.0) || (depth_a > 0.0 && depth_b < 0.0)) {
      const double share = depth_a / (depth_a - depth_b);
      inside.push_back({a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)});
    }
  }
  return inside;
}

}  // namespace

BodyOutline outline_of(const Body& body, const View& view) {
  BodyOutline result;
  for (const Part& part : body.parts) {
    PartOutline lines = std::visit([&](const auto& shape) { return outline(shape, view, body); }, part.shape);
    lines.surface_speed = view.scale * part.surface_speed;
    for (const Vector2 point : lines.points) result.radius = std::max(result.radius, length(point));
    result.parts.push_back(std::move(lines));
  }
  result.mark = std::visit([&](const auto& shape) { return mark_of(shape, view.scale); }, body.parts[0].shape);
  if (result.mark.radius > 0.0) {
    result.mark.radius = std::min(result.mark.radius, std::max(k_largest_dot * result.radius, k_smallest_dot));
  }
  return result;
}

std::vector<Point> clipped(std::vector<Point> points, const Area& area) {
  points = clipped_by(points, true, 1.0, area.right());
  points = clipped_by(points, true, -1.0, area.left);
  points = clipped_by(points, false, 1.0, area.bottom());
  return clipped_by(points, false, -1.0, area.top);
}

bool clip_line(Point& a, Point& b, const Area& area) {
  double from = 0.0, to = 1.0;
  const double dx = b.x - a.x, dy = b.y - a.y;
  const auto cut = [&](double slope, double room) {  // slope t <= room [Liang & Barsky 1984]
    if (slope > 0.0) to = std::min(to, room / slope);
    if (slope < 0.0) from = std::max(from, room / slope);
    return slope != 0.0 || room >= 0.0;
  };
  const bool is_inside = cut(-dx, a.x - area.left) && cut(dx, area.right() - a.x) && cut(-dy, a.y - area.top) &&
                         cut(dy, area.bottom() - a.y) && from <= to;
  if (!is_inside) return false;
  const Point start = a;
  a = {start.x + from * dx, start.y + from * dy};
  b = {start.x + to * dx, start.y + to * dy};
  return true;
}

}  // namespace tumble::output
