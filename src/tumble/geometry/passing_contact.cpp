#include "tumble/geometry/passing_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "tumble/geometry/pair_contacts.hpp"

namespace tumble {
namespace {

struct Candidate {
  bool is_side_of_a = true;
  int side = -1;
  double gap = 0.0;
  double gap_after = -std::numeric_limits<double>::infinity();
};

// The farthest gap of `other` from a side of `own`; `offset` is the position of `other` minus that of `own`.
void try_sides(const PlacedPolygon& own, const PlacedPolygon& other, Vector2 offset, Vector2 way, double tolerance,
               bool is_a, Candidate& best) {
  for (int side = 0; side < own.sides(); ++side) {
    const PlacedPolygon::Corner& corner = own.corners[side];
    double lowest = std::numeric_limits<double>::infinity();
    for (const PlacedPolygon::Corner& vertex : other.corners)
      lowest = std::min(lowest, dot(corner.normal, offset + vertex.vertex));
    const double gap = lowest - corner.offset - own.rounding - other.rounding;
    const double gap_after = gap + dot(corner.normal, way);
    if (gap >= -tolerance && gap_after > best.gap_after) best = {is_a, side, gap, gap_after};
  }
}

// The lowest corner of `other` above the side; of two that are level, the one nearer to the middle of the side.
int corner_over(const PlacedPolygon& own, int side, const PlacedPolygon& other, Vector2 offset) {
  const PlacedPolygon::Corner& corner = own.corners[side];
  const Vector2 middle = 0.5 * (corner.vertex + own.corners[own.next(side)].vertex);
  int best = 0;
  double lowest = std::numeric_limits<double>::infinity(), nearest = lowest;
  for (int i = 0; i < other.count(); ++i) {
    const Vector2 place = offset + other.corners[i].vertex;
    const double height = dot(corner.normal, place), distance = length(place - middle);
    const double level = 1e-9 * (std::abs(lowest) + std::abs(height));
    if (height < lowest - level || (height <= lowest + level && distance < nearest)) {
      best = i;
      lowest = height;
      nearest = distance;
    }
  }
  return best;
}

}  // namespace

std::optional<ContactPoint> passing_contact(const PlacedShape& a, const PlacedShape& b, Vector2 way, double tolerance) {
  const auto *polygon_a = std::get_if<PlacedPolygon>(&a), *polygon_b = std::get_if<PlacedPolygon>(&b);
  if (!polygon_a || !polygon_b) return std::nullopt;
  const PlacedPolygon &placed_a = *polygon_a, &placed_b = *polygon_b;
  const Vector2 offset = placed_b.position - placed_a.position;
  Candidate best;
  try_sides(placed_a, placed_b, offset, way, tolerance, true, best);
  try_sides(placed_b, placed_a, -offset, -way, tolerance, false, best);
  if (best.side < 0) return std::nullopt;

  const PlacedPolygon &own = best.is_side_of_a ? placed_a : placed_b, &other = best.is_side_of_a ? placed_b : placed_a;
  const Vector2 normal = own.corners[best.side].normal;
  const int corner = corner_over(own, best.side, other, best.is_side_of_a ? offset : -offset);
  const Vector2 point_other = other.position + other.corners[corner].vertex - other.rounding * normal;
  const ContactPoint contact{normal,
                             point_other - best.gap * normal,
                             point_other,
                             best.gap,
                             std::numeric_limits<double>::infinity(),
                             other.rounding,
                             pair_feature(side_feature(best.side), corner_feature(corner))};
  return best.is_side_of_a ? contact : exchanged(contact);
}

}  // namespace tumble
