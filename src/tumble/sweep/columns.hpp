// What a sweep gives: named columns with a row for each instance, and the axes that its cells lie on.
#pragma once

#include <string>
#include <vector>

namespace tumble::sweep {

struct Column {
  std::string name;
  std::string unit;  // "" if it has none
  std::vector<double> values;
  bool is_whole = false;  // whole numbers in the range of 32 bits, and so in files
};

// Values of a quantity in the order of the cells.
struct Axis {
  std::string name;
  std::string unit;
  std::vector<double> values;
};

}  // namespace tumble::sweep
