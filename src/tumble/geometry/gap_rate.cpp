#include "tumble/geometry/gap_rate.hpp"

#include <cmath>

namespace tumble {
namespace {

Vector2 velocity_of(const Motion& body, Vector2 point) {
  return Vector2{body.velocity[0], body.velocity[1]} + body.velocity[2] * turned_left(point - body.position);
}

Vector2 acceleration_of(const Motion& body, Vector2 point) {
  return -(body.velocity[2] * body.velocity[2]) * (point - body.position);
}

// Of the distance of `centre`, fixed in `other`, from the side of `own` at `point`; `distance` is n . (centre - point).
double curvature_over_side(const Motion& own, Vector2 point, Vector2 normal, const Motion& other, Vector2 centre,
                           double distance) {
  const double omega = own.velocity[2];
  const Vector2 velocity = velocity_of(other, centre) - velocity_of(own, point);
  const Vector2 acceleration = acceleration_of(other, centre) - acceleration_of(own, point);
  // n' = omega turned_left(n), n'' = -omega^2 n
  return dot(normal, acceleration) + 2.0 * omega * dot(turned_left(normal), velocity) - omega * omega * distance;
}

}  // namespace

double gap_rate(const ContactPoint& contact, const Motion& a, const Motion& b) {
  return dot(contact.normal, velocity_of(b, contact.point_b) - velocity_of(a, contact.point_a));
}

double gap_curvature(const ContactPoint& contact, const Motion& a, const Motion& b) {
  const Vector2 n = contact.normal;
  const bool is_flat = std::isinf(contact.radius_a) || std::isinf(contact.radius_b);
  if (is_flat && a.velocity[2] == 0.0 && b.velocity[2] == 0.0) return 0.0;  // nothing turns
  if (std::isinf(contact.radius_a)) {
    const double radius = std::isinf(contact.radius_b) ? 0.0 : contact.radius_b;
    return curvature_over_side(a, contact.point_a, n, b, contact.point_b + radius * n, contact.gap + radius);
  }
  if (std::isinf(contact.radius_b)) {
    const Vector2 centre = contact.point_a - contact.radius_a * n;
    return curvature_over_side(b, contact.point_b, -n, a, centre, contact.gap + contact.radius_a);
  }
  const Vector2 centre_a = contact.point_a - contact.radius_a * n, centre_b = contact.point_b + contact.radius_b * n;
  const double distance = contact.gap + contact.radius_a + contact.radius_b;
  const double slip = dot(turned_left(n), velocity_of(b, centre_b) - velocity_of(a, centre_a));
  const double acceleration = dot(n, acceleration_of(b, centre_b) - acceleration_of(a, centre_a));
  return acceleration + (distance != 0.0 ? slip * slip / distance : 0.0);
}

}  // namespace tumble
