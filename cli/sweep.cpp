#include <algorithm>
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
#include "sweep_mpi.hpp"

#include "tumble/batch/parallel.hpp"
#include "tumble/math/format.hpp"
#include "tumble/output/file.hpp"
#include "tumble/output/table.hpp"
#include "tumble/scene/limits.hpp"
#include "tumble/sweep/describe.hpp"
#include "tumble/sweep/plan.hpp"
#include "tumble/sweep/results.hpp"
#include "tumble/sweep/run.hpp"
#include "tumble/sweep/sweep_plots.hpp"

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
  const fs::path folder = file == "-" ? fs::path(".") : fs::path(file).parent_path();
  return sweep::parse_spec(read_input(file, sweep::k_max_spec_bytes), input_name(file), [&](const std::string& scene) {
    return output::read_file(folder / scene, k_max_scene_bytes);
  });
}

// The files of the results in a folder.
std::vector<std::string> files_in(const fs::path& folder, sweep::Keep keep) {
  std::vector<std::string> files;
  for (const char* name : {keep == sweep::Keep::columns ? sweep::k_columns_name : sweep::k_statistics_name,
                           sweep::k_table_name, sweep::k_json_name, sweep::k_picture_name}) {
    files.push_back((folder / name).string());
  }
  return files;
}

// Writes the results of a sweep that is complete, and prints what they are. With `file` nothing else is written.
void finish(std::span<const sweep::Folder> folders, const Targets& targets, bool overwrite, int threads,
            const ReportOptions& report) {
  const sweep::Chunks chunks(folders, threads);
  const sweep::Spec& spec = chunks.spec();
  const sweep::Statistics statistics = sweep::merge_statistics(chunks);
  const sweep::Summary summary = sweep::summarise(statistics, sweep::facts_of(spec));
  std::vector<std::string> files = {targets.file.string()};
  if (!targets.file.empty()) {
    sweep::write_results(chunks, statistics, targets.file, overwrite);
  } else {
    fs::create_directories(targets.folder);
    files = files_in(targets.folder, spec.keep);
    for (const std::string& file : files) output::check_target(file, overwrite);
    sweep::write_results(chunks, statistics, files[0], overwrite);
    output::write_file_atomically(files[1], sweep::to_csv(summary), overwrite);
    output::write_file_atomically(files[2], sweep::to_json(summary), overwrite);
    const std::optional<sweep::Fan> fan = sweep::fan_of(spec);
    sweep::write_plot({statistics, summary, fan ? &*fan : nullptr}, files[3], {}, overwrite);
  }
  if (report.quiet) return;
  if (!report.json) {
    tumble::print("{}{}", sweep::to_text(summary), files_text(files));
    return;
  }
  Json json = Json::parse(sweep::to_json(summary));
  json["files"] = files;
  tumble::print("{}", to_text(json));
}

sweep::RunReport compute(const sweep::Folder& folder, const SweepOptions& options, Processes& processes) {
  const InterruptGuard interrupt;
  sweep::RunSettings settings;
  settings.shard = {options.shard - 1, options.shards};
  Progress progress(static_cast<std::int64_t>(sweep::num_instances(folder.spec(), settings.shard)), 1.0, "instances");
  settings.threads = options.threads;
  settings.is_interrupted = [&] { return interrupt.is_interrupted(); };
  settings.progress = [&](std::uint64_t instances) { progress.show(static_cast<std::int64_t>(instances)); };
  return processes.are_many() ? processes.lead(folder, settings) : sweep::run_sweep(folder, settings);
}

void print_faults(const std::vector<std::string>& faults) {
  for (const std::string& fault : faults) tumble::print(stderr, "tumble: {}; computed again\n", fault);
}

int report_shard(const SweepOptions& options, const sweep::RunReport& report, const fs::path& folder) {
  if (options.report.quiet) return k_done;
  if (options.report.json) {
    const Json json = {
        {"shard", options.shard}, {"shards", options.shards}, {"chunks", report.chunks}, {"folder", folder.string()}};
    tumble::print("{}", to_text(json));
    return k_done;
  }
  tumble::print(
      "shard {} of {}: all {} chunks are in {}; `tumble sweep merge` makes the results when all shards are done\n",
      options.shard, options.shards, report.chunks, output::path_text(folder));
  return k_done;
}

int run_sweep(const SweepOptions& options, Processes& processes) {
  batch::require_threads(options.threads);
  const Targets targets = targets_of(options);
  if (!processes.is_first()) {
    processes.help([&] { return sweep::Folder::open_for_helper(targets.folder); });
    return k_done;
  }
  const sweep::Spec spec = read_spec(options.input);
  if (!targets.file.empty()) output::check_table_writable(targets.file, options.overwrite);
  const sweep::Folder folder =
      sweep::Folder::begin(targets.folder, spec, options.overwrite,
                           targets.file.empty() ? sweep::Folder::Use::shared : sweep::Folder::Use::alone);
  const sweep::RunReport report = compute(folder, options, processes);
  print_faults(report.faults);
  if (report.is_interrupted) {
    return report_failure(
        tumble::format("interrupted; the same call goes on with what is in {}", output::path_text(folder.path())),
        k_interrupted);
  }
  if (options.shards > 1) return report_shard(options, report, folder.path());
  const bool is_own = targets.file.empty();  // the results in its folder
  finish({&folder, 1}, targets, options.overwrite || is_own, options.threads, options.report);
  if (!targets.file.empty()) folder.remove();
  return k_done;
}

}  // namespace

int run_sweep(const SweepOptions& options) {
  Processes processes;
  if (!processes.are_many()) return run_sweep(options, processes);
  try {
    return run_sweep(options, processes);
  } catch (const std::exception& error) {
    processes.abort(report_error(error));  // the others would wait
  }
}

int merge_sweep(const MergeOptions& options) {
  batch::require_threads(options.threads);
  std::vector<sweep::Folder> folders;
  for (const std::string& folder : options.folders) folders.push_back(sweep::Folder::open(folder));
  Targets targets;
  bool is_own = false;  // the results in the folder of a sweep are its own
  if (output::is_table_name(options.output)) {
    output::check_table_writable(options.output, options.overwrite);
    targets.file = options.output;
  } else {
    targets.folder = options.output.empty() ? options.folders[0] : options.output;
    is_own = fs::exists(targets.folder) &&
             std::any_of(folders.begin(), folders.end(),
                         [&](const sweep::Folder& folder) { return fs::equivalent(folder.path(), targets.folder); });
  }
  finish(folders, targets, options.overwrite || is_own, options.threads, options.report);
  return k_done;
}

}  // namespace tumble::cli
