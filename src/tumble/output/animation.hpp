// A run as a film in real time: which sample each picture shows, and the pictures themselves.
#pragma once

#include <memory>
#include <vector>

#include "tumble/output/canvas.hpp"
#include "tumble/trajectory/trajectory.hpp"

namespace tumble::output {

// Browsers slow pictures of less than 2 hundredths of a second down, and .gif knows no finer time.
inline constexpr double k_frame_time = 0.02;  // [s]
inline constexpr double k_hold_time = 0.8;    // of the last picture [s]

// The longest film: 60 s as .gif, 10 min as .mp4.
inline constexpr int k_max_gif_frames = 3'000;
inline constexpr int k_max_mp4_frames = 30'000;

// How many pictures a motion of so many seconds has; `speed` is seconds of motion per second of film. Throws
// std::invalid_argument if they are more than `max_frames`.
int count_frames(double motion, double speed, int max_frames);

// Draws the pictures one after the other. Picture i shows the sample nearest to the time i * k_frame_time *
// speed, the last one the last sample. Impulses since the picture before appear and fade, so that one step of
// contact is seen.
class Animation {
 public:
  // The trajectory must outlive the animation.
  Animation(const Trajectory& trajectory, int width, int height, double speed, int max_frames);
  ~Animation();
  Animation(const Animation&) = delete;
  Animation& operator=(const Animation&) = delete;

  int frames() const;

  // The pixels 0x00RRGGBB of picture i, row after row. Call with i = 0, 1, 2, ...
  std::vector<std::uint32_t> draw(int i);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tumble::output
