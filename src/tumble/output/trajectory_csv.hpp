// The course of a scene as text, in two tables: samples, and contacts. Each has comment lines in front that say what
// the run was, a line of column names, then the rows. Numbers are the shortest decimals that read back to the same
// bits.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

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

// Reads both tables of a run of `scene` back: written again they have the same bits. Without `contacts` ("") there are
// none. What is in neither table is as before a run, but that fixed bodies stand in their places, tangents are normals
// turned right, and impulses act at the points. The names stand for the tables in messages. Throws
// std::invalid_argument "name:line:column: field: what is allowed, what is there" for all that no run of this scene
// can have written, a file that was cut off included, and as `validate` for a bad scene.
Trajectory parse_trajectory_csv(Scene scene, std::string_view samples, const std::string& samples_name,
                                std::string_view contacts = {}, const std::string& contacts_name = "contacts");

}  // namespace tumble::output
