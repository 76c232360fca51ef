#include "first_flight.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "overlap.hpp"

namespace tumble::bench {
namespace {

Pose in_flight(const Pose& from, const Vector3& velocity, double gravity, double time) {
  return {{from.position.x + velocity[0] * time, from.position.y + velocity[1] * time - 0.5 * gravity * time * time},
          from.angle + velocity[2] * time};
}

// The lowest point of an outline in the world frame.
Vector2 lowest_point(const Outline& outline) {
  const auto is_lower = [](Vector2 a, Vector2 b) { return a.y < b.y; };
  const Vector2 vertex = *std::min_element(outline.vertices.begin(), outline.vertices.end(), is_lower);
  return {vertex.x, vertex.y - outline.radius};
}

// When `height` first falls below 0 between two times: searched in steps too short for a corner to dip in and out
// unseen by more than a micrometre at the speeds here, then halved to the last bit.
std::optional<double> time_of_touch(const std::function<double(double)>& height, double from, double to) {
  constexpr double search_step = 1e-4;
  for (double late = from + search_step; late < to; late += search_step) {
    if (height(late) >= 0.0) continue;
    double early = late - search_step;
    for (double middle = 0.5 * (early + late); early < middle && middle < late; middle = 0.5 * (early + late)) {
      (height(middle) < 0.0 ? late : early) = middle;
    }
    return early;
  }
  return std::nullopt;
}

// The velocity after an impact at `point` on the ground. With the inverse of the inertia A = J M^-1 J^T in (n, t).
Vector3 after_impact(const WorldBody& body, Vector2 centre, const Vector3& v, Vector2 point, const World& world) {
  const Vector2 r = point - centre;
  const double inverse_mass = 1.0 / body.mass, inverse_inertia = 1.0 / body.moment_of_inertia;
  const double a_nn = inverse_mass + r.x * r.x * inverse_inertia;
  const double a_tt = inverse_mass + r.y * r.y * inverse_inertia;
  const double a_nt = -r.x * r.y * inverse_inertia;
  const double u_n = v[1] + r.x * v[2], u_t = v[0] - r.y * v[2];
  const double rise = -(1.0 + world.restitution) * u_n;  // A_nn p_n + A_nt p_t
  const double determinant = a_nn * a_tt - a_nt * a_nt;
  double p_n = (a_tt * rise + a_nt * u_t) / determinant;
  double p_t = (-a_nt * rise - a_nn * u_t) / determinant;
  if (std::abs(p_t) > world.friction * p_n) {
    const double sign = p_t > 0.0 ? 1.0 : -1.0;
    p_n = rise / (a_nn + sign * world.friction * a_nt);
    p_t = sign * world.friction * p_n;
  }
  return {v[0] + p_t * inverse_mass, v[1] + p_n * inverse_mass, v[2] + (r.x * p_n - r.y * p_t) * inverse_inertia};
}

}  // namespace

std::optional<FirstFlight> FirstFlight::of(const World& world, const WorldBody& body) {
  const auto lowest_at = [&](const Pose& pose) { return lowest_point(placed(body.outline, pose)); };
  const auto falling = [&](double t) { return in_flight(body.pose, body.velocity, world.gravity, t); };
  const std::optional<double> impact =
      time_of_touch([&](double t) { return lowest_at(falling(t)).y; }, 0.0, world.duration);
  if (!impact) return std::nullopt;

  FirstFlight flight;
  flight.gravity_ = world.gravity;
  flight.impact_time_ = *impact;
  flight.impact_pose_ = falling(*impact);
  Vector3 velocity = body.velocity;
  velocity[1] -= world.gravity * *impact;
  flight.velocity_ = after_impact(body, flight.impact_pose_.position, velocity, lowest_at(flight.impact_pose_), world);
  flight.end_time_ = time_of_touch([&](double t) { return lowest_at(flight.pose_at(t)).y; }, *impact, world.duration)
                         .value_or(world.duration);
  return flight;
}

Pose FirstFlight::pose_at(double time) const {
  return in_flight(impact_pose_, velocity_, gravity_, time - impact_time_);
}

}  // namespace tumble::bench
