#include <fmt/format.h>

#include "commands.hpp"
#include "report.hpp"
#include "tumble/output/write.hpp"

namespace tumble::cli {

int run_drop(const DropOptions& options) {
  const output::WriteOptions write_options{.overwrite = options.force};
  for (const std::string& path : options.outputs) output::check_writable(path, write_options);
  const drop::Record record = drop::simulate_with_record(options.q0, options.v0, options.parameters);
  for (const std::string& path : options.outputs) output::write_record(record, path, write_options);
  if (!options.report.quiet) {
    fmt::print("{}", options.report.json ? drop_json(record, options.outputs) : drop_text(record, options.outputs));
  }
  return record.trajectory.status == LcpStatus::solved ? k_done : k_numerical_failure;
}

}  // namespace tumble::cli
