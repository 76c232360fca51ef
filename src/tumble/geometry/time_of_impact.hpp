// When two moving shapes first meet, however fast they are.
#pragma once

#include <optional>

#include "tumble/geometry/contact_point.hpp"
#include "tumble/math/pose.hpp"
#include "tumble/math/vector.hpp"
#include "tumble/scene/shape.hpp"

namespace tumble {

struct Impact {
  double time = 0.0;     // [s] from the start
  ContactPoint contact;  // the closest points at that time
};

// The first time in [0, duration] at which two shapes are within `distance` [m] > 0 of each other, while their bodies
// move from these poses with constant velocities (v_x, v_y, omega); 0 if they are at the start. Nothing if they stay
// farther apart. By conservative advancement [Mirtich 1996]: each step is so short that the gap cannot close in it, so
// no motion, however fast, passes through. Up to `distance` / 2 early is possible, late is not; shapes that graze each
// other for a long way may be stopped earlier, after k_most_advances steps.
std::optional<Impact> time_of_impact(const Shape& a, const Pose& pose_a, const Vector3& velocity_a, const Shape& b,
                                     const Pose& pose_b, const Vector3& velocity_b, double duration, double distance);

constexpr int k_most_advances = 1000;

}  // namespace tumble
