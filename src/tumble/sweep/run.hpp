// Computes what is missing in the folder of a sweep.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tumble/sweep/folder.hpp"

namespace tumble::sweep {

// Chunk c belongs to shard c mod `count`; `index` in [0, count).
struct Shard {
  std::uint64_t index = 0;
  std::uint64_t count = 1;
};

// Of all chunks of the shard.
std::uint64_t num_instances(const Spec& spec, const Shard& shard);

struct RunSettings {
  Shard shard{};
  int threads = 0;                         // 0: one for each core
  std::function<bool()> is_interrupted{};  // asked often, from all threads; once it is true the run ends
  // Called now and then from the calling thread with the number of instances of the shard that are done.
  std::function<void(std::uint64_t instances)> progress{};
};

struct RunReport {
  std::uint64_t chunks = 0;         // of the shard
  std::uint64_t found = 0;          // of these, complete from an earlier run
  std::vector<std::string> faults;  // why files of chunks were computed again, "path: reason"
  bool is_interrupted = false;      // chunks are missing then
};

// The two halves of run_sweep, for those who share chunks out in another way.
// Chunks of the shard that have no good file; the report tells of the others.
std::vector<std::uint64_t> find_missing(const Folder& folder, const RunSettings& settings, RunReport& report);
// Simulates the chunk and writes its file. Throws std::system_error if it cannot be written, and what `watch`, which is
// called now and then, throws.
void compute_chunk(const Folder& folder, std::uint64_t chunk, const std::function<void()>& watch);

// Each chunk that is finished stays, whatever comes then; the folder is the same for any number of threads. Throws
// std::system_error if a file cannot be written.
RunReport run_sweep(const Folder& folder, const RunSettings& settings);

}  // namespace tumble::sweep
