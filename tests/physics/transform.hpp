// The same scene seen in another way.
#pragma once

#include <vector>

#include "tumble/scene/scene.hpp"

namespace tumble::physics {

// Seen from a frame that lies at `origin` and is turned by `angle`: where a pose, a vector of the world goes.
Scene moved(Scene scene, const Pose& frame);

// Left and right exchanged: x -> -x, angles, spins and torques too.
Scene mirrored(Scene scene);

// In other units: numbers of length, mass and time times these.
Scene in_units(Scene scene, double length, double mass, double time);

// Body i of the result is body order[i].
Scene reordered(const Scene& scene, const std::vector<std::size_t>& order);

}  // namespace tumble::physics
