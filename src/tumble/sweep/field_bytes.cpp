// For each field: the length of its name, the name, the type of its numbers, the number of dimensions, these, the
// numbers. Lengths are little-endian words of 64 bits.
#include "tumble/sweep/field_bytes.hpp"

#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace tumble::sweep {
namespace {

using output::Field;

void put(std::string& bytes, std::uint64_t word) { bytes.append(reinterpret_cast<const char*>(&word), sizeof(word)); }

class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  bool is_done() const { return bytes_.empty(); }

  std::uint64_t word() {
    std::uint64_t value = 0;
    std::memcpy(&value, take(sizeof(value)).data(), sizeof(value));
    return value;
  }

  std::string_view take(std::uint64_t count) {
    if (count > bytes_.size()) throw std::invalid_argument("arrays are cut off");
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }

  template <class Number>
  std::vector<Number> numbers(std::uint64_t count) {
    if (count > bytes_.size()) throw std::invalid_argument("arrays are cut off");
    std::vector<Number> values(count);
    if (count > 0) std::memcpy(values.data(), take(count * sizeof(Number)).data(), count * sizeof(Number));
    return values;
  }

 private:
  std::string_view bytes_;
};

}  // namespace

std::string to_bytes(std::span<const Field> fields) {
  std::string bytes;
  for (const Field& field : fields) {
    put(bytes, field.name.size());
    bytes += field.name;
    put(bytes, field.values.index());
    put(bytes, field.shape.size());
    for (const std::size_t size : field.shape) put(bytes, size);
    std::visit(
        [&](const auto& values) {
          using Number = typename std::decay_t<decltype(values)>::value_type;
          if constexpr (std::is_arithmetic_v<Number>) {
            put(bytes, values.size());
            bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Number));
          } else {
            throw std::logic_error("texts are not stored");
          }
        },
        field.values);
  }
  return bytes;
}

std::vector<Field> fields_from_bytes(std::string_view bytes) {
  Reader reader(bytes);
  std::vector<Field> fields;
  while (!reader.is_done()) {
    Field field;
    field.name = reader.take(reader.word());
    const std::uint64_t type = reader.word();
    for (const std::uint64_t size : reader.numbers<std::uint64_t>(reader.word())) field.shape.push_back(size);
    const std::uint64_t count = reader.word();
    if (type == 0) {
      field.values = reader.numbers<double>(count);
    } else if (type == 1) {
      field.values = reader.numbers<std::int32_t>(count);
    } else if (type == 2) {
      field.values = reader.numbers<std::int64_t>(count);
    } else {
      throw std::invalid_argument("arrays are of an unknown type");
    }
    fields.push_back(std::move(field));
  }
  return fields;
}

}  // namespace tumble::sweep
