// What is swept: drops of the document's model, or runs of a scene. Not a public header.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "tumble/batch/simulate_batch.hpp"
#include "tumble/sweep/plan.hpp"
#include "tumble/sweep/slice.hpp"

namespace tumble::sweep {

// The values of each quantity in a slice, one for each instance; of constants, one.
struct SliceValues {
  // At least two instances: an array of one value would hold for all of a batch, and be refused as a whole where an
  // instance alone is `invalid`.
  SliceValues(const Spec& of_spec, const Slice& slice);

  const Spec& spec;
  std::size_t count;
  std::vector<std::vector<double>> values;
};

// What is measured, for each instance.
struct Rows {
  std::vector<double> pose;  // at the end, count x 3: x, y [m], theta [rad]
  std::vector<batch::DropStatus> status;
  std::vector<batch::DropMeasures> measures;
};

Rows simulate_drops(const SliceValues& values, const std::function<void()>& watch);
Rows simulate_scenes(const SliceValues& values, const std::function<void()>& watch);

// Of the first instance.
Path drop_path(const SliceValues& values, int every);
Path scene_path(const SliceValues& values, int every);

}  // namespace tumble::sweep
