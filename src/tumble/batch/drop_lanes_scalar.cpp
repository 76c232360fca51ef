#include "tumble/batch/drop_lanes_impl.hpp"

void tumble::batch::advance_drops_scalar(DropBlock<double>& block, std::size_t size, int first_column, int num_steps,
                                         const MeasureBounds<double>* bounds) {
  advance<Lanes<double, 1>>(block, size, first_column, num_steps, bounds);
}

void tumble::batch::advance_drops_scalar(DropBlock<float>& block, std::size_t size, int first_column, int num_steps,
                                         const MeasureBounds<float>* bounds) {
  advance<Lanes<float, 1>>(block, size, first_column, num_steps, bounds);
}
