// What the library was built with and runs with.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tumble::output {

// Name and version of each library that files and pictures need, as loaded now; "absent" for HDF5 in a build without.
std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace tumble::output
