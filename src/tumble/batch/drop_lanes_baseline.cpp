#include "tumble/batch/drop_lanes_impl.hpp"

void tumble::batch::advance_drops_baseline(DropBlock<double>& block, States<double> from, States<double> to,
                                           std::size_t size, int first_column, int num_steps,
                                           const MeasureBounds<double>* bounds) {
  advance<Lanes<double, 2>>(block, from, to, size, first_column, num_steps, bounds);
}

void tumble::batch::advance_drops_baseline(DropBlock<float>& block, States<float> from, States<float> to,
                                           std::size_t size, int first_column, int num_steps,
                                           const MeasureBounds<float>* bounds) {
  advance<Lanes<float, 4>>(block, from, to, size, first_column, num_steps, bounds);
}
