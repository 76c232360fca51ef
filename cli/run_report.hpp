// What `tumble run` prints: lines for people, JSON for machines.
#pragma once

#include <string>
#include <vector>

#include "tumble/trajectory/simulate.hpp"

namespace tumble::cli {

// What is seen of a run on the way, beside its trajectory.
struct RunNotes {
  double deepest_gap = 0.0;      // [m] < 0: the largest overlap at the start of a step
  int body_a = -1, body_b = -1;  // which overlapped so
  double time = 0.0;             // when [s]
  double moving_until = 0.0;     // [s]: no dynamic body moved from then on
  bool is_interrupted = false;

  void take(const Simulation& simulation);  // after each step
};

// `files` are those written.
std::string run_text(const Trajectory& trajectory, const RunNotes& notes, const std::vector<std::string>& files);
std::string run_json(const Trajectory& trajectory, const RunNotes& notes, const std::vector<std::string>& files);

}  // namespace tumble::cli
