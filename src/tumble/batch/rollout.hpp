// Many runs of one scene at once, over the cores: starts, masses, contact laws and gravity differ from instance to
// instance. Each comes out bit for bit as `simulate` gives it alone, whatever the number of threads and the neighbours.
// Use and figures: docs/rollout.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "tumble/batch/measure_settings.hpp"
#include "tumble/scene/scene.hpp"
#include "tumble/step/time_step.hpp"
#include "tumble/trajectory/trajectory.hpp"

namespace tumble::batch {

// The bodies whose start is free, as indices into the scene: dynamic ones, and kinematic ones without knots.
std::vector<int> movable_bodies(const Scene& scene);

// What may differ between instances besides the start. Units and ranges as in the scene.
enum class Quantity {
  mass,               // of a dynamic body [kg]; its moment of inertia grows in proportion
  moment_of_inertia,  // of a dynamic body [kg m^2], in place of that
  friction,           // of a law [-]; static friction is the same
  static_friction,    // of a law [-], in place of that
  restitution,        // of a law [-]
  gravity_x,          // [m/s^2]
  gravity_y,
};

struct Varied {
  Quantity quantity = Quantity::mass;
  int index = 0;  // of the body; of the law: of its material, or the number of materials + the index of its pair
  std::span<const double> values;  // one for each instance, or one for all
};

// N runs of a scene of B movable bodies.
struct Instances {
  std::size_t count = 0;
  // (x, y, angle) [m, m, rad] and (v_x, v_y, omega) [m/s, m/s, rad/s] at the start: N x B x 3, row after row; or B x 3
  // for all; or empty, for those of the scene.
  std::span<const double> pose, velocity;
  std::vector<Varied> varied;  // in any order
};

// What is told of a run without its samples. NaN for an instance that was not run.
struct RolloutMeasures {
  double residual;        // the largest of all steps [-]
  double created_energy;  // of all steps [J]
  double last_contact;    // end of the last step with an impulse [s]; NaN if there was none
  double rest_time;       // from when on no dynamic body is faster than rest_speed [s]; NaN if one is at the end
  double max_impulse;     // largest sum of normal impulses between two bodies in a step [N s]
  double energy_lost;     // kinetic and potential energy at the start less that at the end [J]
  double escape_time;     // first end of a step where x of a dynamic body is not in [x_min, x_max] [s]; NaN if none
  EnergyLedger energy;    // at the end; works and losses of all steps
  std::int64_t num_steps;
  std::int64_t num_inexact_steps;   // see Trajectory
  std::int64_t num_creating_steps;  // the same
  std::int64_t impacts;             // times that two bodies begin to push each other
};

struct RolloutSettings {
  double step_size = 0.0;  // [s]; 0: the scene's
  double duration = 0.0;   // [s]; 0: the scene's
  int every = 0;           // samples that are kept: 0 the last alone; k >= 1 those of `simulate` with sample_every k
  StepSettings step{};
  int threads = 0;  // 0: one for each core
  MeasureSettings measures{.rest_speed = 1e-3};
  // Called about every 20 ms from the calling thread with the number of instances done; what it throws ends the rollout
  // within a step.
  std::function<void(std::size_t num_done)> watch{};
};

// Where results go; an empty array is not wanted.
struct RolloutResults {
  // N x B x 3 x T, T as `sample_times`: T numbers in a row for each coordinate. NaN in samples that a run that ended
  // early, or was not run, did not reach; the last one reached, and where T is 1, that alone, is where it ended.
  std::span<double> pose, velocity;
  std::span<LcpStatus> status;  // N: that of `simulate`; `bad_input`: NaN or out of range, not run, see what_is_invalid
  std::span<RolloutMeasures> measures;  // N
};

// The T times of the samples that are kept [s]. Throws as `rollout`.
std::vector<double> sample_times(const Scene& scene, const RolloutSettings& settings);

// Runs the instances. Memory besides the results does not grow with their number. Throws std::invalid_argument for an
// invalid scene, settings or arrays, and for values common to all that are out of range; what is wrong with one
// instance alone is its status. Results are complete when it returns; when it throws they hold anything.
void rollout(const Scene& scene, const Instances& instances, const RolloutSettings& settings,
             const RolloutResults& results);

// The scene that `simulate` runs as instance i does. Throws std::invalid_argument for arrays of wrong lengths, and
// nothing else: it may hold anything that the instance does.
Scene instance_scene(const Scene& scene, const Instances& instances, std::size_t i);

// The line that `simulate` would refuse instance i with; empty if it would not.
std::string what_is_invalid(const Scene& scene, const Instances& instances, std::size_t i);

}  // namespace tumble::batch
