// The course of a scene over time.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tumble/scene/scene.hpp"
#include "tumble/step/state.hpp"
#include "tumble/step/step_report.hpp"

namespace tumble {

// What contacts did in one step.
struct StepContacts {
  std::int64_t step = 0;  // 1, 2, ...; the step ends at time step * step_size
  std::vector<ContactRecord> contacts;
};

// What became of a run.
struct RunSummary {
  std::int64_t num_steps = 0;
  LcpStatus status = LcpStatus::solved;  // other than `solved`: of the last step, with which the run ended
  double residual = 0.0;                 // the largest of all steps
  std::int64_t num_inexact_steps = 0;    // steps that were not solved, but well enough to go on from them,
  double first_inexact = -1.0;           // and when first [s]; -1: never
  std::int64_t num_creating_steps = 0;   // steps that created energy,
  double created_energy = 0.0;           // how much in all [J],
  double first_creation = -1.0;          // and when first [s]; -1: never
  bool is_complete = false;              // it reached the end asked for
};

// Samples of a run, the first at time 0. Row k of an array over samples belongs to time[k].
struct Trajectory : RunSummary {
  Scene scene;
  double step_size = 0.0;              // [s]
  std::vector<double> time;            // [s], T samples
  std::vector<BodyState> states;       // T x bodies of the scene, one sample after the other
  std::vector<EnergyLedger> energy;    // T; works and losses since the sample before
  std::vector<StepContacts> contacts;  // of every step in which contacts were at work, if asked for

  // The bodies at sample k, in the order of the scene.
  std::span<const BodyState> bodies(std::size_t k) const {
    const std::size_t count = scene.bodies.size();
    return {states.data() + k * count, count};
  }
};

// The energies of a state [J]; works and losses are 0.
EnergyLedger energies(const Scene& scene, const State& state);

// Takes a step into account: its works and losses are added, its energies are those after it.
void add_step(EnergyLedger& sum, const EnergyLedger& step);

}  // namespace tumble
