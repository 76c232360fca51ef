// Polygons and ellipses on terrain: their corners (lowest points) over its segments, and its ridges under their sides.
//
// What lies over a segment takes the normal of that segment, what is nearest to a ridge takes a normal between those of
// the two segments, and in a valley both segments hold. So nothing that slides along meets a corner that is not there.
// Everything is computed about the position of the body on the terrain.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tumble/geometry/pair_contacts.hpp"
#include "tumble/geometry/separating_direction.hpp"

namespace tumble {
namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();
// [rad] Two segments that bend less than this are one to the sides of a body that lies on both.
constexpr double k_flat = 1e-9;
// [rad] A side that lies on a slope and ends beyond its ridge rests on the ridge, although its normal may be just
// outside of those between the two segments. Less towards the ends of the side, or a corner that slides along would hit
// the ridge before it passes it.
constexpr double k_flush = 0.1;

// The ground near a body, with points about the position of that body.
class Ground {
 public:
  Ground(const PlacedTerrain& terrain, Vector2 offset) : terrain_(terrain), offset_(offset) {}

  int segments() const { return terrain_.segments(); }
  Vector2 point(int i) const { return terrain_.points[i].point + offset_; }
  Vector2 normal(int i) const { return terrain_.points[i].normal; }
  Vector2 along(int i) const { return turned_right(normal(i)); }
  double length(int i) const { return terrain_.points[i].length; }
  double height(int i, Vector2 p) const { return dot(normal(i), p - point(i)); }
  double run(int i, Vector2 p) const { return dot(along(i), p - point(i)); }

  // The normals at a point range from the first to the second, clockwise. At an end the ground falls off at right
  // angles.
  Vector2 normal_before(int i) const { return i > 0 ? normal(i - 1) : -along(0); }
  Vector2 normal_after(int i) const { return i < segments() ? normal(i) : along(segments()); }
  bool is_ridge(int i, double bend = 0.0) const { return cross(normal_before(i), normal_after(i)) < -bend; }
  bool is_valley(int i) const { return cross(normal_before(i), normal_after(i)) > 0.0; }
  // The normal between those two that is nearest to a direction.
  Vector2 nearest_normal(int i, Vector2 direction) const {
    if (cross(normal_before(i), direction) > 0.0) return normal_before(i);
    if (cross(normal_after(i), direction) < 0.0) return normal_after(i);
    return direction;
  }

  // Calls visit(i) for the segments whose boxes meet `box`, in order.
  template <class Visit>
  void for_segments_in(const Box& box, Visit&& visit) const {
    for (std::size_t k = 0; k < terrain_.blocks.size(); ++k) {
      const Box& block = terrain_.blocks[k];
      if (!overlap({block.low + offset_, block.high + offset_}, box)) continue;
      const int first = static_cast<int>(k) * PlacedTerrain::k_block;
      for (int i = first; i < std::min(first + PlacedTerrain::k_block, segments()); ++i) {
        const Vector2 p = point(i), q = point(i + 1);
        const Box of_segment{{std::min(p.x, q.x), std::min(p.y, q.y)}, {std::max(p.x, q.x), std::max(p.y, q.y)}};
        if (overlap(of_segment, box)) visit(i);
      }
    }
  }

  // Calls visit(j) for the ridges in `box`, ends included.
  template <class Visit>
  void for_ridges_in(const Box& box, double bend, Visit&& visit) const {
    const auto look_at = [&](int j) {
      const Vector2 p = point(j);
      if (overlap({p, p}, box) && is_ridge(j, bend)) visit(j);
    };
    for_segments_in(box, [&](int i) {
      look_at(i);
      if (i + 1 == segments()) look_at(i + 1);
    });
  }

 private:
  const PlacedTerrain& terrain_;
  Vector2 offset_;
};

Box box_around(Vector2 p, double margin) { return {{p.x - margin, p.y - margin}, {p.x + margin, p.y + margin}}; }

// What of the ground is nearest to a point: the inside of a segment, or a point of the ground.
struct Nearest {
  double distance = k_infinity;
  int segment = -1;
  int point = -1;
};

// `visit_over(i, height)` for each segment that the point is over, at a height >= 0.
template <class Visit>
Nearest nearest_ground(const Ground& ground, Vector2 p, double radius, Visit&& visit_over) {
  Nearest best;
  const auto take = [&](const Nearest& candidate) {
    if (candidate.distance < best.distance) best = candidate;
  };
  ground.for_segments_in(box_around(p, radius), [&](int i) {
    const double run = ground.run(i, p), height = ground.height(i, p);
    if (run <= 0.0) {
      take({length(p - ground.point(i)), -1, i});
    } else if (run >= ground.length(i)) {
      take({length(p - ground.point(i + 1)), -1, i + 1});
    } else {
      take({std::abs(height), i, -1});
      if (height >= 0.0) visit_over(i, height);
    }
  });
  return best;
}

// Appends contacts with a body at `position`; the normals given are those out of the ground.
class Appender {
 public:
  Appender(Vector2 position, double reach, ContactPoints& contacts)
      : position_(position), reach_(reach), contacts_(contacts) {}

  void append(Vector2 outward, Vector2 point_body, double gap, double radius_body, double radius_ground,
              std::uint32_t feature_body, std::uint32_t feature_ground) {
    if (!(gap <= reach_)) return;
    const Vector2 point = position_ + point_body;
    contacts_.push_back({-outward, point, point - gap * outward, gap, radius_body, radius_ground,
                         pair_feature(feature_body, feature_ground)});
  }

 private:
  Vector2 position_;
  double reach_;
  ContactPoints& contacts_;
};

// One corner, with its rounding, over the ground. Deeper than `depth` below it nothing is found.
void corner_over_ground(const Ground& ground, Vector2 corner, int index, double rounding, double reach, double depth,
                        Appender& out) {
  const auto append = [&](Vector2 outward, double height, double radius_ground, std::uint32_t feature) {
    out.append(outward, corner - rounding * outward, height - rounding, rounding, radius_ground, corner_feature(index),
               feature);
  };
  const auto over_segment = [&](int i, double height) {
    append(ground.normal(i), height, k_infinity, side_feature(i));
  };
  // In a valley the next segment holds before the corner has come to it: the line of that segment runs on in the
  // ground.
  const auto over_segment_and_valleys = [&](int i, double height) {
    over_segment(i, height);
    if (i > 0 && ground.is_valley(i) && ground.run(i - 1, corner) >= ground.length(i - 1)) {
      over_segment(i - 1, ground.height(i - 1, corner));
    }
    if (i + 1 < ground.segments() && ground.is_valley(i + 1) && ground.run(i + 1, corner) <= 0.0) {
      over_segment(i + 1, ground.height(i + 1, corner));
    }
  };
  const Nearest nearest = nearest_ground(ground, corner, rounding + std::max(reach, depth), over_segment_and_valleys);
  if (nearest.segment >= 0) {
    const double height = ground.height(nearest.segment, corner);
    if (height < 0.0 && -height <= depth) over_segment_and_valleys(nearest.segment, height);
    return;
  }
  if (nearest.point < 0) return;
  const int j = nearest.point;
  const Vector2 from_point = corner - ground.point(j);
  if (j == 0 || j == ground.segments()) {
    if (dot(from_point, ground.normal(j)) < 0.0) return;  // beyond the end and below: not in the ground
  } else if (ground.is_valley(j) || dot(from_point, ground.normal_before(j) + ground.normal_after(j)) < 0.0) {
    // Below a valley, or by round-off on the point itself.
    const auto is_over = [&](int i) {
      return ground.run(i, corner) > 0.0 && ground.run(i, corner) < ground.length(i) && ground.height(i, corner) >= 0.0;
    };
    if (nearest.distance > depth || is_over(j - 1) || is_over(j)) return;  // the latter: both are there already
    for (const int i : {j - 1, j}) over_segment(i, ground.height(i, corner));
    return;
  }
  const Vector2 outward =
      ground.nearest_normal(j, nearest.distance > 0.0 ? (1.0 / nearest.distance) * from_point
                                                      : normalized(ground.normal_before(j) + ground.normal_after(j)));
  append(outward, dot(outward, from_point), 0.0, corner_feature(j));
}

// A ridge under a side of the polygon.
void ridge_under_sides(const Ground& ground, int ridge, const PlacedPolygon& polygon, Appender& out) {
  const Vector2 p = ground.point(ridge);
  double highest = -k_infinity;
  int best = -1;
  for (int i = 0; i < polygon.sides(); ++i) {
    const PlacedPolygon::Corner& side = polygon.corners[i];
    const double height = dot(side.normal, p) - side.offset;
    if (height <= highest) continue;
    highest = height;
    best = i;
  }
  if (best < 0) return;
  // Where the ridge is inside, the nearest side that the ground allows; outside, the side that it is over.
  const bool is_inside = highest <= 0.0;
  const auto rests_on = [&](int i) {
    const PlacedPolygon::Corner &side = polygon.corners[i], &end = polygon.corners[polygon.next(i)];
    const Vector2 along = turned_left(side.normal);
    const double from_start = dot(along, p - side.vertex), to_end = dot(along, end.vertex - p);
    if (!(from_start > 0.0 && to_end > 0.0)) return false;
    const double flush = k_flat + k_flush * std::min(from_start, to_end) / (from_start + to_end);
    const Vector2 outward = -side.normal;
    return dot(outward, ground.normal_before(ridge) + ground.normal_after(ridge)) > 0.0 &&
           cross(ground.normal_before(ridge), outward) <= flush && cross(ground.normal_after(ridge), outward) >= -flush;
  };
  if (is_inside) {
    best = -1;
    highest = -k_infinity;
    for (int i = 0; i < polygon.sides(); ++i) {
      const double height = dot(polygon.corners[i].normal, p) - polygon.corners[i].offset;
      if (height > highest && rests_on(i)) {
        highest = height;
        best = i;
      }
    }
  } else if (!rests_on(best)) {
    return;
  }
  if (best < 0) return;
  const Vector2 outward = -polygon.corners[best].normal;
  out.append(outward, p + (highest - polygon.rounding) * outward, highest - polygon.rounding, k_infinity, 0.0,
             side_feature(best), corner_feature(ridge));
}

struct PlacedPoint {
  Vector2 point, position;
};
SupportPoint support(const PlacedPoint& p, Vector2) { return {p.point, 0.0, 0}; }
double least_radius(const PlacedPoint&) { return 0.0; }

// Of a box in the world, about a position.
Box about(const Box& box, Vector2 position) { return {box.low - position, box.high - position}; }

}  // namespace

void append_contacts(const PlacedPolygon& a, const PlacedTerrain& b, double reach, ContactPoints& contacts) {
  const Ground ground(b, b.position - a.position);
  Appender out(a.position, reach, contacts);
  const Box body = bounding_box(a, 0.0);
  const double depth = length(body.high - body.low);
  for (int k = 0; k < a.count(); ++k) {
    corner_over_ground(ground, a.corners[k].vertex, k, a.rounding, reach, depth, out);
  }
  ground.for_ridges_in(about(bounding_box(a, reach), a.position), k_flat,
                       [&](int j) { ridge_under_sides(ground, j, a, out); });
}

void append_contacts(const PlacedEllipse& a, const PlacedTerrain& b, double reach, ContactPoints& contacts) {
  const Ground ground(b, b.position - a.position);
  Appender out(a.position, reach, contacts);
  const Box body = bounding_box(a, 0.0);
  const double depth = length(body.high - body.low);
  const double round_off = 16.0 * std::numeric_limits<double>::epsilon() *
                           (depth + std::abs(b.position.x - a.position.x) + std::abs(b.position.y - a.position.y));

  ground.for_segments_in(about(bounding_box(a, std::max(reach, depth)), a.position), [&](int i) {
    const SupportPoint lowest = support(a, -ground.normal(i));
    const double run = ground.run(i, lowest.point), height = ground.height(i, lowest.point);
    if (run < -round_off || run > ground.length(i) + round_off || height < -depth) return;
    if (height < 0.0) {
      // Not if another part of the ground is nearer: the point is in the ground, but not under this segment.
      const Nearest nearest = nearest_ground(ground, lowest.point, depth, [](int, double) {});
      if (nearest.distance < -height - round_off) return;
    }
    out.append(ground.normal(i), lowest.point, height, lowest.radius, k_infinity, side_feature(0), side_feature(i));
  });

  ground.for_ridges_in(about(bounding_box(a, reach), a.position), k_flat, [&](int j) {
    const PlacedPoint ridge{ground.point(j), a.position};
    const Vector2 to_ridge = ridge.point - a.centre;
    const double distance = length(to_ridge);
    const Separation s = largest_separation(a, ridge, distance > 0.0 ? (1.0 / distance) * to_ridge : a.axis);
    const Vector2 outward = -s.normal;
    const bool is_normal = dot(outward, ground.normal_before(j) + ground.normal_after(j)) > 0.0 &&
                           cross(ground.normal_before(j), outward) <= k_flat &&
                           cross(ground.normal_after(j), outward) >= -k_flat;
    if (is_normal) out.append(outward, s.a.point, s.distance, s.a.radius, 0.0, side_feature(0), corner_feature(j));
  });
}

}  // namespace tumble
