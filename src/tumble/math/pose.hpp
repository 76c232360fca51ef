// Where a body is: poses and the frames made of them.
#pragma once

#include "tumble/math/sin_cos.hpp"
#include "tumble/math/vector2.hpp"

namespace tumble {

struct Pose {
  Vector2 position;    // [m]
  double angle = 0.0;  // [rad], counter-clockwise, never wrapped

  friend bool operator==(const Pose&, const Pose&) = default;
};

// A pose with the sine and cosine of its angle at hand.
struct Frame {
  Vector2 position;
  double sin = 0.0;
  double cos = 1.0;
};

inline Frame frame_of(const Pose& pose) {
  const SinCos turn = sin_cos(pose.angle);
  return {pose.position, turn.sin, turn.cos};
}

// Directions and points from the frame's own coordinates to the world's, and back.
inline Vector2 direction_to_world(const Frame& f, Vector2 a) {
  return {f.cos * a.x - f.sin * a.y, f.sin * a.x + f.cos * a.y};
}
inline Vector2 direction_to_local(const Frame& f, Vector2 a) {
  return {f.cos * a.x + f.sin * a.y, f.cos * a.y - f.sin * a.x};
}
inline Vector2 point_to_world(const Frame& f, Vector2 a) { return f.position + direction_to_world(f, a); }
inline Vector2 point_to_local(const Frame& f, Vector2 a) { return direction_to_local(f, a - f.position); }

}  // namespace tumble
