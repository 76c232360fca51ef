#include "tumble/sweep/run.hpp"

#include <atomic>

#include "tumble/batch/parallel.hpp"
#include "tumble/sweep/chunk_file.hpp"
#include "tumble/sweep/chunk_parts.hpp"
#include "tumble/sweep/plan.hpp"

namespace tumble::sweep {
namespace {

struct Interrupted {};

std::vector<std::uint64_t> chunks_of(const Spec& spec, const Shard& shard) {
  std::vector<std::uint64_t> chunks;
  for (std::uint64_t chunk = shard.index; chunk < num_chunks(spec); chunk += shard.count) chunks.push_back(chunk);
  return chunks;
}

std::uint64_t num_instances_in(const Spec& spec, const std::vector<std::uint64_t>& chunks) {
  std::uint64_t sum = 0;
  for (const std::uint64_t chunk : chunks) sum += slice_of_chunk(spec, chunk).count;
  return sum;
}

std::function<void()> interruption(const RunSettings& settings) {
  return [&settings] {
    if (settings.is_interrupted && settings.is_interrupted()) throw Interrupted{};
  };
}

}  // namespace

std::uint64_t num_instances(const Spec& spec, const Shard& shard) {
  return num_instances_in(spec, chunks_of(spec, shard));
}

std::vector<std::uint64_t> find_missing(const Folder& folder, const RunSettings& settings, RunReport& report) {
  const std::vector<std::uint64_t> chunks = chunks_of(folder.spec(), settings.shard);
  const std::function<void()> watch = interruption(settings);
  std::vector<std::string> faults(chunks.size());
  std::vector<char> is_good(chunks.size(), 0);
  batch::for_each_chunk(chunks.size(), settings.threads, [&](std::size_t k, std::size_t) {
    watch();
    const std::filesystem::path path = folder.chunk_path(chunks[k]);
    if (!std::filesystem::exists(std::filesystem::symlink_status(path))) return;
    const auto fault = fault_of_chunk_file(path, {folder.spec_fingerprint(), chunks[k]}, num_parts(folder.spec()));
    is_good[k] = !fault;
    faults[k] = fault.value_or("");
  });
  std::vector<std::uint64_t> missing;
  for (std::size_t k = 0; k < chunks.size(); ++k) {
    if (!faults[k].empty()) report.faults.push_back(faults[k]);
    if (!is_good[k]) missing.push_back(chunks[k]);
  }
  report.chunks = chunks.size();
  report.found = chunks.size() - missing.size();
  return missing;
}

void compute_chunk(const Folder& folder, std::uint64_t chunk, const std::function<void()>& watch) {
  const std::vector<std::string> parts = compute_parts(folder.spec(), chunk, watch);
  write_chunk_file(folder.chunk_path(chunk), {folder.spec_fingerprint(), chunk}, parts);
}

RunReport run_sweep(const Folder& folder, const RunSettings& settings) {
  RunReport report;
  const std::function<void()> watch = interruption(settings);
  try {
    const std::vector<std::uint64_t> missing = find_missing(folder, settings, report);
    const Spec& spec = folder.spec();
    std::atomic<std::uint64_t> done = num_instances(spec, settings.shard) - num_instances_in(spec, missing);
    batch::for_each_chunk(
        missing.size(), settings.threads,
        [&](std::size_t k, std::size_t) {
          watch();
          compute_chunk(folder, missing[k], watch);
          done += slice_of_chunk(spec, missing[k]).count;
        },
        [&](std::size_t) {
          if (settings.progress) settings.progress(done);
        });
  } catch (const Interrupted&) {
    report.is_interrupted = true;
  }
  return report;
}

}  // namespace tumble::sweep
