// A run as the page has it: computed here or read from files, of the drop's model or of a scene.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "convert.hpp"

#include "tumble/drop/drop.hpp"
#include "tumble/trajectory/simulate.hpp"

namespace tumble::wasm {

class Run {
 public:
  // Throw std::invalid_argument for bad input, as the functions they call.
  static std::shared_ptr<Run> of_record(drop::Record record);
  static std::shared_ptr<Run> of_trajectory(Trajectory trajectory);

  // All arrays by name, as in .npz files: of a scene, which the drop is one of, with the sums that are drawn; of the
  // drop's record, or null.
  val trajectory() const;
  val record() const;
  val scene() const;  // as `describe` has it

  // What the contacts of a body do, over the samples: sums of impulses [N s] and the least gap [m] of the step that
  // leaves each; NaN where there is none.
  val body_series(int body) const;

  // The LCP of the step that leaves sample k, its solution, and Lemke's pivots on it; null if there is none to show.
  val problem(int k) const;
  // Those of the contacts at work in it, in the order of the arrays.
  val impulse_planes(int k) const;

  // "record", "samples" or "contacts", as the program writes them.
  std::string csv(const std::string& table) const;

 private:
  std::optional<drop::Record> record_;
  Trajectory trajectory_;
};

// A scene that is stepped a few steps at a time, so that the page stays awake.
class SceneRun {
 public:
  SceneRun(const Scene& scene, const SimulateSettings& settings) : simulation_(scene, settings) {}

  // Up to so many steps; the share of the run that is done, 1 at its end.
  double advance(int num_steps);
  std::shared_ptr<Run> finish() { return Run::of_trajectory(simulation_.finish()); }

 private:
  Simulation simulation_;
};

}  // namespace tumble::wasm
