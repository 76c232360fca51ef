#include "tumble/sweep/answers.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "tumble/batch/parallel.hpp"
#include "tumble/math/format.hpp"
#include "tumble/sweep/chunk_file.hpp"
#include "tumble/sweep/chunk_parts.hpp"
#include "tumble/sweep/describe.hpp"
#include "tumble/sweep/plan.hpp"
#include "tumble/sweep/slice.hpp"

namespace tumble::sweep {
namespace {

// Merges statistics of chunks in their order, whatever the order in which they come.
class OrderedFold {
 public:
  explicit OrderedFold(Statistics& sum) : sum_(sum) {}

  void add(std::uint64_t chunk, Statistics statistics) {
    const std::lock_guard lock(mutex_);
    waiting_.emplace(chunk, std::move(statistics));
    for (auto next = waiting_.find(next_); next != waiting_.end(); next = waiting_.find(next_)) {
      sum_.merge(next->second);
      waiting_.erase(next);
      ++next_;
    }
  }

 private:
  Statistics& sum_;
  std::mutex mutex_;
  std::map<std::uint64_t, Statistics> waiting_;
  std::uint64_t next_ = 0;
};

Answers begin(const Spec& spec) {
  Answers answers{spec, {}, Statistics(layout_of(spec))};
  if (spec.keep == Keep::statistics) return answers;
  answers.columns = empty_columns(spec);
  for (Column& column : answers.columns) column.values.resize(num_instances(spec));
  return answers;
}

void put(Answers& answers, const std::vector<Column>& chunk, const Slice& slice) {
  for (std::size_t k = 0; k < answers.columns.size(); ++k) {
    std::copy(chunk[k].values.begin(), chunk[k].values.end(),
              answers.columns[k].values.begin() + static_cast<std::ptrdiff_t>(slice.first));
  }
}

}  // namespace

Answers simulate_answers(const Spec& spec, int threads, const std::function<void(std::uint64_t)>& watch) {
  Answers answers = begin(spec);
  OrderedFold fold(answers.statistics);
  std::atomic<std::uint64_t> done = 0;
  std::atomic<bool> is_ended = false;
  struct Ended {};
  const auto tell = [&](std::size_t) {
    try {
      if (watch) watch(done);
    } catch (...) {
      is_ended = true;
      throw;
    }
  };
  const auto columns_of = [&](const Slice& piece) {
    std::vector<Column> columns = simulate_slice(spec, piece, [&] {
      if (is_ended) throw Ended{};
    });
    put(answers, columns, piece);
    done += piece.count;
    return columns;
  };
  const auto work = [&](std::size_t chunk, std::size_t) {
    try {
      fold.add(chunk, add_up_chunk(spec, chunk, columns_of));
    } catch (const Ended&) {  // what `watch` threw comes out
    }
  };
  batch::for_each_chunk(num_chunks(spec), threads, work, tell);
  return answers;
}

Answers answers_of(const Spec& spec, std::vector<Column> columns) {
  Answers answers{spec, empty_columns(spec), Statistics(layout_of(spec))};
  for (Column& column : answers.columns) {
    const auto found =
        std::find_if(columns.begin(), columns.end(), [&](const Column& other) { return other.name == column.name; });
    if (found == columns.end()) throw std::invalid_argument(tumble::format("{}: is missing", column.name));
    if (found->values.size() != num_instances(spec)) {
      throw std::invalid_argument(tumble::format("{}: must have {} rows, as the spec has instances, has {}",
                                                 column.name, num_instances(spec), found->values.size()));
    }
    column.values = std::move(found->values);
  }
  for (std::uint64_t chunk = 0; chunk < num_chunks(spec); ++chunk) {
    answers.statistics.merge(add_up_chunk(spec, chunk, [&](const Slice& piece) {
      std::vector<Column> slice = empty_columns(spec);
      for (std::size_t k = 0; k < slice.size(); ++k) {
        const auto start = answers.columns[k].values.begin() + static_cast<std::ptrdiff_t>(piece.first);
        slice[k].values.assign(start, start + static_cast<std::ptrdiff_t>(piece.count));
      }
      return slice;
    }));
  }
  return answers;
}

Answers answers_of(const Spec& spec, std::span<const output::Field> statistics) {
  return {spec, {}, Statistics::from_fields(layout_of(spec), statistics)};
}

Answers read_answers(const Chunks& chunks) {
  const Spec& spec = chunks.spec();
  Answers answers = begin(spec);
  answers.statistics = merge_statistics(chunks);
  for (std::uint64_t chunk = 0; chunk < num_chunks(spec); ++chunk) {
    const Slice slice = slice_of_chunk(spec, chunk);
    for (std::size_t k = 0; k < answers.columns.size(); ++k) {
      Column& column = answers.columns[k];
      const std::vector<double> values = from_bytes(chunks.read(chunk, k_first_column_part + k), column.is_whole);
      if (values.size() != slice.count) {
        throw std::runtime_error(
            tumble::format("chunk {}: {}: must have {} rows, has {}", chunk, column.name, slice.count, values.size()));
      }
      std::copy(values.begin(), values.end(), column.values.begin() + static_cast<std::ptrdiff_t>(slice.first));
    }
  }
  return answers;
}

}  // namespace tumble::sweep
