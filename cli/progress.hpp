// How far a long run is, on standard error if that is a terminal.
#pragma once

#include <chrono>
#include <cstdint>

namespace tumble::cli {

// One line that is written anew several times a second, from the first second on, and is gone in the end.
class Progress {
 public:
  // Of `total` steps, of which each one counts as `size` of what is shown with `unit`.
  Progress(std::int64_t total, double size, const char* unit);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::int64_t done);

 private:
  using Clock = std::chrono::steady_clock;

  std::int64_t total_;
  double size_;
  const char* unit_;
  bool is_terminal_;
  bool has_shown_ = false;
  Clock::time_point start_, next_;
};

}  // namespace tumble::cli
