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

enum class Found : std::uint8_t { nothing, good, faulty };

// Which chunks are complete; what is wrong with the files of others goes into the report.
std::vector<Found> find_chunks(const Folder& folder, const std::vector<std::uint64_t>& chunks, int threads,
                               const std::function<void()>& watch, RunReport& report) {
  std::vector<Found> found(chunks.size(), Found::nothing);
  std::vector<std::string> faults(chunks.size());
  batch::for_each_chunk(chunks.size(), threads, [&](std::size_t k, std::size_t) {
    watch();
    const std::filesystem::path path = folder.chunk_path(chunks[k]);
    if (!std::filesystem::exists(std::filesystem::symlink_status(path))) return;
    const auto fault = fault_of_chunk_file(path, {folder.spec_fingerprint(), chunks[k]}, num_parts(folder.spec()));
    found[k] = fault ? Found::faulty : Found::good;
    faults[k] = fault.value_or("");
  });
  for (std::size_t k = 0; k < chunks.size(); ++k) {
    if (found[k] == Found::good) ++report.found;
    if (found[k] == Found::faulty) report.faults.push_back(faults[k]);
  }
  return found;
}

void compute_chunk(const Folder& folder, std::uint64_t chunk, const std::function<void()>& watch) {
  const std::vector<std::string> parts = compute_parts(folder.spec(), chunk, watch);
  write_chunk_file(folder.chunk_path(chunk), {folder.spec_fingerprint(), chunk}, parts);
}

}  // namespace

RunReport run_sweep(const Folder& folder, const RunSettings& settings) {
  RunReport report;
  const std::vector<std::uint64_t> chunks = chunks_of(folder.spec(), settings.shard);
  report.chunks = chunks.size();
  const std::function<void()> watch = [&] {
    if (settings.is_interrupted && settings.is_interrupted()) throw Interrupted{};
  };
  try {
    const std::vector<Found> found = find_chunks(folder, chunks, settings.threads, watch, report);
    std::vector<std::uint64_t> missing;
    std::atomic<std::uint64_t> done = 0;
    for (std::size_t k = 0; k < chunks.size(); ++k) {
      if (found[k] != Found::good)
        missing.push_back(chunks[k]);
      else
        done += slice_of_chunk(folder.spec(), chunks[k]).count;
    }
    batch::for_each_chunk(
        missing.size(), settings.threads,
        [&](std::size_t k, std::size_t) {
          watch();
          compute_chunk(folder, missing[k], watch);
          done += slice_of_chunk(folder.spec(), missing[k]).count;
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
