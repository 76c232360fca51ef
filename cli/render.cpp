#include "commands.hpp"
#include "report.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tumble::cli {

int run_render(const RenderOptions& options) {
  const auto& [files, pictures] = options.output;
  require_different(files);
  for (const std::string& file : files) output::check_writable(file, pictures);
  const drop::Record record = output::read_record(options.input);
  for (const std::string& file : files) output::write_record(record, file, pictures);
  if (options.report.quiet) return k_done;
  if (options.report.json) {
    fmt::print("{}", drop_json(record, files));
  } else {
    fmt::print("read {}: {} columns; wrote {}\n", options.input, record.trajectory.columns, fmt::join(files, ", "));
  }
  return k_done;
}

}  // namespace tumble::cli
