// Runs blocks of drops from their starts to their results. Not a public header.
#pragma once

#include <array>
#include <cstddef>

#include "tumble/batch/column_writer.hpp"
#include "tumble/batch/drop_lanes.hpp"
#include "tumble/batch/simulate_batch.hpp"
#include "tumble/drop/drop.hpp"

namespace tumble::batch {

// The drops of a block go side by side through `advance_drops`; those that are not ordinary are computed again, one by
// one. Each thread has a runner of its own.
template <class Real>
class BlockRunner {
 public:
  // All of it is valid and outlives the runner, but for `common`, which is copied: the parameters of all drops, or null
  // if drops have their own.
  BlockRunner(const DropStarts<Real>& starts, const DropParameters& parameters, const drop::Parameters* common,
              const BatchSettings& settings, const DropResults<Real>& results);

  // Drops [first, first + count), 1 <= count <= most_drops(settings.every), from their starts to all their results.
  void run(std::size_t first, std::size_t count);

  static constexpr std::size_t most_drops(int every) {
    return every == 0 ? DropBlock<Real>::k_capacity : ColumnWriter<Real>::k_most_drops;
  }

 private:
  drop::Parameters parameters_of(std::size_t i) const;
  drop::State start_of(std::size_t i) const;
  void put_parameters(std::size_t j, const drop::Parameters& p);
  void put_parameters_of_all();
  void put_state(std::size_t j, const Vector3& q, const Vector3& v);
  void load(std::size_t first, std::size_t count);
  void note(std::size_t i, std::size_t j);
  void advance_and_keep(std::size_t first, std::size_t count, const MeasureBounds<Real>* bounds);
  void finish(std::size_t i, std::size_t j);
  void run_alone(std::size_t i);
  void tell(std::size_t i, DropStatus status, int columns, const std::array<Real, 6>& last);
  void put_column(std::size_t i, std::size_t kept_column, const drop::State& state);
  void fill_rows(std::size_t i, std::size_t from);

  const DropStarts<Real>& starts_;
  const DropParameters& parameters_;
  const BatchSettings& settings_;
  const DropResults<Real>& results_;
  AdvanceDrops<Real>* advance_;
  MeasureBounds<Real> bounds_;
  bool has_common_parameters_;
  drop::Parameters common_;  // those of all drops; the document's if drops have their own
  bool is_valid_[DropBlock<Real>::k_capacity];
  DropBlock<Real> block_;
  alignas(64) Real numbers_[6 * DropBlock<Real>::k_capacity];
  States<Real> states_{numbers_, DropBlock<Real>::k_capacity};
  ColumnWriter<Real> writer_;
};

}  // namespace tumble::batch
