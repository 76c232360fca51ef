#include "commands.hpp"
#include "report.hpp"

#include "tumble/math/format.hpp"

namespace tumble::cli {

int run_drop(const DropOptions& options) {
  const auto& [files, pictures] = options.output;
  require_different(files);
  for (const std::string& file : files) output::check_writable(file, pictures, options.parameters);
  const drop::Record record = drop::simulate_with_record(options.q0, options.v0, options.parameters);
  for (const std::string& file : files) output::write_record(record, file, pictures);
  if (!options.report.quiet) {
    tumble::print("{}", options.report.json ? drop_json(record, files) : drop_text(record, files));
  }
  const auto& [columns, q, v, status] = record.trajectory;
  if (status == LcpStatus::solved) return k_done;
  return report_failure(tumble::format("step {} of {} left the range of double arithmetic: status {}", columns,
                                       options.parameters.columns - 1, to_string(status)),
                        k_numerical_failure);
}

}  // namespace tumble::cli
