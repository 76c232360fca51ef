// How deep bodies overlap, computed here so that no engine's own opinion counts.
#pragma once

#include <span>
#include <vector>

#include "worlds.hpp"

namespace tumble::bench {

// The outline at a pose.
Outline placed(const Outline& outline, const Pose& pose);

// The shortest way [m] to part two outlines in the world frame; 0 if they are apart. By separating axes, with exact
// distances where one is a disc.
double overlap(const Outline& a, const Outline& b);

// The largest of all pairs of bodies, and of bodies with walls, all in the world frame.
double deepest_overlap(std::span<const Outline> bodies, std::span<const Outline> walls);

}  // namespace tumble::bench
