#include "progress.hpp"

#include <cmath>
#include <cstdio>
#include <string>

#include <unistd.h>

#include "tumble/math/format.hpp"

namespace tumble::cli {
namespace {

using Seconds = std::chrono::duration<double>;
constexpr std::chrono::milliseconds k_patience{1000};  // before a run counts as long
constexpr std::chrono::milliseconds k_pause{200};
constexpr const char* k_clear_line = "\r\x1b[K";

std::string time_left(double seconds) {
  if (seconds < 100.0) return tumble::format("{:.0f} s", std::ceil(seconds));
  const auto minutes = static_cast<long long>(std::ceil(seconds / 60.0));
  return minutes < 100 ? tumble::format("{} min", minutes)
                       : tumble::format("{} h {:02} min", minutes / 60, minutes % 60);
}

}  // namespace

Progress::Progress(std::int64_t total, double size, const char* unit)
    : total_(total),
      size_(size),
      unit_(unit),
      is_terminal_(::isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      next_(start_ + k_patience) {}

Progress::~Progress() {
  if (has_shown_) tumble::print(stderr, k_clear_line);
}

void Progress::show(std::int64_t done) {
  if (!is_terminal_ || done == 0) return;
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + k_pause;
  const double share = static_cast<double>(done) / static_cast<double>(total_);
  const double elapsed = Seconds(now - start_).count();
  tumble::print(stderr, "{}{:3.0f} %: {:.4g} {} of {:.4g} {}, {} left; Ctrl-C ends it", k_clear_line, 100.0 * share,
                static_cast<double>(done) * size_, unit_, static_cast<double>(total_) * size_, unit_,
                time_left(elapsed * (1.0 - share) / share));
  std::fflush(stderr);
  has_shown_ = true;
}

}  // namespace tumble::cli
