#include "tumble/geometry/time_of_impact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tumble/geometry/pair_contacts.hpp"

namespace tumble {
namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();
constexpr double k_rounding = 1e-6;  // [-] of gaps, generously

// Of the farthest point from the position of the body. Ground counts as without end: it may be large, and need not be
// convex.
double radius_of(const PlacedPolygon& shape) {
  double square = 0.0;
  for (const PlacedPolygon::Corner& corner : shape.local) square = std::max(square, dot(corner.vertex, corner.vertex));
  return std::sqrt(square) + shape.rounding;
}
double radius_of(const PlacedEllipse& shape) {
  return length(shape.local.position) + std::max(shape.semi_axis_x, shape.semi_axis_y);
}
double radius_of(const PlacedHalfPlane&) { return k_infinity; }
double radius_of(const PlacedTerrain&) { return k_infinity; }
double radius_of(const PlacedShape& shape) {
  return std::visit([](const auto& s) { return radius_of(s); }, shape);
}

struct Mover {
  MovedShape& shape;
  const Pose& start;
  const Vector3& velocity;
  double radius = radius_of(shape.placed());

  void move_to(double time) {
    const Vector2 way{time * velocity[0], time * velocity[1]};
    shape.move_to({start.position + way, start.angle + time * velocity[2]});
  }
  double spin() const { return std::abs(velocity[2]); }
};

// No point of one shape comes nearer to the other faster than this.
double fastest_approach(const Mover& a, const Mover& b, double duration) {
  const Vector2 relative{b.velocity[0] - a.velocity[0], b.velocity[1] - a.velocity[1]};
  const double speed = length(relative);
  // Seen from a shape that turns, the other one is carried round its position. For ground that is the bound, with the
  // other no farther away than at the start or the end.
  const double farthest = length(b.start.position - a.start.position) + duration * speed;
  const double arm_a = std::min(a.radius, farthest + b.radius), arm_b = std::min(b.radius, farthest + a.radius);
  return speed + (a.spin() > 0.0 ? a.spin() * arm_a : 0.0) + (b.spin() > 0.0 ? b.spin() * arm_b : 0.0);
}

// How far a point moves along a direction, n . (r' - r) of r turned by `angle`, at least: its second derivative by the
// angle is -n . r', which is no less than -(n . r + |angle| |r|).
double least_advance(Vector2 n, Vector2 r, double angle) {
  const double highest = dot(n, r) + std::abs(angle) * length(r);
  return dot(n, turned_left(r)) * angle - 0.5 * angle * angle * std::max(highest, 0.0);
}

// The least of n . p over the points p of a shape about its position, after it has turned by up to `angle`: a bound.
double least_extent(const PlacedPolygon& shape, Vector2 n, double angle) {
  double least = k_infinity;
  for (const PlacedPolygon::Corner& corner : shape.corners)
    least = std::min(least, dot(n, corner.vertex) + least_advance(n, corner.vertex, angle));
  return least - shape.rounding;
}
double least_extent(const PlacedHalfPlane& shape, Vector2 n, double angle) {
  return n == -shape.normal && angle == 0.0 ? -shape.offset : -k_infinity;
}
double least_extent(const PlacedEllipse&, Vector2, double) { return -k_infinity; }
double least_extent(const PlacedTerrain&, Vector2, double) { return -k_infinity; }
double least_extent(const PlacedShape& shape, Vector2 n, double angle) {
  return std::visit([&](const auto& s) { return least_extent(s, n, angle); }, shape);
}

Vector2 position_of(const PlacedShape& shape) {
  return std::visit([](const auto& s) { return s.position; }, shape);
}

}  // namespace

// The heights of points along a direction are bounded by parabolas that bend down, and so is their distance: it lies
// above its chords.
double time_apart(const PlacedShape& a, const Vector3& velocity_a, const PlacedShape& b, const Vector3& velocity_b,
                  Vector2 direction, double duration, double distance) {
  constexpr int max_chords = 4;
  const double offset = dot(direction, position_of(b) - position_of(a));
  const double speed = dot(direction, Vector2{velocity_b[0] - velocity_a[0], velocity_b[1] - velocity_a[1]});
  const auto gap_after = [&](double time) {
    return offset + time * speed + least_extent(a, -direction, time * velocity_a[2]) +
           least_extent(b, direction, time * velocity_b[2]);
  };
  double apart = 0.0, gap = gap_after(0.0), late = duration, late_gap = gap_after(duration);
  if (!(gap > distance)) return 0.0;
  if (late_gap > distance) return duration;
  if (!(late_gap > -k_infinity)) return 0.0;
  for (int chord = 0; chord < max_chords; ++chord) {
    const double step = (late - apart) * ((gap - distance) / (gap - late_gap));
    apart += step;
    gap = gap_after(apart);
    if (!(gap > distance)) break;
  }
  return apart;
}

std::optional<Impact> time_of_impact(const Shape& a, const Pose& pose_a, const Vector3& velocity_a, const Shape& b,
                                     const Pose& pose_b, const Vector3& velocity_b, double duration, double distance) {
  MovedShape moved_a(a, pose_a), moved_b(b, pose_b);
  ContactPoints contacts;
  return time_of_impact(moved_a, pose_a, velocity_a, moved_b, pose_b, velocity_b, 0.0, duration, distance, contacts);
}

std::optional<Impact> time_of_impact(MovedShape& a, const Pose& pose_a, const Vector3& velocity_a, MovedShape& b,
                                     const Pose& pose_b, const Vector3& velocity_b, double earliest, double duration,
                                     double distance, ContactPoints& contacts) {
  Mover mover_a{a, pose_a, velocity_a}, mover_b{b, pose_b, velocity_b};
  const double approach = fastest_approach(mover_a, mover_b, duration);
  const double size = std::min(mover_a.radius, mover_b.radius);
  double time = earliest, reach = k_infinity;
  for (int step = 0;; ++step) {
    mover_a.move_to(time);
    mover_b.move_to(time);
    contacts.clear();
    append_sorted_contacts(a.placed(), b.placed(), reach, contacts);
    const auto closest =
        std::min_element(contacts.begin(), contacts.end(), [](const auto& c, const auto& d) { return c.gap < d.gap; });
    // Beyond the end of terrain, and below it, nothing is near; the body may come back from there.
    const double gap = closest == contacts.end() ? 0.5 * size : closest->gap;
    if (closest != contacts.end() && (gap <= distance || step == k_most_advances)) return Impact{time, *closest};
    if (!(approach > 0.0) || time >= duration || step >= k_most_advances) return std::nullopt;
    double advance = std::max(gap - 0.5 * distance, 0.5 * distance) / approach;
    reach = k_infinity;
    if (closest != contacts.end()) {
      const double left = duration - time;
      const double apart =
          time_apart(a.placed(), velocity_a, b.placed(), velocity_b, closest->normal, left, 0.5 * distance);
      if (apart >= left) return std::nullopt;
      advance = std::max(advance, apart);
      // The shapes part no faster than they approach each other: there is a contact this near, and no need for others.
      reach = (gap + advance * approach) * (1.0 + k_rounding);
    }
    time = std::min(duration, time + advance);
  }
}

}  // namespace tumble
