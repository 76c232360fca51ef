#include "commands.hpp"
#include "report.hpp"
#include <fmt/format.h>

namespace tumble::cli {

int run_drop(const DropOptions& options) {
  const auto& [files, pictures] = options.output;
  for (const std::string& file : files) output::check_writable(file, pictures, options.parameters);
  const drop::Record record = drop::simulate_with_record(options.q0, options.v0, options.parameters);
  for (const std::string& file : files) output::write_record(record, file, pictures);
  if (!options.report.quiet) {
    fmt::print("{}", options.report.json ? drop_json(record, files) : drop_text(record, files));
  }
  return record.trajectory.status == LcpStatus::solved ? k_done : k_numerical_failure;
}

}  // namespace tumble::cli
