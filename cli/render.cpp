#include "commands.hpp"
#include "report.hpp"

#include "tumble/math/format.hpp"

namespace tumble::cli {

int run_render(const RenderOptions& options) {
  const auto& [files, pictures] = options.output;
  require_different(files);
  for (const std::string& file : files) output::check_writable(file, pictures);
  const drop::Record record = output::read_record(options.input);
  for (const std::string& file : files) output::write_record(record, file, pictures);
  if (options.report.quiet) return k_done;
  if (options.report.json) {
    tumble::print("{}", drop_json(record, files));
  } else {
    tumble::print("read {}: {} columns; wrote {}\n", options.input, record.trajectory.columns,
                  tumble::join(files, ", "));
  }
  return k_done;
}

}  // namespace tumble::cli
