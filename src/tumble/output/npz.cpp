#include "tumble/output/npz.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <stdexcept>

#include "tumble/math/format.hpp"
#include "tumble/output/npy.hpp"
#include "tumble/output/record_fields.hpp"
#include "tumble/output/trajectory_fields.hpp"
#include "tumble/output/zip.hpp"

namespace tumble::output {
namespace {

// The layout of .npy: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
constexpr std::string_view k_magic = "\x93NUMPY";
constexpr std::size_t k_alignment = 64;
constexpr std::size_t k_max_header = 1 << 16;

// ---- Writing ----

// The bytes of one value in little-endian order, whatever the machine's own.
template <class Value, class Bits>
void put_value(std::string& bytes, Value value) {
  static_assert(sizeof(Value) == sizeof(Bits));
  Bits bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  char little[sizeof(Bits)];
  for (std::size_t i = 0; i < sizeof(Bits); ++i) little[i] = static_cast<char>((bits >> (8 * i)) & 0xff);
  bytes.append(little, sizeof(Bits));
}

// The characters of UTF-8 text without faults.
std::vector<std::uint32_t> characters(const std::string& text) {
  std::vector<std::uint32_t> points;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xc0u) == 0x80u) {  // one more of the six bits
      points.back() = points.back() << 6u | (byte & 0x3fu);
    } else {
      points.push_back(byte < 0x80u ? byte : byte & (byte < 0xe0u ? 0x1fu : byte < 0xf0u ? 0x0fu : 0x07u));
    }
  }
  return points;
}

struct NpyBody {
  std::string operator()(const std::vector<double>& values) const { return numbers<std::uint64_t>("<f8", values); }
  std::string operator()(const std::vector<std::int32_t>& values) const {
    return numbers<std::uint32_t>("<i4", values);
  }
  std::string operator()(const std::vector<std::int64_t>& values) const {
    return numbers<std::uint64_t>("<i8", values);
  }
  // Text of numpy: fixed width, 4 bytes a character, zeros behind.
  std::string operator()(const std::vector<std::string>& values) const {
    std::vector<std::vector<std::uint32_t>> texts;
    std::size_t width = 1;
    for (const std::string& value : values) {
      texts.push_back(characters(value));
      width = std::max(width, texts.back().size());
    }
    std::string bytes = npy_header(tumble::format("<U{}", width), shape);
    for (std::vector<std::uint32_t>& text : texts) {
      text.resize(width, 0u);
      for (const std::uint32_t character : text) put_value<std::uint32_t, std::uint32_t>(bytes, character);
    }
    return bytes;
  }

  template <class Bits, class Value>
  std::string numbers(const std::string& descr, const std::vector<Value>& values) const {
    std::string bytes = npy_header(descr, shape);
    bytes.reserve(bytes.size() + sizeof(Value) * values.size());
    for (const Value value : values) put_value<Value, Bits>(bytes, value);
    return bytes;
  }

  const std::vector<std::size_t>& shape;
};

std::string to_npz(const std::vector<Field>& fields) {
  ZipWriter zip;
  for (const Field& field : fields) zip.add(field.name + ".npy", to_npy(field));
  return zip.finish();
}

// ---- Reading ----

[[noreturn]] void refuse(const std::string& place, std::string_view why) {
  throw std::invalid_argument(tumble::format("{}: {}", place, why));
}

struct NpyHeader {
  char order = '<';  // '<' little-endian, '>' big-endian
  char kind = 'f';   // 'f' real, 'i' integer, 'u' unsigned, 'b' bool
  std::size_t width = 8;
  bool is_fortran = false;
  std::vector<std::size_t> shape;
  std::size_t values = 1;
};

// What follows "'key':" in the dictionary, up to `end`; nothing if the key is absent.
std::optional<std::string_view> entry_of(std::string_view dictionary, std::string_view key, char end) {
  for (const char quote : {'\'', '"'}) {
    const std::string quoted = tumble::format("{0}{1}{0}:", quote, key);
    const std::size_t at = dictionary.find(quoted);
    if (at == std::string_view::npos) continue;
    const std::string_view rest = dictionary.substr(at + quoted.size());
    const std::size_t stop = rest.find(end);
    if (stop == std::string_view::npos) return std::nullopt;
    const std::size_t start = rest.find_first_not_of(' ');
    return rest.substr(std::min(start, stop), stop - std::min(start, stop));
  }
  return std::nullopt;
}

std::optional<std::size_t> parse_size(std::string_view text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// "(3, 150" with or without a comma behind.
void parse_shape(std::string_view text, NpyHeader& header, const std::string& place) {
  if (!text.starts_with('(')) refuse(place, "its npy header has no shape");
  text.remove_prefix(1);
  while (!text.empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    std::string_view word = text.substr(0, comma);
    text.remove_prefix(std::min(comma + 1, text.size()));
    word.remove_prefix(std::min(word.find_first_not_of(' '), word.size()));
    if (word.empty() && text.empty()) break;
    const std::optional<std::size_t> size = parse_size(word);
    if (!size || header.shape.size() == 2) refuse(place, "must have at most two dimensions");
    if (*size > max_values_read() || (*size > 0 && header.values > max_values_read() / *size)) {
      refuse(place, tumble::format("is too large: at most {} values are read", max_values_read()));
    }
    header.values *= *size;
    header.shape.push_back(*size);
  }
}

NpyHeader parse_dictionary(std::string_view dictionary, const std::string& place) {
  NpyHeader header;
  const std::optional<std::string_view> descr = entry_of(dictionary, "descr", ',');
  const std::optional<std::string_view> fortran = entry_of(dictionary, "fortran_order", ',');
  const std::optional<std::string_view> shape = entry_of(dictionary, "shape", ')');
  if (!descr || !fortran || !shape) refuse(place, "its npy header lacks descr, fortran_order or shape");
  if (descr->size() < 5) refuse(place, "must hold numbers");
  header.order = (*descr)[1];
  header.kind = (*descr)[2];
  header.width = parse_size(descr->substr(3, descr->size() - 4)).value_or(0);
  const bool is_number = (header.kind == 'f' && (header.width == 4 || header.width == 8)) ||
                         ((header.kind == 'i' || header.kind == 'u') &&
                          (header.width == 1 || header.width == 2 || header.width == 4 || header.width == 8)) ||
                         (header.kind == 'b' && header.width == 1);
  if (!is_number || std::string_view("<>|").find(header.order) == std::string_view::npos) {
    refuse(place, "must hold real or whole numbers of at most 8 bytes");
  }
  header.is_fortran = *fortran == "True";
  parse_shape(*shape, header, place);
  return header;
}

double value_at(const NpyHeader& header, const unsigned char* bytes) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < header.width; ++i) {
    const std::size_t at = header.order == '>' ? header.width - 1 - i : i;
    bits |= static_cast<std::uint64_t>(bytes[at]) << (8 * i);
  }
  if (header.kind == 'f' && header.width == 8) {
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  }
  if (header.kind == 'f') {
    const auto half = static_cast<std::uint32_t>(bits);
    float value = 0.0F;
    std::memcpy(&value, &half, sizeof(value));
    return static_cast<double>(value);
  }
  if (header.kind != 'i') return static_cast<double>(bits);
  const std::uint64_t sign = std::uint64_t{1} << (8 * header.width - 1);
  return static_cast<double>(static_cast<std::int64_t>((bits ^ sign) - sign));
}

NumberArray parse_npy(std::string_view bytes, const std::string& place) {
  if (!bytes.starts_with(k_magic) || bytes.size() < k_magic.size() + 6) refuse(place, "is not an npy array");
  const auto byte = [&](std::size_t at) { return static_cast<std::size_t>(static_cast<unsigned char>(bytes[at])); };
  const std::size_t version = byte(6);
  if (version < 1 || version > 3) refuse(place, tumble::format("has npy version {}, allowed are 1 to 3", version));
  const std::size_t start = version == 1 ? 10 : 12;
  const std::size_t size = byte(8) + (byte(9) << 8) + (version == 1 ? 0 : (byte(10) << 16) + (byte(11) << 24));
  if (size > k_max_header || bytes.size() - start < size) refuse(place, "its npy header is broken");
  const NpyHeader header = parse_dictionary(bytes.substr(start, size), place);
  const std::string_view body = bytes.substr(start + size);
  if (body.size() != header.values * header.width) {
    refuse(place, tumble::format("must have {} bytes for shape ({}), got {}", header.values * header.width,
                                 tumble::join(header.shape, ", "), body.size()));
  }
  NumberArray array{header.shape, std::vector<double>(header.values)};
  const bool is_transposed = header.is_fortran && header.shape.size() == 2;
  const auto* data = reinterpret_cast<const unsigned char*>(body.data());
  for (std::size_t i = 0; i < header.values; ++i) {
    const std::size_t at = is_transposed ? (i % header.shape[1]) * header.shape[0] + i / header.shape[1] : i;
    array.values[i] = value_at(header, data + at * header.width);
  }
  return array;
}

}  // namespace

std::string npy_header(const std::string& descr, const std::vector<std::size_t>& shape) {
  std::string dictionary = tumble::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}{}), }}", descr,
                                          tumble::join(shape, ", "), shape.size() == 1 ? "," : "");
  const std::size_t before = k_magic.size() + 4;
  const std::size_t used = before + dictionary.size() + 1;
  dictionary.append((k_alignment - used % k_alignment) % k_alignment, ' ');
  dictionary += '\n';
  std::string header(k_magic);
  header += '\x01';
  header += '\x00';
  header += static_cast<char>(dictionary.size() & 0xff);
  header += static_cast<char>(dictionary.size() >> 8);
  return header + dictionary;
}

std::string to_npy(const Field& field) { return std::visit(NpyBody{field.shape}, field.values); }

std::string to_npz(const drop::Record& record) { return to_npz(to_fields(record)); }

std::string to_npz(const Trajectory& trajectory) { return to_npz(to_fields(trajectory)); }

drop::Record parse_record_npz(std::string_view bytes, const std::string& name) {
  const std::vector<std::string> wanted = field_names_read();
  std::map<std::string, NumberArray> fields;
  for (const ZipEntry& entry : read_zip_directory(bytes, name)) {
    if (!entry.name.ends_with(".npy")) continue;
    const std::string field = entry.name.substr(0, entry.name.size() - 4);
    if (std::find(wanted.begin(), wanted.end(), field) == wanted.end()) continue;
    const std::string place = tumble::format("{}: {}", name, field);
    if (fields.contains(field)) refuse(place, "is there twice");
    fields[field] = parse_npy(extract(entry, 8 * max_values_read() + k_max_header, name), place);
  }
  return from_fields(fields, name);
}

}  // namespace tumble::output
