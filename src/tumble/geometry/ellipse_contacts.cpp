// Ellipses against each other, against rounded polygons and against half-planes.
#include <cmath>
#include <limits>

#include "tumble/geometry/pair_contacts.hpp"
#include "tumble/geometry/separating_direction.hpp"

namespace tumble {

namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();

// An order of two ellipses that does not depend on which came first.
bool precedes(const PlacedEllipse& a, const PlacedEllipse& b) {
  if (a.semi_axis_x != b.semi_axis_x) return a.semi_axis_x > b.semi_axis_x;
  if (a.semi_axis_y != b.semi_axis_y) return a.semi_axis_y > b.semi_axis_y;
  const Vector2 offset = (b.position - a.position) + (b.centre - a.centre);
  if (offset.y != 0.0) return offset.y > 0.0;
  if (offset.x != 0.0) return offset.x > 0.0;
  if (a.axis.y != b.axis.y) return a.axis.y < b.axis.y;
  return a.axis.x <= b.axis.x;
}

Vector2 from_centre_to_centre(const PlacedEllipse& a, const PlacedEllipse& b) {
  const Vector2 between = (b.position - a.position) + (b.centre - a.centre);
  const double distance = length(between);
  return distance > 0.0 ? (1.0 / distance) * between : a.axis;
}

}  // namespace

void append_contacts(const PlacedEllipse& a, const PlacedEllipse& b, double reach, ContactPoints& contacts) {
  const bool a_first = precedes(a, b);
  const PlacedEllipse &own = a_first ? a : b, &other = a_first ? b : a;
  const Separation s = largest_separation(own, other, from_centre_to_centre(own, other));
  if (!(s.distance <= reach)) return;
  // The tangential distance of the two points is round-off. It is shared, so that the points are one above the other.
  const Vector2 middle = 0.5 * (s.a.point + s.b.point), half = (0.5 * s.distance) * s.normal;
  const ContactPoint contact{s.normal,
                             own.position + (middle - half),
                             own.position + (middle + half),
                             s.distance,
                             s.a.radius,
                             s.b.radius,
                             pair_feature(side_feature(0), side_feature(0))};
  contacts.push_back(a_first ? contact : exchanged(contact));
}

namespace {

// The side of the polygon that the ellipse is farthest outside of: height of its lowest point over the side's line.
struct SideHeight {
  double height = -k_infinity;
  int side = -1;
  bool is_over_side = false;
  Vector2 point;  // of the ellipse, about its body
};

SideHeight highest_over_side(const PlacedEllipse& ellipse, const PlacedPolygon& polygon) {
  const Vector2 offset = ellipse.position - polygon.position;
  SideHeight best;
  for (int i = 0; i < polygon.sides(); ++i) {
    const PlacedPolygon::Corner& corner = polygon.corners[i];
    const Vector2 lowest = support(ellipse, -corner.normal).point;
    const double height = (dot(corner.normal, lowest) + dot(corner.normal, offset)) - corner.offset;
    if (height > best.height) best = {height, i, false, lowest};
  }
  if (best.side < 0) return best;
  const Vector2 along = turned_left(polygon.corners[best.side].normal), foot = best.point + offset;
  best.is_over_side = dot(along, foot - polygon.corners[best.side].vertex) >= 0.0 &&
                      dot(along, foot - polygon.corners[polygon.next(best.side)].vertex) <= 0.0;
  return best;
}

}  // namespace

void append_contacts(const PlacedEllipse& a, const PlacedPolygon& b, double reach, ContactPoints& contacts) {
  const SideHeight over = highest_over_side(a, b);
  if (over.height - b.rounding > reach) return;
  const auto append = [&](Vector2 normal, Vector2 point, double height, double radius, double radius_b,
                          std::uint32_t feature_b) {
    const double gap = height - b.rounding;
    if (!(gap <= reach)) return;
    const Vector2 point_a = a.position + point;
    contacts.push_back(
        {normal, point_a, point_a + gap * normal, gap, radius, radius_b, pair_feature(side_feature(0), feature_b)});
  };
  const auto append_side = [&](int side, double height) {
    const Vector2 normal = -b.corners[side].normal;
    const SupportPoint lowest = support(a, normal);
    append(normal, lowest.point, height, lowest.radius, k_infinity, side_feature(side));
  };
  // Apart, with the lowest point over the side itself, or over a side less deep than any other maximum can be.
  const double layer = least_radius(a);
  if (over.is_over_side && over.height > -layer) return append_side(over.side, over.height);

  const Vector2 guess = over.side >= 0 ? -b.corners[over.side].normal : a.axis;
  const Separation s = largest_separation(a, b, guess);
  constexpr double k_round_off = 16.0 * std::numeric_limits<double>::epsilon();
  if (over.is_over_side && over.height >= s.distance - k_round_off * s.size) return append_side(over.side, over.height);
  append(s.normal, s.a.point, s.distance, s.a.radius, b.rounding, corner_feature(s.b.corner));
}

void append_contacts(const PlacedEllipse& a, const PlacedHalfPlane& b, double reach, ContactPoints& contacts) {
  const SupportPoint lowest = support(a, -b.normal);
  const double gap = dot(b.normal, lowest.point) + (dot(b.normal, a.position - b.position) - b.offset);
  if (!(gap <= reach)) return;
  const Vector2 point = a.position + lowest.point;
  contacts.push_back({-b.normal, point, point - gap * b.normal, gap, lowest.radius, k_infinity,
                      pair_feature(side_feature(0), side_feature(0))});
}

}  // namespace tumble
