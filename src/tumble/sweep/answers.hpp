// A sweep in memory: its columns, if they are kept, and what they add up to.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "tumble/sweep/columns.hpp"
#include "tumble/sweep/results.hpp"
#include "tumble/sweep/spec.hpp"
#include "tumble/sweep/statistics.hpp"

namespace tumble::sweep {

struct Answers {
  Spec spec;
  std::vector<Column> columns;  // none if the spec keeps statistics alone
  Statistics statistics;
};

// Runs the sweep without files; the same for any number of threads (0: one for each core). `watch` is called about
// every 20 ms from the calling thread with the number of instances done; what it throws ends the sweep. Throws
// std::bad_alloc if the columns do not fit into memory.
Answers simulate_answers(const Spec& spec, int threads, const std::function<void(std::uint64_t)>& watch = {});

// Of the columns of a sweep with this spec, in any order; others are left out. Throws std::invalid_argument naming the
// column that does not fit.
Answers answers_of(const Spec& spec, std::vector<Column> columns);

// Of statistics alone, as Statistics::to_fields gives them. Throws as Statistics::from_fields.
Answers answers_of(const Spec& spec, std::span<const output::Field> statistics);

// Of folders that hold a finished sweep together.
Answers read_answers(const Chunks& chunks);

}  // namespace tumble::sweep
