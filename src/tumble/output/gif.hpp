// A run as an animated .gif that repeats for ever.
#pragma once

#include <string>

#include "tumble/trajectory/trajectory.hpp"

namespace tumble::output {

// 50 pictures a second, the last one stays for 0.8 s. Throws std::invalid_argument if the run is longer than
// 60 s of film or positions are too large to be drawn.
std::string to_gif(const Trajectory& trajectory, int width, int height, double speed = 1.0);

}  // namespace tumble::output
