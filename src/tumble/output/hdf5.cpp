#include "tumble/output/hdf5.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <variant>

#include <hdf5.h>

#include "tumble/math/format.hpp"
#include "tumble/output/record_fields.hpp"
#include "tumble/output/trajectory_fields.hpp"

namespace tumble::output {
namespace {

constexpr std::size_t k_image_growth = 1 << 20;
constexpr hsize_t k_chunk_values = 16384;
constexpr unsigned k_level = 4;

// The serial library keeps global tables: one thread at a time.
std::mutex& library_mutex() {
  static std::mutex mutex;
  return mutex;
}

// While it lives, HDF5 does not print its error stack; the report of others in the process comes back
// afterwards.
class Silence {
 public:
  Silence() {
    // No clean-up at the end of the program either: after a damaged file it prints, and all files here lie in memory.
    [[maybe_unused]] static const herr_t once = H5dont_atexit();
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Silence() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }
  bool is_valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  Close close_;
};

// ---- Writing ----

void require(bool holds, std::string_view action) {
  if (!holds) throw std::runtime_error(tumble::format("HDF5 cannot {}", action));
}

Handle made(hid_t id, Handle::Close close, std::string_view action) {
  require(id >= 0, action);
  return {id, close};
}

Handle text_type(std::size_t width) {
  Handle type = made(H5Tcopy(H5T_C_S1), H5Tclose, "make a text type");
  require(H5Tset_size(type, width) >= 0 && H5Tset_cset(type, H5T_CSET_UTF8) >= 0, "set up a text type");
  return type;
}

void write_units(hid_t dataset, const std::string& unit) {
  const Handle type = text_type(unit.size());
  const Handle space = made(H5Screate(H5S_SCALAR), H5Sclose, "make a data space");
  const Handle attribute =
      made(H5Acreate2(dataset, "units", type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, "make an attribute");
  require(H5Awrite(attribute, type, unit.data()) >= 0, "write an attribute");
}

Handle create_dataset(hid_t file, const Field& field, hid_t type) {
  std::vector<hsize_t> sizes(field.shape.begin(), field.shape.end());
  const Handle space = sizes.empty() ? made(H5Screate(H5S_SCALAR), H5Sclose, "make a data space")
                                     : made(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr),
                                            H5Sclose, "make a data space");
  const Handle settings = made(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "make dataset settings");
  require(H5Pset_obj_track_times(settings, false) >= 0, "switch off time stamps");
  if (!sizes.empty()) {
    hsize_t left = k_chunk_values;  // as many of the last indices as fit
    for (auto size = sizes.rbegin(); size != sizes.rend(); ++size) {
      *size = std::clamp<hsize_t>(*size, 1, left);
      left /= *size;
    }
    require(H5Pset_chunk(settings, static_cast<int>(sizes.size()), sizes.data()) >= 0 &&
                H5Pset_shuffle(settings) >= 0 && H5Pset_deflate(settings, k_level) >= 0,
            "set chunks and compression");
  }
  return made(H5Dcreate2(file, field.name.c_str(), type, space, H5P_DEFAULT, settings, H5P_DEFAULT), H5Dclose,
              "make dataset " + field.name);
}

struct DatasetWriter {
  Handle operator()(const std::vector<double>& values) const {
    return write(H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values.data());
  }
  Handle operator()(const std::vector<std::int32_t>& values) const {
    return write(H5T_STD_I32LE, H5T_NATIVE_INT32, values.data());
  }
  Handle operator()(const std::vector<std::int64_t>& values) const {
    return write(H5T_STD_I64LE, H5T_NATIVE_INT64, values.data());
  }
  Handle operator()(const std::vector<std::string>& values) const {
    std::size_t width = 1;
    for (const std::string& value : values) width = std::max(width, value.size());
    std::string bytes;
    for (std::string value : values) {
      value.resize(width, '\0');
      bytes += value;
    }
    const Handle type = text_type(width);
    return write(type, type, bytes.data());
  }

  Handle write(hid_t file_type, hid_t memory_type, const void* data) const {
    Handle dataset = create_dataset(file, field, file_type);
    require(H5Dwrite(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0, "write dataset " + field.name);
    return dataset;
  }

  hid_t file;
  const Field& field;
};

// A file in memory. The name is only a label to the library; nothing of it reaches a disk.
Handle memory_settings() {
  Handle settings = made(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make file settings");
  require(H5Pset_fapl_core(settings, k_image_growth, false) >= 0, "set a file in memory");
  return settings;
}

void write_fields(hid_t file, const std::vector<Field>& fields) {
  for (const Field& field : fields) {
    const Handle dataset = std::visit(DatasetWriter{file, field}, field.values);
    if (!field.unit.empty()) write_units(dataset, field.unit);
  }
}

void write_column(hid_t file, const Table& table, std::size_t column) {
  const auto& [name, unit, is_whole] = table.columns[column];
  const hid_t type = is_whole ? H5T_STD_I32LE : H5T_IEEE_F64LE;
  const hsize_t width = is_whole ? 4 : 8;
  const Handle dataset = create_dataset(file, {name, unit, {table.rows}, {}}, type);
  hsize_t row = 0;
  table.read(column, [&](std::string_view bytes) {
    const hsize_t count = bytes.size() / width;
    const Handle memory = made(H5Screate_simple(1, &count, nullptr), H5Sclose, "make a data space");
    const Handle space = made(H5Dget_space(dataset), H5Sclose, "see a data space");
    require(H5Sselect_hyperslab(space, H5S_SELECT_SET, &row, nullptr, &count, nullptr) >= 0 &&
                H5Dwrite(dataset, type, memory, space, H5P_DEFAULT, bytes.data()) >= 0,
            "write dataset " + name);
    row += count;
  });
  if (!unit.empty()) write_units(dataset, unit);
}

std::string to_hdf5(const std::vector<Field>& fields) {
  const std::lock_guard lock(library_mutex());
  const Silence silence;
  const Handle settings = memory_settings();
  const Handle file =
      made(H5Fcreate("record.h5", H5F_ACC_TRUNC, H5P_DEFAULT, settings), H5Fclose, "make a file in memory");
  write_fields(file, fields);
  require(H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0, "complete the file");
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  require(size > 0, "measure the file");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  require(H5Fget_file_image(file, bytes.data(), bytes.size()) == size, "hand out the file");
  return bytes;
}

// ---- Reading ----

[[noreturn]] void refuse(const std::string& place, std::string_view why) {
  throw std::invalid_argument(tumble::format("{}: {}", place, why));
}

// A link that leaves the file is not followed: what is read must lie in the bytes that were given.
bool is_inside(hid_t file, const std::string& field) {
  if (H5Lexists(file, field.c_str(), H5P_DEFAULT) <= 0) return false;
  H5L_info_t link;
  return H5Lget_info(file, field.c_str(), &link, H5P_DEFAULT) >= 0 && link.type == H5L_TYPE_HARD;
}

// One of the types that are written here and by h5py. The library crashes on damaged descriptions of others.
bool is_plain_number(hid_t type) {
  for (const hid_t plain : {H5T_IEEE_F64LE, H5T_IEEE_F32LE, H5T_STD_I8LE, H5T_STD_I16LE, H5T_STD_I32LE, H5T_STD_I64LE,
                            H5T_STD_U8LE, H5T_STD_U16LE, H5T_STD_U32LE, H5T_STD_U64LE}) {
    if (H5Tequal(type, plain) > 0) return true;
  }
  return false;
}

NumberArray read_dataset(hid_t file, const std::string& field, const std::string& place) {
  const Handle dataset(H5Dopen2(file, field.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset.is_valid()) refuse(place, "is not a dataset");
  const Handle settings(H5Dget_create_plist(dataset), H5Pclose);
  const bool is_elsewhere =
      !settings.is_valid() || H5Pget_external_count(settings) != 0 || H5Pget_layout(settings) == H5D_VIRTUAL;
  if (is_elsewhere) refuse(place, "its values lie in another file");
  const Handle type(H5Dget_type(dataset), H5Tclose);
  if (!is_plain_number(type)) refuse(place, "must hold doubles or whole numbers in their usual form");

  const Handle space(H5Dget_space(dataset), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 0 || rank > 2) refuse(place, tumble::format("must have at most two dimensions, got {}", rank));
  std::array<hsize_t, 2> sizes{};
  if (H5Sget_simple_extent_dims(space, sizes.data(), nullptr) < 0) refuse(place, "has no size");
  NumberArray array;
  std::size_t values = 1;
  for (std::size_t i = 0; i < static_cast<std::size_t>(rank); ++i) {
    if (sizes[i] > max_values_read() || (sizes[i] > 0 && values > max_values_read() / sizes[i])) {
      refuse(place, tumble::format("is too large: at most {} values are read", max_values_read()));
    }
    values *= sizes[i];
    array.shape.push_back(sizes[i]);
  }
  const hssize_t points = H5Sget_simple_extent_npoints(space);
  if (points < 0 || static_cast<std::size_t>(points) != values) refuse(place, "has no values");
  array.values.resize(values);
  if (H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values.data()) < 0) {
    refuse(place, "its values cannot be read: damaged?");
  }
  return array;
}

}  // namespace

void check_hdf5() {}

bool has_hdf5() { return true; }

std::string hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return tumble::format("{}.{}.{}", major, minor, release);
}

std::string to_hdf5(const drop::Record& record) { return to_hdf5(to_fields(record)); }

std::string to_hdf5(const Trajectory& trajectory) { return to_hdf5(to_fields(trajectory)); }

void write_table_hdf5(const Table& table, const std::filesystem::path& path) {
  const std::lock_guard lock(library_mutex());
  const Silence silence;
  const Handle file = made(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose,
                           "make the file " + path.string());
  for (std::size_t k = 0; k < table.columns.size(); ++k) write_column(file, table, k);
  write_fields(file, table.notes);
  require(H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0, "complete the file");
}

drop::Record parse_record_hdf5(std::string_view bytes, const std::string& name) {
  std::map<std::string, NumberArray> fields;
  {
    const std::lock_guard lock(library_mutex());
    const Silence silence;
    const Handle settings = memory_settings();
    if (bytes.empty() || H5Pset_file_image(settings, const_cast<char*>(bytes.data()), bytes.size()) < 0) {
      refuse(name, "is not an HDF5 file");
    }
    const Handle file(H5Fopen("record.h5", H5F_ACC_RDONLY, settings), H5Fclose);
    if (!file.is_valid()) refuse(name, "is not a whole HDF5 file; was it cut off?");
    for (const std::string& field : field_names_read()) {
      if (is_inside(file, field)) fields[field] = read_dataset(file, field, tumble::format("{}: {}", name, field));
    }
  }
  return from_fields(fields, name);
}

}  // namespace tumble::output
