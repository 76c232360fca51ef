// Steps a scene from its start to its end.
#pragma once

#include <cstdint>
#include <memory>

#include "tumble/step/time_step.hpp"
#include "tumble/trajectory/trajectory.hpp"

namespace tumble {

inline constexpr double k_max_steps = 1e9;  // of one simulation

struct SimulateSettings {
  double step_size = 0.0;  // [s]; 0: the scene's
  double duration = 0.0;   // [s]; 0: the scene's
  int sample_every = 1;    // steps between samples, >= 1; the last step is always one
  bool keeps_contacts = true;
  StepSettings step{};
};

// Throws std::invalid_argument, naming the field: what is negative, not finite, or more than 10^9 steps.
void validate(const SimulateSettings& settings);

// Of a run whose scene is known.
struct RunSettings {
  double step_size = 0.0;  // [s]
  std::int64_t num_steps = 0;
  StepSettings step{};
};

// With the scene's step size and duration where the settings have none. Throws std::invalid_argument as `validate`.
RunSettings run_settings(const Scene& scene, const SimulateSettings& settings);

inline bool is_done(const RunSettings& settings, const RunSummary& summary) {
  return summary.num_steps == settings.num_steps || summary.status != LcpStatus::solved;
}

// One step of a run that is not done, and what it adds to the summary. The memory may have served other runs of the
// scene; state and summary are those of this one, first `initial_state(scene)` and {}.
void advance(const Scene& scene, const RunSettings& settings, StepWorkspace& workspace, State& state,
             StepReport& report, RunSummary& summary);

// A run, step by step, for those who want to look in between, to show how far it is, or to end it early.
class Simulation {
 public:
  // Throws std::invalid_argument as `validate` of scene and settings.
  Simulation(const Scene& scene, const SimulateSettings& settings = {});

  bool is_done() const { return tumble::is_done(run_, trajectory_); }
  void advance();  // one step

  double time() const { return state_.time; }
  std::int64_t step() const { return trajectory_.num_steps; }
  std::int64_t num_steps() const { return run_.num_steps; }
  const State& state() const { return state_; }
  const StepReport& report() const { return report_; }  // of the last step
  const Trajectory& trajectory() const { return trajectory_; }

  // What was computed so far; the present state is its last sample. The simulation is over.
  Trajectory finish();

 private:
  void sample();

  SimulateSettings settings_;
  RunSettings run_;
  Trajectory trajectory_;  // holds the scene
  std::unique_ptr<StepWorkspace> workspace_;
  State state_;
  StepReport report_;
  EnergyLedger since_sample_;
};

// The whole run. Where the solver came to no end at a step, it goes on if the residual is at most this, for no law of
// contact is then off by more than that share of the speeds. Else, and where a step has no solution, it ends with the
// status of that step.
inline constexpr double k_largest_residual_to_go_on = 1e-3;
Trajectory simulate(const Scene& scene, const SimulateSettings& settings = {});

}  // namespace tumble
