// Records and trajectories as HDF5 files: the arrays of record_fields.hpp and trajectory_fields.hpp as datasets at the
// root, each with its units as attribute. A build without HDF5 has these functions too; they throw std::runtime_error
// "this build has no HDF5".
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "tumble/drop/drop.hpp"
#include "tumble/output/table.hpp"
#include "tumble/trajectory/trajectory.hpp"

namespace tumble::output {

bool has_hdf5();

// Of the library as loaded, "1.10.8".
std::string hdf5_version();

// Throws the error of a build without HDF5 if this is one.
void check_hdf5();

// The bytes of the file. They depend on the record or trajectory alone: no times are kept.
std::string to_hdf5(const drop::Record& record);
std::string to_hdf5(const Trajectory& trajectory);

// Writes the table into the file of that name, which is made or replaced at once: see write_table.
void write_table_hdf5(const Table& table, const std::filesystem::path& path);

// Reads what `to_hdf5` wrote, to the same bits; needs and completes what from_fields needs and completes.
// Throws std::invalid_argument "name: dataset: what, what is allowed".
drop::Record parse_record_hdf5(std::string_view bytes, const std::string& name);

}  // namespace tumble::output
