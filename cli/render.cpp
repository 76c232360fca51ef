#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.hpp"
#include "report.hpp"
#include "tumble/output/write.hpp"

namespace tumble::cli {

int run_render(const RenderOptions& options) {
  const output::WriteOptions write_options{.overwrite = options.force};
  for (const std::string& path : options.outputs) output::check_writable(path, write_options);
  const drop::Record record = output::read_record(options.input);
  for (const std::string& path : options.outputs) output::write_record(record, path, write_options);
  if (options.report.quiet) return k_done;
  if (options.report.json) {
    fmt::print("{}", drop_json(record, options.outputs));
  } else {
    fmt::print("read {}: {} columns; wrote {}\n", options.input, record.trajectory.columns,
               fmt::join(options.outputs, ", "));
  }
  return k_done;
}

}  // namespace tumble::cli
