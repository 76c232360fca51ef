#include "tumble/output/write.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "tumble/math/format.hpp"
#include "tumble/output/animation.hpp"
#include "tumble/output/csv.hpp"
#include "tumble/output/drop_trajectory.hpp"
#include "tumble/output/file.hpp"
#include "tumble/output/gif.hpp"
#include "tumble/output/hdf5.hpp"
#include "tumble/output/html.hpp"
#include "tumble/output/mp4.hpp"
#include "tumble/output/npz.hpp"
#include "tumble/output/record_fields.hpp"
#include "tumble/output/strobe.hpp"
#include "tumble/output/trajectory_csv.hpp"
#include "tumble/output/trajectory_fields.hpp"

namespace tumble::output {
namespace {

enum class Format { csv, contacts_csv, npz, h5, gif, mp4, png, svg, html };

struct NamedFormat {
  std::string_view name;  // the ending of a file, too
  Format format;
};
using Formats = std::span<const NamedFormat>;

constexpr std::array<NamedFormat, 9> k_trajectory_formats = {{{"contacts.csv", Format::contacts_csv},  // before csv
                                                              {"csv", Format::csv},
                                                              {"npz", Format::npz},
                                                              {"h5", Format::h5},
                                                              {"gif", Format::gif},
                                                              {"mp4", Format::mp4},
                                                              {"png", Format::png},
                                                              {"svg", Format::svg},
                                                              {"html", Format::html}}};
constexpr Formats k_record_formats = Formats(k_trajectory_formats).subspan(1);  // all but the one of contacts

constexpr std::size_t k_max_bytes_read = std::size_t{4} << 30;   // 4 GiB
constexpr std::size_t k_max_page_bytes = std::size_t{64} << 20;  // 64 MiB

struct Size {
  int width;
  int height;
};
constexpr Size k_gif_size = {640, 400};
constexpr Size k_mp4_size = {1280, 720};

std::string in_lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// "csv, npz or h5", each behind `mark`.
std::string names_of(Formats formats, std::string_view mark) {
  std::string names;
  for (std::size_t i = 0; i < formats.size(); ++i) {
    const char* before = i == 0 ? "" : i + 1 == formats.size() ? " or " : ", ";
    names += tumble::format("{}{}{}", before, mark, formats[i].name);
  }
  return names;
}

// By the ending of the name, in any case.
const NamedFormat* find_by_ending(const std::filesystem::path& path, Formats formats) {
  const std::string name = in_lower_case(path.filename().string());
  for (const NamedFormat& format : formats) {
    if (name.size() > format.name.size() + 1 && name.ends_with(tumble::format(".{}", format.name))) return &format;
  }
  return nullptr;
}

Format format_of(const std::filesystem::path& path, const WriteOptions& options, Formats formats) {
  if (options.format.empty()) {
    const NamedFormat* found = find_by_ending(path, formats);
    if (found != nullptr) return found->format;
    throw std::invalid_argument(tumble::format("{}: the name must end in {}", path_text(path), names_of(formats, ".")));
  }
  for (const NamedFormat& format : formats) {
    if (in_lower_case(options.format) == format.name) return format.format;
  }
  throw std::invalid_argument(
      tumble::format("format: must be {}, got '{}'", names_of(formats, ""), path_text(options.format)));
}

void check_size(const char* field, int value) {
  if (value == 0 || (value >= k_smallest_picture && value <= k_largest_picture)) return;
  throw std::invalid_argument(tumble::format("{}: must be 0 (chosen for you) or in [{}, {}] px, got {}", field,
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

// The page of an .html, checked.
std::string read_page(const std::filesystem::path& path) {
  std::string page;
  try {
    page = read_file(path, k_max_page_bytes);
  } catch (const std::system_error& error) {
    throw std::runtime_error(tumble::format("page: an .html needs the page that shows it: {}; `make viewer` builds it",
                                            path.empty() ? "none was named" : error.what()));
  }
  check_page(page, path_text(path));
  return page;
}

void check_options(const std::filesystem::path& path, const WriteOptions& options, Format format) {
  check_size("width", options.width);
  check_size("height", options.height);
  count_frames(0.0, options.speed, 1);
  if (format == Format::h5) check_hdf5();
  if (format == Format::html) read_page(options.page);
  if (format != Format::mp4) return;
  check_ffmpeg();
  const Size size = animation_size(options, format);
  for (const auto& [field, value] : {std::pair{"width", size.width}, std::pair{"height", size.height}}) {
    if (value % 2 != 0) {
      throw std::invalid_argument(tumble::format("{}: must be even for an .mp4, got {} px", field, value));
    }
  }
  if (is_direct_target(path)) {
    throw std::invalid_argument(tumble::format("{}: an .mp4 can only be written to a regular file", path_text(path)));
  }
}

void check_length(const WriteOptions& options, Format format, double duration) {
  if (format == Format::gif) count_frames(duration, options.speed, k_max_gif_frames);
  if (format == Format::mp4) count_frames(duration, options.speed, k_max_mp4_frames);
}

double duration_of(const drop::Parameters& parameters, int columns) { return (columns - 1) * parameters.dt; }

// `rows(first, last)` is the text of some rows: that of all of a long run is never in memory.
template <class Rows>
void write_table(OutputFile& file, const std::string& header, std::size_t count, Rows rows) {
  constexpr std::size_t rows_at_once = 64;
  file.write(header);
  for (std::size_t k = 0; k < count; k += rows_at_once) file.write(rows(k, std::min(k + rows_at_once, count)));
}

void write_csv(const drop::Record& record, OutputFile& file) {
  write_table(file, csv_header(record), record.steps.size(), [&](std::size_t first, std::size_t last) {
    return csv_rows(record, static_cast<int>(first), static_cast<int>(last));
  });
}

void write_csv(const Trajectory& trajectory, OutputFile& file) {
  write_table(file, samples_csv_header(trajectory), trajectory.time.size(),
              [&](std::size_t first, std::size_t last) { return samples_csv_rows(trajectory, first, last); });
}

void write_contacts_csv(const Trajectory& trajectory, OutputFile& file) {
  write_table(file, contacts_csv_header(trajectory), trajectory.contacts.size(),
              [&](std::size_t first, std::size_t last) { return contacts_csv_rows(trajectory, first, last); });
}

void check_writable(const std::filesystem::path& path, const WriteOptions& options, Format format) {
  check_options(path, options, format);
  check_target(path, options.overwrite);
}

bool is_picture(Format format) {
  return format == Format::gif || format == Format::mp4 || format == Format::png || format == Format::svg;
}

void write_film(const Trajectory& trajectory, const std::filesystem::path& path, const WriteOptions& options) {
  OutputFile file(path, options.overwrite);
  const Size size = animation_size(options, Format::mp4);
  try {
    write_mp4(trajectory, file.working_path(), size.width, size.height, options.speed);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(tumble::format("cannot write {}: {}", path_text(path), error.what()));
  }
  file.commit();
}

void write_picture(const Trajectory& trajectory, const std::filesystem::path& path, const WriteOptions& options,
                   Format format) {
  if (format == Format::mp4) {
    write_film(trajectory, path, options);
    return;
  }
  const Size gif = animation_size(options, Format::gif);
  const std::string bytes = format == Format::gif   ? to_gif(trajectory, gif.width, gif.height, options.speed)
                            : format == Format::png ? to_strobe_png(trajectory, options.width, options.height)
                                                    : to_strobe_svg(trajectory, options.width, options.height);
  write_file_atomically(path, bytes, options.overwrite);
}

}  // namespace

void check_writable(const std::filesystem::path& path, const WriteOptions& options) {
  check_writable(path, options, format_of(path, options, k_record_formats));
}

void check_writable(const std::filesystem::path& path, const WriteOptions& options,
                    const drop::Parameters& parameters) {
  check_writable(path, options);
  check_length(options, format_of(path, options, k_record_formats), duration_of(parameters, parameters.columns));
}

void write_record(const drop::Record& record, const std::filesystem::path& path, const WriteOptions& options) {
  check_record(record);
  check_writable(path, options);
  const Format format = format_of(path, options, k_record_formats);
  check_length(options, format, duration_of(record.parameters, record.trajectory.columns));
  if (is_picture(format)) {
    write_picture(trajectory_of(record), path, options, format);
  } else if (format == Format::csv) {
    OutputFile file(path, options.overwrite);
    write_csv(record, file);
    file.commit();
  } else if (format == Format::html) {
    const std::string html = to_html(record, read_page(options.page), path_text(options.page));
    write_file_atomically(path, html, options.overwrite);
  } else {
    write_file_atomically(path, format == Format::npz ? to_npz(record) : to_hdf5(record), options.overwrite);
  }
}

void check_trajectory_writable(const std::filesystem::path& path, const WriteOptions& options, double duration) {
  const Format format = format_of(path, options, k_trajectory_formats);
  check_writable(path, options, format);
  check_length(options, format, duration);
}

void write_trajectory(const Trajectory& trajectory, const std::filesystem::path& path, const WriteOptions& options) {
  check_trajectory(trajectory);
  const Format format = format_of(path, options, k_trajectory_formats);
  check_trajectory_writable(path, options, trajectory.time.back());
  if (is_picture(format)) {
    write_picture(trajectory, path, options, format);
  } else if (format == Format::html) {
    const std::string html = to_html(trajectory, read_page(options.page), path_text(options.page));
    write_file_atomically(path, html, options.overwrite);
  } else if (format == Format::npz || format == Format::h5) {
    write_file_atomically(path, format == Format::npz ? to_npz(trajectory) : to_hdf5(trajectory), options.overwrite);
  } else {
    OutputFile file(path, options.overwrite);
    if (format == Format::csv) write_csv(trajectory, file);
    if (format == Format::contacts_csv) write_contacts_csv(trajectory, file);
    file.commit();
  }
}

ContactUse contact_use(const std::filesystem::path& path, const WriteOptions& options) {
  const Format format = format_of(path, options, k_trajectory_formats);
  return format == Format::csv ? ContactUse::none : format == Format::contacts_csv ? ContactUse::all : ContactUse::part;
}

drop::Record read_record(const std::filesystem::path& path) {
  const NamedFormat* found = find_by_ending(path, k_record_formats);
  const std::string name = path_text(path);
  if (found != nullptr && found->format == Format::csv)
    return parse_record_csv(read_file(path, k_max_bytes_read), name);
  if (found != nullptr && found->format == Format::npz)
    return parse_record_npz(read_file(path, k_max_bytes_read), name);
  if (found != nullptr && found->format == Format::h5)
    return parse_record_hdf5(read_file(path, k_max_bytes_read), name);
  throw std::invalid_argument(tumble::format("{}: a record is read from a .csv, .npz or .h5 file", name));
}

}  // namespace tumble::output
