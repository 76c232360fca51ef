// A line on the terminal that says how far a long run is; nothing if standard error is no terminal.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <string>

#include <unistd.h>

namespace tumble::bench {

class Progress {
 public:
  Progress(std::string what, std::size_t total) : what_(std::move(what)), total_(total) {}
  ~Progress() {
    if (is_shown_) std::fprintf(stderr, "\r\033[K");
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::size_t done) {
    const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
    if (!is_terminal_ || done == 0 || elapsed < last_ + 0.2) return;
    last_ = elapsed;
    is_shown_ = true;
    const double left = elapsed * static_cast<double>(total_ - done) / static_cast<double>(done);
    std::fprintf(stderr, "\r\033[K%s: %zu of %zu, %.0f s left", what_.c_str(), done, total_, left);
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  std::size_t total_;
  bool is_terminal_ = isatty(STDERR_FILENO) != 0;
  bool is_shown_ = false;
  double last_ = 0.0;
  Clock::time_point start_ = Clock::now();
};

}  // namespace tumble::bench
