#include "tumble/geometry/time_of_impact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tumble/geometry/pair_contacts.hpp"

namespace tumble {
namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();

// Of the farthest point from the position of the body. Ground counts as without end: it may be large, and need not be
// convex.
double radius_of(const PlacedPolygon& shape) {
  double square = 0.0;
  for (const PlacedPolygon::Corner& corner : shape.corners)
    square = std::max(square, dot(corner.vertex, corner.vertex));
  return std::sqrt(square) + shape.rounding;
}
double radius_of(const PlacedEllipse& shape) {
  return length(shape.centre) + std::max(shape.semi_axis_x, shape.semi_axis_y);
}
double radius_of(const PlacedHalfPlane&) { return k_infinity; }
double radius_of(const PlacedTerrain&) { return k_infinity; }
double radius_of(const PlacedShape& shape) {
  return std::visit([](const auto& s) { return radius_of(s); }, shape);
}

struct Mover {
  PlacedShape shape;
  Pose start;
  Vector3 velocity;
  double radius;

  Mover(const Shape& s, const Pose& pose, const Vector3& v)
      : shape(placed_shape(s)), start(pose), velocity(v), radius(radius_of(shape)) {}

  void move_to(double time) {
    const Vector2 way{time * velocity[0], time * velocity[1]};
    place(shape, frame_of({start.position + way, start.angle + time * velocity[2]}));
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

}  // namespace

std::optional<Impact> time_of_impact(const Shape& a, const Pose& pose_a, const Vector3& velocity_a, const Shape& b,
                                     const Pose& pose_b, const Vector3& velocity_b, double duration, double distance) {
  Mover mover_a(a, pose_a, velocity_a), mover_b(b, pose_b, velocity_b);
  const double approach = fastest_approach(mover_a, mover_b, duration);
  const double size = std::min(mover_a.radius, mover_b.radius);
  ContactPoints contacts;
  double time = 0.0;
  for (int step = 0;; ++step) {
    mover_a.move_to(time);
    mover_b.move_to(time);
    contacts.clear();
    append_sorted_contacts(mover_a.shape, mover_b.shape, k_infinity, contacts);
    const auto closest =
        std::min_element(contacts.begin(), contacts.end(), [](const auto& c, const auto& d) { return c.gap < d.gap; });
    // Beyond the end of terrain, and below it, nothing is near; the body may come back from there.
    const double gap = closest == contacts.end() ? 0.5 * size : closest->gap;
    if (closest != contacts.end() && (gap <= distance || step == k_most_advances)) return Impact{time, *closest};
    if (!(approach > 0.0) || time >= duration || step >= k_most_advances) return std::nullopt;
    time = std::min(duration, time + std::max(gap - 0.5 * distance, 0.5 * distance) / approach);
  }
}

}  // namespace tumble
