#include "tumble/output/versions.hpp"

#include <cairo.h>
#include <gif_lib.h>
#include <zlib.h>

#include "tumble/math/format.hpp"
#include "tumble/output/hdf5.hpp"

namespace tumble::output {

std::vector<std::pair<std::string, std::string>> library_versions() {
  return {{"zlib", zlibVersion()},
          {"cairo", cairo_version_string()},
          {"giflib", tumble::format("{}.{}.{}", GIFLIB_MAJOR, GIFLIB_MINOR, GIFLIB_RELEASE)},
          {"HDF5", has_hdf5() ? hdf5_version() : "absent"}};
}

}  // namespace tumble::output
