// The drop model's record as the trajectory of a scene, for pictures.
#pragma once

#include "tumble/drop/drop.hpp"
#include "tumble/trajectory/trajectory.hpp"

namespace tumble::output {

// The square at its start and the ground; the step of scenes takes it another way than the drop model.
Scene drop_scene(const Vector3& q0, const Vector3& v0, const drop::Parameters& parameters);

// A square on a half-plane, a sample for each column. Steps that were not solved have no contacts. Throws
// std::invalid_argument if the record is inconsistent.
Trajectory trajectory_of(const drop::Record& record);

}  // namespace tumble::output
