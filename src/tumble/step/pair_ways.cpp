// Two parts on the ways that their bodies take in a step. See step_parts.hpp.
#include <algorithm>
#include <cmath>

#include "tumble/geometry/pair_contacts.hpp"
#include "tumble/step/step_parts.hpp"

namespace tumble {
namespace {

using Index = std::size_t;
using Parts = StepWorkspace::Parts;

}  // namespace

ShapeSize size_of_pair(const Parts& parts, const Contact& pair) {
  const ShapeSize& a = parts.sizes[static_cast<Index>(pair.body_a)][static_cast<Index>(pair.part_a)];
  const ShapeSize& b = parts.sizes[static_cast<Index>(pair.body_b)][static_cast<Index>(pair.part_b)];
  return {std::min(a.radius, b.radius), std::max(a.thickness, b.thickness)};
}

double way_of(const Parts& parts, std::size_t body) {
  const Vector3& d = parts.travel[body];
  return std::sqrt(d[0] * d[0] + d[1] * d[1]) + std::abs(d[2]) * parts.radius[body];
}

bool is_within_reach(const Parts& parts, std::size_t body) {
  const Vector3& d = parts.travel[body];
  const double left = parts.reach[body] - std::abs(d[2]) * parts.radius[body];
  return left >= 0.0 && d[0] * d[0] + d[1] * d[1] <= left * left;
}

void set_way_velocity(double h, Parts& parts, const Contact& pair) {
  for (const int body : {pair.body_a, pair.body_b}) {
    const auto b = static_cast<Index>(body);
    parts.way_velocity[b] = parts.velocity[b];
    if (!(parts.inverse_mass[b][0] > 0.0)) continue;
    for (Index j = 0; j < 3; ++j) parts.way_velocity[b][j] = parts.travel[b][j] / h;
  }
}

void find_contacts_at(Parts& parts, const Contact& pair, const std::vector<Vector3>& velocity, double time,
                      double reach) {
  const auto moved = [&](int body, int part) -> const PlacedShape& {
    const auto b = static_cast<Index>(body);
    const Vector3& v = velocity[b];
    MovedShape& shape = parts.finder.moved(body, part);
    shape.move_to({parts.poses[b].position + time * Vector2{v[0], v[1]}, parts.poses[b].angle + time * v[2]});
    return shape.placed();
  };
  parts.points.clear();
  append_sorted_contacts(moved(pair.body_a, pair.part_a), moved(pair.body_b, pair.part_b), reach, parts.points);
}

double least_gap_at(Parts& parts, const Contact& pair, const std::vector<Vector3>& velocity, double time) {
  find_contacts_at(parts, pair, velocity, time, 0.0);
  double least = HUGE_VAL;
  for (const ContactPoint& point : parts.points) least = std::min(least, point.gap);
  return least;
}

std::optional<Impact> find_impact(double h, Parts& parts, FastPair& pair, const std::vector<Vector3>& velocity) {
  const Contact& c = pair.nearest;
  const auto a = static_cast<Index>(c.body_a), b = static_cast<Index>(c.body_b);
  const std::array<Vector3, 2> velocities = {velocity[a], velocity[b]};
  if (pair.misses && velocities == pair.missing_velocity) return std::nullopt;
  const double distance = k_touching * size_of_pair(parts, c).radius;
  const double apart = time_apart(parts.finder.shape(c.body_a, c.part_a), velocity[a],
                                  parts.finder.shape(c.body_b, c.part_b), velocity[b], c.normal, h, 0.5 * distance);
  std::optional<Impact> impact;
  if (apart < h) {
    impact = time_of_impact(parts.finder.moved(c.body_a, c.part_a), parts.poses[a], velocity[a],
                            parts.finder.moved(c.body_b, c.part_b), parts.poses[b], velocity[b], apart, h, distance,
                            parts.points);
  }
  pair.misses = !impact;
  pair.missing_velocity = velocities;
  return impact;
}

}  // namespace tumble
