#include "tumble/sweep/sweep_plots.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

#include "tumble/math/format.hpp"
#include "tumble/output/draw.hpp"
#include "tumble/output/file.hpp"
#include "tumble/output/write.hpp"

namespace tumble::sweep {
namespace {

using output::Align;
using output::Area;
using output::Canvas;
using output::Point;

// Lengths are in units of the design, see Canvas.
constexpr double k_single_width = 640.0, k_single_height = 440.0;
constexpr double k_overview_width = 1120.0, k_overview_height = 860.0;
constexpr double k_smallest_scale = 0.62;  // below, text cannot be read: a small picture shows less instead
constexpr double k_png_scale = 1.6;
constexpr double k_edge = 14.0;
constexpr double k_narrowest_panel = 360.0, k_lowest_panel = 260.0;
constexpr double k_lowest_with_title = 400.0;

using Panel = std::function<void(Canvas&, const Area&)>;

struct Picture {
  std::vector<Panel> panels;
  double width;  // of the usual one, in units
  double height;
  bool has_title = false;
};

std::optional<std::size_t> find_measure(const PlotSource& source, std::string_view name) {
  const std::vector<Measure>& measures = source.statistics.layout().measures;
  const auto found =
      std::find_if(measures.begin(), measures.end(), [&](const Measure& measure) { return measure.name == name; });
  return found == measures.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - measures.begin()));
}

Panel faces_panel(const PlotSource& source) {
  return [&source](Canvas& canvas, const Area& area) { draw_faces(canvas, area, source.summary); };
}

Panel face_map_panel(const PlotSource& source) {
  return [&source](Canvas& canvas, const Area& area) {
    draw_face_map(canvas, area, source.statistics, source.summary.facts.is_drawn);
  };
}

Panel fan_panel(const PlotSource& source) {
  return [&source](Canvas& canvas, const Area& area) { draw_fan(canvas, area, *source.fan); };
}

Panel histogram_panel(const PlotSource& source, std::size_t measure) {
  return [&source, measure](Canvas& canvas, const Area& area) {
    draw_histogram(canvas, area, source.statistics, source.summary, measure);
  };
}

Panel measure_map_panel(const PlotSource& source, std::size_t measure) {
  return [&source, measure](Canvas& canvas, const Area& area) {
    draw_measure_map(canvas, area, source.statistics, measure);
  };
}

// In the order of what a smaller picture leaves out last.
Picture overview(const PlotSource& source) {
  Picture picture{{faces_panel(source)}, k_overview_width, k_overview_height, true};
  const auto add_histogram = [&](const char* name) {
    const std::optional<std::size_t> measure = find_measure(source, name);
    if (measure) picture.panels.push_back(histogram_panel(source, *measure));
  };
  add_histogram("final_x");
  if (!source.statistics.layout().axes.empty()) picture.panels.push_back(face_map_panel(source));
  if (source.fan != nullptr) picture.panels.push_back(fan_panel(source));
  for (const char* name : {"rest_time", "impacts", "energy_lost"}) {
    if (picture.panels.size() < 4) add_histogram(name);
  }
  return picture;
}

[[noreturn]] void refuse_kind(const PlotSource& source, const std::string& kind) {
  std::string names = "overview, faces, map";
  if (source.fan != nullptr) names += ", fan";
  for (const Measure& measure : source.statistics.layout().measures) names += tumble::format(", {}", measure.name);
  throw std::invalid_argument(tumble::format("plot: must be one of {}, or 'map' and the name of a measure, got '{}'",
                                             names, output::path_text(kind)));
}

Picture picture_of(const PlotSource& source, const std::string& kind) {
  const auto single = [](Panel panel) { return Picture{{std::move(panel)}, k_single_width, k_single_height}; };
  constexpr std::string_view k_map = "map ";
  if (kind == "overview") return overview(source);
  if (kind == "faces") return single(faces_panel(source));
  if (kind == "map") return single(face_map_panel(source));
  if (kind == "fan" && source.fan != nullptr) return single(fan_panel(source));
  if (const auto measure = find_measure(source, kind)) return single(histogram_panel(source, *measure));
  if (kind.starts_with(k_map)) {
    const auto measure = find_measure(source, std::string_view(kind).substr(k_map.size()));
    if (measure) return single(measure_map_panel(source, *measure));
  }
  refuse_kind(source, kind);
}

struct Sizes {
  int width;  // [px]
  int height;
  double scale;  // [px] per unit of the design
};

Sizes choose_sizes(const Picture& picture, int width, int height, double usual_scale) {
  for (const auto& [field, value] : {std::pair{"width", width}, std::pair{"height", height}}) {
    if (value == 0 || (value >= output::k_smallest_picture && value <= output::k_largest_picture)) continue;
    throw std::invalid_argument(tumble::format("{}: must be 0 (chosen for you) or in [{}, {}] px, got {}", field,
                                               output::k_smallest_picture, output::k_largest_picture, value));
  }
  const auto clamp = [](double size) {
    return std::clamp(static_cast<int>(std::lround(size)), output::k_smallest_picture, output::k_largest_picture);
  };
  if (width == 0 && height == 0) width = clamp(usual_scale * picture.width);
  if (width == 0) width = clamp(height * picture.width / picture.height);
  if (height == 0) height = clamp(width * picture.height / picture.width);
  const double scale = std::min(width / picture.width, height / picture.height);
  return {width, height, std::max(scale, k_smallest_scale)};
}

// Returns how much of the height it takes.
double draw_title(Canvas& canvas, const Summary& summary, double width) {
  const double room = width - 2.0 * k_edge - 32.0;
  const Point at{k_edge + 16.0, 36.0};
  output::draw_text_within(canvas, room, at, summary.facts.title.empty() ? "A sweep of drops" : summary.facts.title,
                           {19.0, output::k_ink, Align::left, true});
  std::string facts = tumble::format("{} instance{}", summary.instances, summary.instances == 1 ? "" : "s");
  if (summary.numerical > 0) facts += tumble::format(", {} numerical left out", summary.numerical);
  if (summary.invalid > 0) facts += tumble::format(", {} invalid left out", summary.invalid);
  for (const std::string& swept : summary.facts.swept) facts += tumble::format(";  {}", swept);
  output::draw_text_within(canvas, room, {at.x, at.y + 23.0}, facts, {12.5, output::k_muted});
  return at.y + 40.0;
}

void draw(Canvas& canvas, const Picture& picture, const PlotSource& source, double scale) {
  const double width = canvas.width() / scale, height = canvas.height() / scale;
  canvas.fill(output::k_paper);
  const bool has_title = picture.has_title && height >= k_lowest_with_title;
  const double top = has_title ? draw_title(canvas, source.summary, width) : k_edge;
  const auto fit = [](double length, double least, std::size_t most) {
    return std::clamp<std::size_t>(static_cast<std::size_t>(length / least), 1, most);
  };
  const std::size_t columns = fit(width - 2.0 * k_edge, k_narrowest_panel, picture.panels.size() > 1 ? 2 : 1);
  const std::size_t rows = fit(height - top - k_edge, k_lowest_panel, (picture.panels.size() + columns - 1) / columns);
  const double panel_width = (width - 2.0 * k_edge) / static_cast<double>(columns);
  const double panel_height = (height - top - k_edge) / static_cast<double>(rows);
  for (std::size_t k = 0; k < std::min(rows * columns, picture.panels.size()); ++k) {
    const auto column = static_cast<double>(k % columns), row = static_cast<double>(k / columns);
    picture.panels[k](canvas,
                      {k_edge + column * panel_width, top + row * panel_height, panel_width - 8.0, panel_height - 8.0});
  }
}

}  // namespace

std::string to_plot_png(const PlotSource& source, const PlotSettings& settings) {
  const Picture picture = picture_of(source, settings.kind);
  const Sizes sizes = choose_sizes(picture, settings.width, settings.height, k_png_scale);
  Canvas canvas = Canvas::image(sizes.width, sizes.height, sizes.scale);
  draw(canvas, picture, source, sizes.scale);
  return canvas.to_png();
}

std::string to_plot_svg(const PlotSource& source, const PlotSettings& settings) {
  const Picture picture = picture_of(source, settings.kind);
  const Sizes sizes = choose_sizes(picture, settings.width, settings.height, 1.0);
  Canvas canvas = Canvas::svg(sizes.width, sizes.height, sizes.scale);
  draw(canvas, picture, source, sizes.scale);
  return canvas.to_svg();
}

void write_plot(const PlotSource& source, const std::filesystem::path& path, const PlotSettings& settings,
                bool overwrite) {
  const std::string ending = output::ending_of(path);
  if (ending != ".png" && ending != ".svg") {
    throw std::invalid_argument(tumble::format("{}: the name must end in .png or .svg", output::path_text(path)));
  }
  output::check_target(path, overwrite);
  const std::string bytes = ending == ".png" ? to_plot_png(source, settings) : to_plot_svg(source, settings);
  output::write_file_atomically(path, bytes, overwrite);
}

bool shows_fan(const PlotSettings& settings) { return settings.kind == "overview" || settings.kind == "fan"; }

}  // namespace tumble::sweep
