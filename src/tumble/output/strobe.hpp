// The whole run in one picture: poses at even times, the path, the impacts with their impulses.
#pragma once

#include <string>

#include "tumble/trajectory/trajectory.hpp"

namespace tumble::output {

// Width and height in pixels; 0 is chosen by the shape of the motion. Of a long run at most about 30 poses and the
// largest impulses are shown, and the picture says which; of many bodies fewer poses. Throws std::invalid_argument if
// positions are too large to be drawn.
std::string to_strobe_png(const Trajectory& trajectory, int width = 0, int height = 0);
std::string to_strobe_svg(const Trajectory& trajectory, int width = 0, int height = 0);

}  // namespace tumble::output
