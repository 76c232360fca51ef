// Named arrays, as .npz and .h5 files hold them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace tumble::output {

struct Field {
  std::string name;
  std::string unit;                // "" if it has none
  std::vector<std::size_t> shape;  // the last index runs fastest; empty for a scalar
  // Texts are UTF-8 without zeros.
  std::variant<std::vector<double>, std::vector<std::int32_t>, std::vector<std::int64_t>, std::vector<std::string>>
      values;
};

// The names of an enumeration with the codes 0 to count - 1.
template <class Enum>
std::vector<std::string> names_of_codes(int count) {
  std::vector<std::string> names;
  for (int code = 0; code < count; ++code) names.emplace_back(to_string(static_cast<Enum>(code)));
  return names;
}

}  // namespace tumble::output
