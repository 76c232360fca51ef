#include "transform.hpp"

#include <algorithm>
#include <variant>

namespace tumble::physics {
namespace {

// Applies one function to all poses, one to all velocities of bodies and one to all wrenches.
template <class OfPose, class OfVelocity, class OfWrench>
void transform(Body& body, OfPose of_pose, OfVelocity of_velocity, OfWrench of_wrench) {
  body.pose = of_pose(body.pose);
  body.velocity = of_velocity(body.velocity);
  for (Knot& knot : body.motion) knot.pose = of_pose(knot.pose);
  for (Wrench& wrench : body.wrenches) of_wrench(wrench);
}

Shape mirrored(Shape shape) {
  const auto flip = [](std::vector<Vector2>& points) {
    for (Vector2& p : points) p.x = -p.x;
    std::reverse(points.begin(), points.end());
  };
  if (auto* polygon = std::get_if<RoundedPolygon>(&shape)) flip(polygon->vertices);
  if (auto* terrain = std::get_if<Terrain>(&shape)) flip(terrain->points);
  if (auto* plane = std::get_if<HalfPlane>(&shape)) plane->normal.x = -plane->normal.x;
  if (auto* round = std::get_if<Ellipse>(&shape)) {
    round->pose = {{-round->pose.position.x, round->pose.position.y}, -round->pose.angle};
  }
  return shape;
}

Shape scaled(Shape shape, double length) {
  const auto stretch = [length](std::vector<Vector2>& points) {
    for (Vector2& p : points) p = length * p;
  };
  if (auto* polygon = std::get_if<RoundedPolygon>(&shape)) {
    stretch(polygon->vertices);
    polygon->rounding *= length;
  }
  if (auto* terrain = std::get_if<Terrain>(&shape)) stretch(terrain->points);
  if (auto* plane = std::get_if<HalfPlane>(&shape)) plane->offset *= length;
  if (auto* round = std::get_if<Ellipse>(&shape)) {
    round->semi_axis_x *= length;
    round->semi_axis_y *= length;
    round->pose.position = length * round->pose.position;
  }
  return shape;
}

}  // namespace

Scene moved(Scene scene, const Pose& frame) {
  const Frame f = frame_of(frame);
  scene.gravity = direction_to_world(f, scene.gravity);
  for (Body& body : scene.bodies) {
    transform(
        body,
        [&](const Pose& pose) {
          return Pose{point_to_world(f, pose.position), pose.angle + frame.angle};
        },
        [&](const Vector3& v) {
          const Vector2 u = direction_to_world(f, {v[0], v[1]});
          return Vector3{u.x, u.y, v[2]};
        },
        [&](Wrench& wrench) { wrench.force = direction_to_world(f, wrench.force); });
  }
  return scene;
}

Scene mirrored(Scene scene) {
  scene.gravity.x = -scene.gravity.x;
  for (Body& body : scene.bodies) {
    for (Part& part : body.parts) {
      part.shape = mirrored(part.shape);
      part.surface_speed = -part.surface_speed;
    }
    transform(
        body,
        [](const Pose& pose) {
          return Pose{{-pose.position.x, pose.position.y}, -pose.angle};
        },
        [](const Vector3& v) {
          return Vector3{-v[0], v[1], -v[2]};
        },
        [](Wrench& wrench) {
          wrench.force.x = -wrench.force.x;
          wrench.torque = -wrench.torque;
        });
  }
  return scene;
}

Scene in_units(Scene scene, double length, double mass, double time) {
  const double speed = length / time, acceleration = speed / time;
  scene.gravity = acceleration * scene.gravity;
  scene.step_size *= time;
  scene.duration *= time;
  for (Body& body : scene.bodies) {
    for (Part& part : body.parts) {
      part.shape = scaled(part.shape, length);
      part.surface_speed *= speed;
    }
    body.mass *= mass;
    body.moment_of_inertia *= mass * length * length;
    body.linear_damping /= time;
    body.angular_damping /= time;
    for (Knot& knot : body.motion) knot.time *= time;
    transform(
        body,
        [=](const Pose& pose) {
          return Pose{length * pose.position, pose.angle};
        },
        [=](const Vector3& v) {
          return Vector3{speed * v[0], speed * v[1], v[2] / time};
        },
        [=](Wrench& wrench) {
          wrench.time *= time;
          wrench.force = mass * acceleration * wrench.force;
          wrench.torque *= mass * acceleration * length;
        });
  }
  return scene;
}

Scene reordered(const Scene& scene, const std::vector<std::size_t>& order) {
  Scene result = scene;
  for (std::size_t i = 0; i < order.size(); ++i) result.bodies[i] = scene.bodies[order[i]];
  return result;
}

}  // namespace tumble::physics
