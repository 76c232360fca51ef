// Records of drops and trajectories of scenes into files, in the format that the ending of the name asks for.
#pragma once

#include <filesystem>
#include <string>

#include "tumble/drop/drop.hpp"
#include "tumble/trajectory/trajectory.hpp"

namespace tumble::output {

inline constexpr int k_smallest_picture = 160;  // width and height [px]
inline constexpr int k_largest_picture = 4096;

struct WriteOptions {
  bool overwrite = false;
  std::string format{};  // csv, npz, h5, gif, mp4, png, svg or html, for trajectories also contacts.csv; empty: by the
                         // ending of the name
  int width = 0;         // of a picture [px]; 0: chosen for the format, for png and svg by the shape of the path
  int height = 0;        // [px]
  double speed = 1.0;    // of an animation: seconds of the motion per second of the film, > 0
  std::filesystem::path page{};  // of an .html: the page that is to show the run, see html.hpp
};

// What can be said before a simulation: format and sizes are allowed, the folder exists and is writable, no
// file is in the way unless it may be overwritten, ffmpeg or the page is there if it is needed. Throws
// std::invalid_argument, and std::runtime_error for what this machine or this build lacks.
void check_writable(const std::filesystem::path& path, const WriteOptions& options = {});

// As above, and that an animation of so many columns is not too long.
void check_writable(const std::filesystem::path& path, const WriteOptions& options, const drop::Parameters& parameters);

// Writes all or nothing. Throws as check_writable, and std::runtime_error "path: reason" if the writing
// itself fails.
void write_record(const drop::Record& record, const std::filesystem::path& path, const WriteOptions& options = {});

// The three for the trajectory of a scene. The table of samples is a .csv, that of contacts a .contacts.csv. `duration`
// is that of the motion [s].
void check_trajectory_writable(const std::filesystem::path& path, const WriteOptions& options, double duration);
void write_trajectory(const Trajectory& trajectory, const std::filesystem::path& path,
                      const WriteOptions& options = {});

// What contacts are to such a file of a trajectory. Throws for an unknown format.
enum class ContactUse { none, part, all };
ContactUse contact_use(const std::filesystem::path& path, const WriteOptions& options = {});

// Reads a .csv, .npz or .h5 file that write_record wrote, to the same bits; see parse_record_npz for files of
// numpy. Throws std::invalid_argument with the place of the fault, std::system_error if the file cannot be
// read.
drop::Record read_record(const std::filesystem::path& path);

}  // namespace tumble::output
