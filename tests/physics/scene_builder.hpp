// Scenes for tests of the physics, in few words.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "tumble/scene/scene.hpp"

namespace tumble::physics {

inline constexpr double k_g = 9.81;  // [m/s^2]
inline constexpr double k_pi = 3.14159265358979323846;

inline constexpr double radians(double degrees) { return degrees * (k_pi / 180.0); }

inline ContactLaw law(double friction, double restitution = 0.0) { return {friction, friction, restitution}; }
inline ContactLaw static_and_kinetic(double static_friction, double friction) {
  return {friction, static_friction, 0.0};
}

inline Body fixed(Shape shape, Pose pose = {}) {
  Body body;
  body.kind = BodyKind::fixed;
  body.parts = {{std::move(shape)}};
  body.pose = pose;
  return body;
}

inline Body kinematic(Shape shape, Pose pose, Vector3 velocity) {
  Body body = fixed(std::move(shape), pose);
  body.kind = BodyKind::kinematic;
  body.velocity = velocity;
  return body;
}

// With inertia m k^2: a shape without area, or a disc that stands for a hoop or a sphere.
inline Body dynamic_of_gyration(Shape shape, double mass, double square_of_gyration, Pose pose, Vector3 velocity = {}) {
  Body body = fixed(std::move(shape), pose);
  body.kind = BodyKind::dynamic;
  body.mass = mass;
  body.moment_of_inertia = mass * square_of_gyration;
  body.velocity = velocity;
  return body;
}

// Filled evenly; the centroid of the shape must be its origin.
inline Body dynamic(const Shape& shape, double mass, Pose pose, Vector3 velocity = {}) {
  const AreaMoments moments = area_moments(shape);
  return dynamic_of_gyration(shape, mass, moments.polar_moment / moments.area, pose, velocity);
}

// Solid below; it rises to the right.
inline HalfPlane slope(double angle) { return {{-std::sin(angle), std::cos(angle)}, 0.0}; }
inline HalfPlane level() { return {{0.0, 1.0}, 0.0}; }
inline HalfPlane ceiling(double height) { return {{0.0, -1.0}, -height}; }
inline HalfPlane wall_on_the_left(double x) { return {{1.0, 0.0}, x}; }
inline HalfPlane wall_on_the_right(double x) { return {{-1.0, 0.0}, -x}; }

// On a slope: so far up along it, so far above it, turned with it.
inline Pose on_slope(double angle, double along, double above) {
  return {{along * std::cos(angle) - above * std::sin(angle), along * std::sin(angle) + above * std::cos(angle)},
          angle};
}
inline Vector2 up_slope(double angle) { return {std::cos(angle), std::sin(angle)}; }

// All of one material. Bodies keep their order.
inline Scene scene_of(ContactLaw contact_law, std::vector<Body> bodies) {
  Scene scene;
  scene.materials = {{"one", contact_law}};
  scene.bodies = std::move(bodies);
  return scene;
}

// A disc of radius 0.2 m on a fixed one of 1 m, at `angle` from its top.
inline Scene disc_on_a_disc(double friction, double angle) {
  const Pose pose = {{1.2 * std::sin(angle), 1.2 * std::cos(angle)}, 0.0};
  return scene_of(law(friction), {fixed(disc(1.0)), dynamic(disc(0.2), 1.0, pose)});
}

inline Scene without_gravity(Scene scene) {
  scene.gravity = {};
  return scene;
}

}  // namespace tumble::physics
