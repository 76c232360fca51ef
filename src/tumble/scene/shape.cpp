#include "tumble/scene/shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "tumble/math/format.hpp"
#include "tumble/scene/check.hpp"

namespace tumble {
namespace {

constexpr double k_pi = 3.14159265358979323846;

// A corner whose edges make an angle with a smaller sine than this is none: it lies within 1e-9 of an edge from the
// line through its neighbours, and rounding of the coordinates could turn it inside out.
constexpr double k_least_turn = 1e-9;
// An edge shorter than this times the largest coordinate keeps less than 7 digits of its direction.
constexpr double k_least_edge = 1e-9;

[[noreturn]] void refuse(const std::string& text) { throw std::invalid_argument(text); }

void check_points(const char* field, const std::vector<Vector2>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    require_in(k_coordinate_range, tumble::format("{}[{}].x", field, i), points[i].x);
    require_in(k_coordinate_range, tumble::format("{}[{}].y", field, i), points[i].y);
  }
}

double largest_coordinate(const std::vector<Vector2>& points) {
  double largest = 0.0;
  for (const Vector2 p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  return largest;
}

void check_edges(const char* field, const std::vector<Vector2>& points, bool is_closed) {
  const double least = k_least_edge * largest_coordinate(points);
  const std::size_t n = points.size();
  for (std::size_t i = 0; i + (is_closed ? 0 : 1) < n; ++i) {
    const std::size_t next = (i + 1) % n;
    if (length(points[next] - points[i]) > least) continue;
    refuse(tumble::format("{0}[{1}]: must be farther than {2} m from {0}[{3}], got ({4}, {5})", field, next, least, i,
                          points[next].x, points[next].y));
  }
}

// Twice the area, relative to the first vertex.
double doubled_area(const std::vector<Vector2>& vertices) {
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
    sum += cross(vertices[i] - vertices[0], vertices[i + 1] - vertices[0]);
  }
  return sum;
}

void check_convex(const std::vector<Vector2>& vertices) {
  const std::size_t n = vertices.size();
  if (doubled_area(vertices) < 0.0) {
    refuse("vertices: must run counter-clockwise, got clockwise; write them in the opposite order");
  }
  // The directions of the edges of a convex polygon go round once, so that they leave the lower half turn once.
  int rounds = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2 before = vertices[i] - vertices[(i + n - 1) % n];
    const Vector2 after = vertices[(i + 1) % n] - vertices[i];
    const double turn = cross(before, after) / (length(before) * length(after));
    if (!(turn >= -k_least_turn)) {
      refuse(tumble::format(
          "vertices[{}]: must be a convex corner, got a reflex one at ({}, {}); write a concave shape as "
          "several convex parts",
          i, vertices[i].x, vertices[i].y));
    }
    if (turn <= k_least_turn) {
      refuse(tumble::format("vertices[{}]: must not lie on the line through its neighbours, got ({}, {}); leave it out",
                            i, vertices[i].x, vertices[i].y));
    }
    const auto is_upper = [](Vector2 e) { return e.y > 0.0 || (e.y == 0.0 && e.x > 0.0); };
    rounds += !is_upper(before) && is_upper(after);
  }
  if (rounds != 1) refuse(tumble::format("vertices: must go round once, got {} times: the edges cross", rounds));
}

void check(const RoundedPolygon& polygon) {
  require_count("vertices", polygon.vertices.size(), 1, k_max_vertices);
  check_points("vertices", polygon.vertices);
  require_in(k_rounding_range, "rounding", polygon.rounding);
  if (polygon.rounding > 0.0 || polygon.vertices.size() == 1) {
    require_in(k_size_range, "rounding", polygon.rounding);
  }
  if (polygon.vertices.size() == 1) return;
  if (polygon.rounding == 0.0 && largest_coordinate(polygon.vertices) < k_size_range.low) {
    refuse(tumble::format("vertices: must reach {} m in x or y, got less", k_size_range.low));
  }
  check_edges("vertices", polygon.vertices, polygon.vertices.size() > 2);
  if (polygon.vertices.size() > 2) check_convex(polygon.vertices);
}

void check(const Pose& pose) {
  require_in(k_coordinate_range, "pose.position.x", pose.position.x);
  require_in(k_coordinate_range, "pose.position.y", pose.position.y);
  require_in(k_angle_range, "pose.angle", pose.angle);
}

void check(const Ellipse& ellipse) {
  require_in(k_size_range, "semi_axis_x", ellipse.semi_axis_x);
  require_in(k_size_range, "semi_axis_y", ellipse.semi_axis_y);
  check(ellipse.pose);
  const auto [shorter, longer] = std::minmax(ellipse.semi_axis_x, ellipse.semi_axis_y);
  if (longer > k_max_ellipse_ratio * shorter) {
    refuse(tumble::format("semi_axis_x: must be within a factor {} of semi_axis_y, got {} m and {} m",
                          k_max_ellipse_ratio, ellipse.semi_axis_x, ellipse.semi_axis_y));
  }
}

void check(const HalfPlane& half_plane) {
  const double size = length(half_plane.normal);
  if (!(std::abs(size - 1.0) <= k_unit_length_tolerance)) {
    refuse(tumble::format("normal: must have length 1, got ({}, {}) of length {}", half_plane.normal.x,
                          half_plane.normal.y, size));
  }
  require_in(k_coordinate_range, "offset", half_plane.offset);
}

void check(const Terrain& terrain) {
  const std::vector<Vector2>& points = terrain.points;
  require_count("points", points.size(), 2, k_max_terrain_points);
  check_points("points", points);
  check_edges("points", points, false);
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Vector2 before = points[i] - points[i - 1];
    const Vector2 after = points[i + 1] - points[i];
    if (dot(before, after) > 0.0) continue;
    if (std::abs(cross(before, after)) > k_least_turn * length(before) * length(after)) continue;
    refuse(tumble::format("points[{}]: must not turn straight back, got ({}, {})", i, points[i].x, points[i].y));
  }
}

// Sums over pieces of an area, about a point near them.
struct Moments {
  double area = 0.0;
  Vector2 first;        // integral of p
  double second = 0.0;  // integral of |p|^2
};

void add_core(Moments& sum, const std::vector<Vector2>& vertices) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vector2 a = vertices[i];
    const Vector2 b = vertices[(i + 1) % vertices.size()];
    const double doubled = cross(a, b);
    sum.area += doubled / 2.0;
    sum.first = sum.first + doubled / 6.0 * (a + b);
    sum.second += doubled / 12.0 * (dot(a, a) + dot(a, b) + dot(b, b));
  }
}

// The angle in [0, pi] with this sine and cosine, by iteration on the own sin_cos: atan2 has other bits on other
// machines. The error e becomes e^3 / 6 each time; it starts below 0.58.
double angle_of(double sine, double cosine) {
  double angle = cosine >= 0.0 ? sine : k_pi - sine;
  for (int i = 0; i < 4; ++i) {
    const SinCos at = sin_cos(angle);
    angle += sine * at.cos - cosine * at.sin;
  }
  return angle;
}

// The strip of width r along the outside of each edge, and the sector of radius r between two strips.
void add_rounding(Moments& sum, const std::vector<Vector2>& vertices, double r) {
  const std::size_t n = vertices.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2 at = vertices[i];
    const Vector2 before = at - vertices[(i + n - 1) % n];
    const Vector2 after = vertices[(i + 1) % n] - at;
    const double edge = length(after);
    const Vector2 direction_before = 1.0 / length(before) * before;
    const Vector2 direction = 1.0 / edge * after;

    const double strip = edge * r;
    const Vector2 middle = at + 0.5 * after + r / 2.0 * turned_right(direction);
    sum.area += strip;
    sum.first = sum.first + strip * middle;
    sum.second += strip * (dot(middle, middle) + (edge * edge + r * r) / 12.0);

    // The outward normal runs from that of the edge before to that of the edge after; the integral of it over the angle
    // is the difference of the directions, turned back by 180 degrees.
    const double angle = angle_of(cross(direction_before, direction), dot(direction_before, direction));
    const double sector = r * r * angle / 2.0;
    const Vector2 first = r * r * r / 3.0 * (direction_before - direction);
    sum.area += sector;
    sum.first = sum.first + sector * at + first;
    sum.second += sector * dot(at, at) + 2.0 * dot(at, first) + sector * r * r / 2.0;
  }
}

AreaMoments moments(const RoundedPolygon& polygon) {
  const double r = polygon.rounding;
  const std::size_t n = polygon.vertices.size();
  if (n == 0) return {};
  if (n == 1) return {k_pi * r * r, polygon.vertices[0], k_pi * r * r * r * r / 2.0};
  Vector2 middle;
  for (const Vector2 vertex : polygon.vertices) middle = middle + vertex;
  middle = 1.0 / static_cast<double>(n) * middle;
  std::vector<Vector2> vertices = polygon.vertices;
  for (Vector2& vertex : vertices) vertex = vertex - middle;
  if (n == 2 && r == 0.0) return {0.0, middle, 0.0};

  Moments sum;
  if (n > 2) add_core(sum, vertices);
  if (r > 0.0) add_rounding(sum, vertices, r);
  const Vector2 centroid = 1.0 / sum.area * sum.first;
  return {sum.area, middle + centroid, sum.second - dot(centroid, sum.first)};
}

AreaMoments moments(const Ellipse& ellipse) {
  const double a = ellipse.semi_axis_x;
  const double b = ellipse.semi_axis_y;
  const double area = k_pi * a * b;
  return {area, ellipse.pose.position, area * (a * a + b * b) / 4.0};
}

AreaMoments moments(const HalfPlane&) { return {}; }
AreaMoments moments(const Terrain&) { return {}; }

RoundedPolygon moved_shape(RoundedPolygon polygon, const Frame& frame, double) {
  for (Vector2& vertex : polygon.vertices) vertex = point_to_world(frame, vertex);
  return polygon;
}

Ellipse moved_shape(Ellipse ellipse, const Frame& frame, double angle) {
  ellipse.pose = {point_to_world(frame, ellipse.pose.position), ellipse.pose.angle + angle};
  return ellipse;
}

HalfPlane moved_shape(const HalfPlane& half_plane, const Frame& frame, double) {
  const Vector2 normal = direction_to_world(frame, half_plane.normal);
  return {normal, half_plane.offset + dot(normal, frame.position)};
}

Terrain moved_shape(Terrain terrain, const Frame& frame, double) {
  for (Vector2& point : terrain.points) point = point_to_world(frame, point);
  return terrain;
}

}  // namespace

RoundedPolygon disc(double radius, Vector2 center) {
  require_in(k_size_range, "radius", radius);
  RoundedPolygon shape{{center}, radius};
  check(shape);
  return shape;
}

RoundedPolygon rectangle(double width, double height, double rounding) {
  require_in(k_size_range, "width", width);
  require_in(k_size_range, "height", height);
  if (!(rounding >= 0.0 && 2.0 * rounding <= std::min(width, height))) {
    refuse(tumble::format("rounding: must be in [0, {}] m, half of the shorter side, got {}",
                          std::min(width, height) / 2.0, rounding));
  }
  const double x = width / 2.0 - rounding;
  const double y = height / 2.0 - rounding;
  RoundedPolygon shape{{}, rounding};
  if (x == 0.0 && y == 0.0) {
    shape.vertices = {{0.0, 0.0}};
  } else if (y == 0.0) {
    shape.vertices = {{-x, 0.0}, {x, 0.0}};
  } else if (x == 0.0) {
    shape.vertices = {{0.0, -y}, {0.0, y}};
  } else {
    shape.vertices = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  }
  check(shape);
  return shape;
}

RoundedPolygon square(double side, double rounding) {
  require_in(k_size_range, "side", side);
  return rectangle(side, side, rounding);
}

RoundedPolygon regular_polygon(int corners, double circumradius, double rounding) {
  if (corners < 3 || corners > static_cast<int>(k_max_vertices)) {
    refuse(tumble::format("corners: must be in [3, {}], got {}", k_max_vertices, corners));
  }
  require_in(k_size_range, "circumradius", circumradius);
  if (!(rounding >= 0.0 && rounding < circumradius)) {
    refuse(tumble::format("rounding: must be in [0, {}) m, the circumradius, got {}", circumradius, rounding));
  }
  const double radius = circumradius - rounding;
  RoundedPolygon shape{std::vector<Vector2>(static_cast<std::size_t>(corners)), rounding};
  // The lowest side is level. The left half is the mirror image of the right one, bit for bit, and for an even number
  // the upper half that of the lower one, so that the centroid is the origin.
  const auto place = [&](int k, double x, double y) { shape.vertices[static_cast<std::size_t>(k)] = {x, y}; };
  for (int k = 0; 2 * k < corners; ++k) {
    const int above = corners / 2 - 1 - k;
    if (corners % 2 == 0 && above < k) break;
    const SinCos from_below = sin_cos((2 * k + 1) * k_pi / corners);
    const bool is_middle = corners % 2 == 0 ? above == k : 2 * k + 1 == corners;
    const double x = corners % 2 == 1 && is_middle ? 0.0 : radius * from_below.sin;
    const double y = corners % 2 == 0 && is_middle ? 0.0 : -radius * from_below.cos;
    place(corners - 1 - k, -x, y);
    place(k, x, y);
    if (corners % 2 == 0) {
      place(above, x, -y);
      place(corners - 1 - above, -x, -y);
    }
  }
  check(shape);
  return shape;
}

RoundedPolygon capsule(double length, double radius) {
  require_in(k_size_range, "length", length);
  require_in(k_size_range, "radius", radius);
  RoundedPolygon shape{{{-length / 2.0, 0.0}, {length / 2.0, 0.0}}, radius};
  check(shape);
  return shape;
}

RoundedPolygon segment(Vector2 from, Vector2 to) {
  RoundedPolygon shape{{from, to}, 0.0};
  check(shape);
  return shape;
}

Ellipse ellipse(double semi_axis_x, double semi_axis_y) {
  const Ellipse shape{semi_axis_x, semi_axis_y, {}};
  check(shape);
  return shape;
}

HalfPlane half_plane(Vector2 normal, double offset) {
  require_in(k_coordinate_range, "normal[0]", normal.x);
  require_in(k_coordinate_range, "normal[1]", normal.y);
  if (length(normal) < k_size_range.low) refuse("normal: must be a vector other than 0");
  // One that has length 1 keeps its bits.
  if (std::abs(length(normal) - 1.0) > k_unit_length_tolerance) normal = 1.0 / length(normal) * normal;
  const HalfPlane shape{normal, offset};
  check(shape);
  return shape;
}

Shape moved(const Shape& shape, const Pose& pose) {
  return std::visit([&](const auto& s) -> Shape { return moved_shape(s, frame_of(pose), pose.angle); }, shape);
}

void validate(const Shape& shape) {
  std::visit([](const auto& s) { check(s); }, shape);
}

AreaMoments area_moments(const Shape& shape) {
  return std::visit([](const auto& s) { return moments(s); }, shape);
}

}  // namespace tumble
