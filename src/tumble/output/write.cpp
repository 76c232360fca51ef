#include "tumble/output/write.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "tumble/output/animation.hpp"
#include "tumble/output/csv.hpp"
#include "tumble/output/file.hpp"
#include "tumble/output/gif.hpp"
#include "tumble/output/hdf5.hpp"
#include "tumble/output/mp4.hpp"
#include "tumble/output/npz.hpp"
#include "tumble/output/record_fields.hpp"
#include "tumble/output/strobe.hpp"

namespace tumble::output {
namespace {

enum class Format { csv, npz, h5, gif, mp4, png, svg };

struct NamedFormat {
  std::string_view name;
  Format format;
};

constexpr std::array<NamedFormat, 7> k_formats = {{{"csv", Format::csv},
                                                   {"npz", Format::npz},
                                                   {"h5", Format::h5},
                                                   {"gif", Format::gif},
                                                   {"mp4", Format::mp4},
                                                   {"png", Format::png},
                                                   {"svg", Format::svg}}};

constexpr std::size_t k_max_bytes_read = std::size_t{4} << 30;  // 4 GiB

struct Size {
  int width;
  int height;
};
constexpr Size k_gif_size = {640, 400};
constexpr Size k_mp4_size = {1280, 720};

// The format behind a name or an ending, in any case.
const NamedFormat* find_format(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto found =
      std::find_if(k_formats.begin(), k_formats.end(), [&](const NamedFormat& f) { return f.name == name; });
  return found == k_formats.end() ? nullptr : &*found;
}

std::string ending_of(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  return ending.empty() ? ending : ending.substr(1);
}

Format format_of(const std::filesystem::path& path, const WriteOptions& options) {
  if (!options.format.empty()) {
    const NamedFormat* found = find_format(options.format);
    if (found != nullptr) return found->format;
    throw std::invalid_argument(
        fmt::format("format: must be one of csv, npz, h5, gif, mp4, png, svg, got '{}'", path_text(options.format)));
  }
  const NamedFormat* found = find_format(ending_of(path));
  if (found != nullptr) return found->format;
  throw std::invalid_argument(
      fmt::format("{}: the name must end in .csv, .npz, .h5, .gif, .mp4, .png or .svg", path_text(path)));
}

void check_size(const char* field, int value) {
  if (value == 0 || (value >= k_smallest_picture && value <= k_largest_picture)) return;
  throw std::invalid_argument(fmt::format("{}: must be 0 (chosen for you) or in [{}, {}] px, got {}", field,
                                          k_smallest_picture, k_largest_picture, value));
}

// That of the options, the format's own where they leave it open; one given side keeps the shape.
Size animation_size(const WriteOptions& options, const Size& usual) {
  Size size{options.width, options.height};
  if (size.width == 0 && size.height == 0) return usual;
  const auto clamp = [](int value) { return std::clamp(value / 2 * 2, k_smallest_picture, k_largest_picture); };
  if (size.width == 0) size.width = clamp(size.height * usual.width / usual.height);
  if (size.height == 0) size.height = clamp(size.width * usual.height / usual.width);
  return size;
}

Size animation_size(const WriteOptions& options, Format format) {
  return animation_size(options, format == Format::mp4 ? k_mp4_size : k_gif_size);
}

void check_options(const std::filesystem::path& path, const WriteOptions& options, Format format) {
  check_size("width", options.width);
  check_size("height", options.height);
  count_frames(1, 1.0, options.speed, 1);
  if (format == Format::h5) check_hdf5();
  if (format != Format::mp4) return;
  check_ffmpeg();
  const Size size = animation_size(options, format);
  for (const auto& [field, value] : {std::pair{"width", size.width}, std::pair{"height", size.height}}) {
    if (value % 2 != 0) {
      throw std::invalid_argument(fmt::format("{}: must be even for an .mp4, got {} px", field, value));
    }
  }
  if (is_direct_target(path)) {
    throw std::invalid_argument(fmt::format("{}: an .mp4 can only be written to a regular file", path_text(path)));
  }
}

void check_length(const WriteOptions& options, Format format, int columns, double dt) {
  if (format == Format::gif) count_frames(columns, dt, options.speed, k_max_gif_frames);
  if (format == Format::mp4) count_frames(columns, dt, options.speed, k_max_mp4_frames);
}

// A long record is never in memory as text as a whole.
void write_csv(const drop::Record& record, OutputFile& file) {
  constexpr int k_rows_at_once = 4096;
  file.write(csv_header(record));
  for (int k = 0; k < record.trajectory.columns; k += k_rows_at_once) {
    file.write(csv_rows(record, k, k + std::min(k_rows_at_once, record.trajectory.columns - k)));
  }
}

std::string to_bytes(const drop::Record& record, const WriteOptions& options, Format format) {
  const Size gif = animation_size(options, Format::gif);
  switch (format) {
    case Format::npz: return to_npz(record);
    case Format::h5: return to_hdf5(record);
    case Format::gif: return to_gif(record, gif.width, gif.height, options.speed);
    case Format::png: return to_strobe_png(record, options.width, options.height);
    case Format::svg: return to_strobe_svg(record, options.width, options.height);
    case Format::csv:
    case Format::mp4: break;
  }
  return "";
}

}  // namespace

void check_writable(const std::filesystem::path& path, const WriteOptions& options) {
  const Format format = format_of(path, options);
  check_options(path, options, format);
  check_target(path, options.overwrite);
}

void check_writable(const std::filesystem::path& path, const WriteOptions& options,
                    const drop::Parameters& parameters) {
  check_writable(path, options);
  check_length(options, format_of(path, options), parameters.columns, parameters.dt);
}

void write_record(const drop::Record& record, const std::filesystem::path& path, const WriteOptions& options) {
  check_record(record);
  check_writable(path, options);
  const Format format = format_of(path, options);
  check_length(options, format, record.trajectory.columns, record.parameters.dt);
  if (format != Format::csv && format != Format::mp4) {
    write_file_atomically(path, to_bytes(record, options, format), options.overwrite);
    return;
  }
  OutputFile file(path, options.overwrite);
  if (format == Format::csv) {
    write_csv(record, file);
  } else {
    const Size size = animation_size(options, format);
    try {
      write_mp4(record, file.working_path(), size.width, size.height, options.speed);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("cannot write {}: {}", path_text(path), error.what()));
    }
  }
  file.commit();
}

drop::Record read_record(const std::filesystem::path& path) {
  const NamedFormat* found = find_format(ending_of(path));
  const std::string name = path_text(path);
  if (found != nullptr && found->format == Format::csv)
    return parse_record_csv(read_file(path, k_max_bytes_read), name);
  if (found != nullptr && found->format == Format::npz)
    return parse_record_npz(read_file(path, k_max_bytes_read), name);
  if (found != nullptr && found->format == Format::h5)
    return parse_record_hdf5(read_file(path, k_max_bytes_read), name);
  throw std::invalid_argument(fmt::format("{}: a record is read from a .csv, .npz or .h5 file", name));
}

}  // namespace tumble::output
