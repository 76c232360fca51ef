// Records and trajectories as numpy archives: the arrays of record_fields.hpp and trajectory_fields.hpp, for
// numpy.load.
#pragma once

#include <string>
#include <string_view>

#include "tumble/drop/drop.hpp"
#include "tumble/trajectory/trajectory.hpp"

namespace tumble::output {

std::string to_npz(const drop::Record& record);
std::string to_npz(const Trajectory& trajectory);

// Reads what `to_npz` wrote, to the same bits, and what numpy.savez or numpy.savez_compressed made of the
// same names. q, v and the parameters are needed; absent records of the steps are computed anew. Throws
// std::invalid_argument "name: entry: what, what is allowed", also for files that are cut off or damaged.
drop::Record parse_record_npz(std::string_view bytes, const std::string& name);

}  // namespace tumble::output
