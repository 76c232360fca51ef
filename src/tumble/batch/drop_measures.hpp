// From what is noted during a drop to what is told of it. Not a public header.
#pragma once

#include "tumble/batch/simulate_batch.hpp"
#include "tumble/drop/drop.hpp"

namespace tumble::batch {

// Columns numbered as in drop::Trajectory; -1 is none.
struct NotedColumns {
  double last_contact = -1.0;
  double impacts = 0.0;
  double max_force_time = 0.0;  // largest f_n dt [N s]
  double last_moving = -1.0;
  double escape = -1.0;
};

// The notes for the first column; the kernel of drop_lanes_impl.hpp takes those of the others.
NotedColumns note_start(const drop::State& start, const drop::Parameters& parameters, const MeasureSettings& settings);

// One more column, reached by a step with the normal force f_n. `was_closed`: the step before had a force.
void note_column(NotedColumns& noted, int column, const drop::State& state, double f_n, bool was_closed,
                 const drop::Parameters& parameters, const MeasureSettings& settings);

// `columns` of them are good, `last` is the last of these.
DropMeasures drop_measures(const NotedColumns& noted, const drop::State& start, const drop::State& last, int columns,
                           DropStatus status, const drop::Parameters& parameters);

// Side of a body that is up, by the number of quarter turns next to theta [rad], modulo 4: see DropMeasures::face.
std::int32_t face_up(double theta);

// Of a drop that was not computed: NaN, 0 and -1.
DropMeasures no_measures();

}  // namespace tumble::batch
