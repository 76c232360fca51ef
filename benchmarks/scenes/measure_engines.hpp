// Runs every engine in every world.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "engine.hpp"

namespace tumble::bench {

// What came out of one run; it is the same in every round. Lengths in m.
struct Quality {
  int num_lost = 0;              // bodies that are not finite, or more than 1 m below the ground
  double end_overlap = 0.0;      // the deepest after the last step
  double deepest_overlap = 0.0;  // the deepest after any step
  double kinetic_energy = 0.0;   // [J], after the last step, per body
  int num_contacts = 0;          // after the last step
  double drift_x = 0.0;          // the furthest that any body is from its start after the last step
  double drift_y = 0.0;
  // Question::bounce: how far from its place the worst point of the body is, two steps before it exactly touches the
  // ground for the second time. The median of the bodies; nothing if none flies for long enough.
  std::optional<double> flight_error;
};

struct Measurement {
  std::size_t world_index = 0;
  std::size_t engine_index = 0;
  Quality quality;
  std::vector<double> seconds_per_step;  // of processor time, one for each round
};

// In the order of worlds, then of engines. In each round all engines run the same world one after the other, each as
// often as fills `at_least` seconds, so that the ratios of a round are of one time. `progress` gets the number of
// worlds done.
std::vector<Measurement> measure(const std::vector<World>& worlds, const std::vector<Engine>& engines, double step_size,
                                 int rounds, double at_least, const std::function<void(std::size_t)>& progress);

}  // namespace tumble::bench
