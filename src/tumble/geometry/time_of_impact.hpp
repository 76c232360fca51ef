// When two moving shapes first meet, however fast they are.
#pragma once

#include <optional>
#include <vector>

#include "tumble/geometry/contact_point.hpp"
#include "tumble/geometry/placed_shape.hpp"
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

// The same for shapes at hand, which are left somewhere on their way, with scratch memory. They are known not to be
// within the distance before `earliest` [s].
std::optional<Impact> time_of_impact(MovedShape& a, const Pose& pose_a, const Vector3& velocity_a, MovedShape& b,
                                     const Pose& pose_b, const Vector3& velocity_b, double earliest, double duration,
                                     double distance, std::vector<ContactPoint>& scratch);

// How long [s] two shapes, moving so from where they are placed, stay at least `distance` [m] apart along a direction
// from a to b, of length 1: a quick bound, of second order in their turning, no more than `duration`; 0 where it cannot
// tell.
double time_apart(const PlacedShape& a, const Vector3& velocity_a, const PlacedShape& b, const Vector3& velocity_b,
                  Vector2 direction, double duration, double distance);

}  // namespace tumble
