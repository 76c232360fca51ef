// A run as .mp4, made by the program ffmpeg.
#pragma once

#include <filesystem>

#include "tumble/trajectory/trajectory.hpp"

namespace tumble::output {

// Throws std::runtime_error naming the Debian package if there is no ffmpeg on the PATH.
void check_ffmpeg();

// 50 pictures a second, H.264, the last picture stays for 0.8 s. Writes over the file `path`, which must
// exist; width and height must be even. Throws std::invalid_argument as to_gif, for runs of more than 10 min,
// and std::runtime_error with the last words of ffmpeg if that fails.
void write_mp4(const Trajectory& trajectory, const std::filesystem::path& path, int width, int height,
               double speed = 1.0);

}  // namespace tumble::output
