#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "commands.hpp"
#include "input.hpp"
#include "interrupt.hpp"
#include "json.hpp"
#include "progress.hpp"
#include "report.hpp"
#include <fmt/format.h>

#include "tumble/batch/parallel.hpp"
#include "tumble/output/file.hpp"
#include "tumble/output/table.hpp"
#include "tumble/sweep/plan.hpp"
#include "tumble/sweep/results.hpp"
#include "tumble/sweep/run.hpp"

namespace tumble::cli {
namespace {

namespace fs = std::filesystem;

// Where chunks are kept, and where the results go.
struct Targets {
  fs::path folder;
  fs::path file;  // empty: into the folder
};

Targets targets_of(const SweepOptions& options) {
  if (output::is_table_name(options.output)) {
    if (options.shards > 1) throw std::invalid_argument("--output: with --shard it must be a folder");
    return {options.output + ".chunks", options.output};
  }
  if (!options.output.empty()) return {options.output, {}};
  if (options.input == "-") throw std::invalid_argument("--output: must be given where the spec is standard input");
  return {fs::path(options.input).stem().string() + ".sweep", {}};
}

sweep::Spec read_spec(const std::string& file) {
  return sweep::parse_spec(read_input(file, sweep::k_max_spec_bytes), input_name(file));
}

std::string share(std::uint64_t part, std::uint64_t whole) {
  return fmt::format("{} ({:.4g} %)", part, 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

std::string counts_text(const sweep::Counts& counts) {
  const auto [solved, numerical, invalid] = counts.by_status;
  std::string text =
      fmt::format("{} instances: {} solved, {} numerical, {} invalid\n", counts.instances, solved, numerical, invalid);
  if (solved == 0) return text;
  text += "side of the square that is up at the end:";
  const char* names[] = {"+y", "+x", "-y", "-x"};
  for (std::size_t k = 0; k < 4; ++k)
    text += fmt::format("{} {} {}", k ? "," : "", names[k], share(counts.by_face[k], solved));
  return text + "\n";
}

std::string counts_json(const sweep::Counts& counts, const std::vector<std::string>& files) {
  const auto [solved, numerical, invalid] = counts.by_status;
  const Json report = {{"instances", counts.instances},
                       {"status", {{"solved", solved}, {"numerical", numerical}, {"invalid", invalid}}},
                       {"face", counts.by_face},
                       {"files", files}};
  return to_text(report);
}

// Writes the results of a sweep that is complete, and prints what they are.
void finish(std::span<const sweep::Folder> folders, const fs::path& file, bool overwrite, int threads,
            const ReportOptions& report) {
  const sweep::Chunks chunks(folders, threads);
  sweep::write_columns(chunks, file, overwrite);
  if (report.quiet) return;
  const sweep::Counts counts = sweep::count(chunks);
  const std::vector<std::string> files = {file.string()};
  fmt::print("{}", report.json ? counts_json(counts, files) : counts_text(counts) + files_text(files));
}

sweep::RunReport compute(const sweep::Folder& folder, const SweepOptions& options) {
  const InterruptGuard interrupt;
  const sweep::Spec& spec = folder.spec();
  Progress progress(static_cast<std::int64_t>(sweep::num_instances(spec) / options.shards), 1.0, "instances");
  sweep::RunSettings settings;
  settings.shard = {options.shard - 1, options.shards};
  settings.threads = options.threads;
  settings.is_interrupted = [&] { return interrupt.is_interrupted(); };
  settings.progress = [&](std::uint64_t instances) { progress.show(static_cast<std::int64_t>(instances)); };
  return sweep::run_sweep(folder, settings);
}

void print_faults(const std::vector<std::string>& faults) {
  for (const std::string& fault : faults) fmt::print(stderr, "tumble: {}; computed again\n", fault);
}

int report_shard(const SweepOptions& options, const sweep::RunReport& report, const fs::path& folder) {
  if (options.report.quiet) return k_done;
  if (options.report.json) {
    const Json json = {
        {"shard", options.shard}, {"shards", options.shards}, {"chunks", report.chunks}, {"folder", folder.string()}};
    fmt::print("{}", to_text(json));
    return k_done;
  }
  fmt::print(
      "shard {} of {}: all {} chunks are in {}; `tumble sweep merge` makes the results when all shards are done\n",
      options.shard, options.shards, report.chunks, output::path_text(folder));
  return k_done;
}

}  // namespace

int run_sweep(const SweepOptions& options) {
  batch::require_threads(options.threads);
  const Targets targets = targets_of(options);
  const sweep::Spec spec = read_spec(options.input);
  if (!targets.file.empty()) output::check_table_writable(targets.file, options.overwrite);
  const sweep::Folder folder = sweep::Folder::begin(targets.folder, spec, options.overwrite);
  const sweep::RunReport report = compute(folder, options);
  print_faults(report.faults);
  if (report.is_interrupted) {
    return report_failure(
        fmt::format("interrupted; the same call goes on with what is in {}", output::path_text(folder.path())),
        k_interrupted);
  }
  if (options.shards > 1) return report_shard(options, report, folder.path());
  if (targets.file.empty()) {
    finish({&folder, 1}, folder.path() / sweep::k_columns_name, true, options.threads, options.report);
  } else {
    finish({&folder, 1}, targets.file, options.overwrite, options.threads, options.report);
    folder.remove();
  }
  return k_done;
}

int merge_sweep(const MergeOptions& options) {
  batch::require_threads(options.threads);
  std::vector<sweep::Folder> folders;
  for (const std::string& folder : options.folders) folders.push_back(sweep::Folder::open(folder));
  if (output::is_table_name(options.output)) {
    finish(folders, options.output, options.overwrite, options.threads, options.report);
    return k_done;
  }
  const fs::path target = options.output.empty() ? fs::path(options.folders[0]) : fs::path(options.output);
  fs::create_directories(target);
  finish(folders, target / sweep::k_columns_name, true, options.threads, options.report);
  return k_done;
}

}  // namespace tumble::cli
