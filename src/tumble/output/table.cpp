#include "tumble/output/table.hpp"

#include <stdexcept>

#include "tumble/math/format.hpp"
#include "tumble/output/file.hpp"
#include "tumble/output/hdf5.hpp"
#include "tumble/output/npy.hpp"
#include "tumble/output/zip_stream.hpp"

namespace tumble::output {
namespace {

void write_npz(const Table& table, OutputFile& file) {
  ZipStream zip([&](std::string_view bytes) { file.write(bytes); });
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    const auto& [name, unit, is_whole] = table.columns[k];
    const std::string header = npy_header(is_whole ? "<i4" : "<f8", {table.rows});
    zip.begin(name + ".npy", header.size() + table.rows * (is_whole ? 4 : 8));
    zip.write(header);
    table.read(k, [&](std::string_view bytes) { zip.write(bytes); });
    zip.end();
  }
  for (const Field& field : table.notes) {
    const std::string bytes = to_npy(field);
    zip.begin(field.name + ".npy", bytes.size());
    zip.write(bytes);
    zip.end();
  }
  zip.finish();
}

}  // namespace

void write_table(const Table& table, const std::filesystem::path& path, bool overwrite) {
  check_table_writable(path, overwrite);
  const bool is_hdf5 = ending_of(path) == ".h5";
  OutputFile file(path, overwrite, is_hdf5);
  if (is_hdf5) {
    write_table_hdf5(table, file.working_path());
  } else {
    write_npz(table, file);
  }
  file.commit();
}

void check_table_writable(const std::filesystem::path& path, bool overwrite) {
  if (!is_table_name(path)) {
    throw std::invalid_argument(tumble::format("{}: the name must end in .npz or .h5", path_text(path)));
  }
  if (ending_of(path) == ".h5") check_hdf5();
  check_target(path, overwrite);
  if (is_direct_target(path) && ending_of(path) == ".h5") {
    throw std::invalid_argument(tumble::format("{}: an .h5 can only be written to a regular file", path_text(path)));
  }
}

bool is_table_name(const std::filesystem::path& path) { return ending_of(path) == ".npz" || ending_of(path) == ".h5"; }

}  // namespace tumble::output
