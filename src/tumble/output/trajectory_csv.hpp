// The course of a scene as text, in two tables: samples, and contacts. Each has comment lines in front that say what
// the run was, a line of column names, then the rows. Numbers are the shortest decimals that read back to the same
// bits.
#pragma once

#include <cstddef>
#include <string>

#include "tumble/trajectory/trajectory.hpp"

namespace tumble::output {

// One row for each sample: time, energies, then pose and velocity of each body that is not fixed.
std::string samples_csv_header(const Trajectory& trajectory);
// The samples [first, last): a long run need not be in memory as text.
std::string samples_csv_rows(const Trajectory& trajectory, std::size_t first, std::size_t last);

// One row for each contact at work in a step.
std::string contacts_csv_header(const Trajectory& trajectory);
// Those of the entries [first, last) of `trajectory.contacts`.
std::string contacts_csv_rows(const Trajectory& trajectory, std::size_t first, std::size_t last);

}  // namespace tumble::output
