// Ctrl-C as a question that a loop asks.
#pragma once

#include <csignal>

namespace tumble::cli {

// While it lives, the first Ctrl-C (SIGINT) is only noted; the second one ends the program as usual. Where Ctrl-C is
// ignored, as behind nohup, it stays so. One at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  bool is_interrupted() const;

 private:
  struct sigaction before_ {};
};

}  // namespace tumble::cli
