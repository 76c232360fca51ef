#include "tumble/step/state.hpp"

#include <algorithm>

namespace tumble {

using Index = std::size_t;

Pose prescribed_pose(const Body& body, double time) {
  if (body.kind == BodyKind::fixed) return body.pose;
  const std::vector<Knot>& knots = body.motion;
  if (knots.empty()) {
    const Vector3& v = body.velocity;
    return {body.pose.position + time * Vector2{v[0], v[1]}, body.pose.angle + time * v[2]};
  }
  if (time <= knots.front().time) return knots.front().pose;
  if (time >= knots.back().time) return knots.back().pose;
  const auto after =
      std::upper_bound(knots.begin(), knots.end(), time, [](double t, const Knot& knot) { return t < knot.time; });
  const Knot& from = *(after - 1);
  const Knot& to = *after;
  const double s = (time - from.time) / (to.time - from.time);
  return {from.pose.position + s * (to.pose.position - from.pose.position),
          from.pose.angle + s * (to.pose.angle - from.pose.angle)};
}

Vector3 mean_wrench(const Body& body, double from, double to) {
  Vector3 sum{};
  const std::vector<Wrench>& wrenches = body.wrenches;
  for (Index i = 0; i < wrenches.size(); ++i) {
    const double begin = std::max(from, wrenches[i].time);
    const double end = i + 1 < wrenches.size() ? std::min(to, wrenches[i + 1].time) : to;
    if (!(end > begin)) continue;
    const double share = begin == from && end == to ? 1.0 : (end - begin) / (to - from);
    sum[0] += share * wrenches[i].force.x;
    sum[1] += share * wrenches[i].force.y;
    sum[2] += share * wrenches[i].torque;
  }
  return sum;
}

State initial_state(const Scene& scene) {
  State state;
  for (const Body& body : scene.bodies) {
    BodyState& at_start = state.bodies.emplace_back();
    at_start.pose = body.kind == BodyKind::kinematic ? prescribed_pose(body, 0.0) : body.pose;
    if (body.kind == BodyKind::dynamic || (body.kind == BodyKind::kinematic && body.motion.empty()))
      at_start.velocity = body.velocity;
  }
  return state;
}

}  // namespace tumble
