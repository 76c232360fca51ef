// The drop model's record as the trajectory of a scene, for pictures.
#pragma once

#include "tumble/drop/drop.hpp"
#include "tumble/trajectory/trajectory.hpp"

namespace tumble::output {

// A square on a half-plane: the bodies "floor" and "square".
Scene scene_of(const drop::Parameters& parameters);

// A run of that scene, a sample for each column. Steps that were not solved have no contacts. Throws
// std::invalid_argument if the record is inconsistent.
Trajectory trajectory_of(const drop::Record& record);

}  // namespace tumble::output
