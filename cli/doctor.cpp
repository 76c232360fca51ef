// `tumble doctor`: what the program is made of, and whether it computes what it computes everywhere.
#include <filesystem>
#include <system_error>

#include "commands.hpp"
#include "input.hpp"
#include "json.hpp"

#include "tumble/batch/parallel.hpp"
#include "tumble/batch/reference_run.hpp"
#include "tumble/math/format.hpp"
#include "tumble/output/versions.hpp"

namespace tumble::cli {
namespace {

#if defined(__clang__)
constexpr const char* k_compiler = "clang " __clang_version__;
#else
constexpr const char* k_compiler = "g++ " __VERSION__;
#endif

struct ReferenceRun {
  InstructionSet set;
  std::uint64_t hash;

  bool is_right() const { return hash == batch::k_reference_hash; }
};

std::vector<ReferenceRun> reference_runs() {
  std::vector<ReferenceRun> runs;
  for (const InstructionSet set : instruction_sets()) runs.push_back({set, batch::reference_hash(set)});
  return runs;
}

std::string page_text() {
  std::error_code ignored;
  const std::filesystem::path page = page_path();
  return std::filesystem::exists(page, ignored) ? page.string() : "absent: `make viewer` builds it, for .html files";
}

std::string text(const std::vector<ReferenceRun>& runs) {
  std::string text = tumble::format("tumble           {}\ncompiler         {}, {}\n", TUMBLE_VERSION, k_compiler,
                                    *TUMBLE_BUILD_TYPE ? TUMBLE_BUILD_TYPE : "no build type");
  for (const auto& [name, version] : output::library_versions()) text += tumble::format("{:<16} {}\n", name, version);
  text += tumble::format("page             {}\ncores            {}\n", page_text(), batch::num_cores());
  text += tumble::format("instruction set  {}\n", to_string(instruction_set()));
  for (const ReferenceRun& run : runs) {
    text +=
        tumble::format("reference run    {:016x}  {:<8} {}\n", run.hash, to_string(run.set),
                       run.is_right() ? "as everywhere" : tumble::format("WRONG: {:016x}", batch::k_reference_hash));
  }
  return text;
}

Json json(const std::vector<ReferenceRun>& runs) {
  Json report = {{"version", TUMBLE_VERSION}, {"compiler", k_compiler}, {"build_type", TUMBLE_BUILD_TYPE}};
  for (const auto& [name, version] : output::library_versions()) report["libraries"][name] = version;
  report["cores"] = batch::num_cores();
  report["instruction_set"] = to_string(instruction_set());
  report["reference_hash"] = tumble::format("{:016x}", batch::k_reference_hash);
  for (const ReferenceRun& run : runs) {
    report["hashes"][std::string(to_string(run.set))] = tumble::format("{:016x}", run.hash);
  }
  return report;
}

}  // namespace

int run_doctor(const ReportOptions& options) {
  const std::vector<ReferenceRun> runs = reference_runs();
  if (options.json) {
    tumble::print("{}", to_text(json(runs)));
  } else if (!options.quiet) {
    tumble::print("{}", text(runs));
  }
  for (const ReferenceRun& run : runs) {
    if (run.is_right()) continue;
    return report_failure(
        tumble::format("{}: the reference run gives {:016x} in place of {:016x}: this build or this machine computes "
                       "other numbers than it should",
                       to_string(run.set), run.hash, batch::k_reference_hash),
        k_numerical_failure);
  }
  return k_done;
}

}  // namespace tumble::cli
