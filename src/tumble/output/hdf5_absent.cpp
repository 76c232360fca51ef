// Stands in for hdf5.cpp where the library was not found.
#include <stdexcept>

#include "tumble/output/hdf5.hpp"

namespace tumble::output {
namespace {

[[noreturn]] void refuse() {
  throw std::runtime_error("this build has no HDF5: use .csv or .npz, or build with Debian's libhdf5-dev");
}

}  // namespace

void check_hdf5() { refuse(); }

bool has_hdf5() { return false; }

std::string hdf5_version() { refuse(); }

std::string to_hdf5(const drop::Record&) { refuse(); }
std::string to_hdf5(const Trajectory&) { refuse(); }

void write_table_hdf5(const Table&, const std::filesystem::path&) { refuse(); }

drop::Record parse_record_hdf5(std::string_view, const std::string&) { refuse(); }

}  // namespace tumble::output
