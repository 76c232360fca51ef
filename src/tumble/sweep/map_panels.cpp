// Charts over the cells of one or two swept quantities.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "tumble/math/format.hpp"
#include "tumble/output/draw.hpp"
#include "tumble/sweep/chart.hpp"
#include "tumble/sweep/panels.hpp"

namespace tumble::sweep {
namespace {

using output::Align;
using output::Area;
using output::Canvas;
using output::Colour;
using output::Point;
using output::TextStyle;

constexpr double k_legend = 82.0;
constexpr double k_seam = 0.4;  // neighbours overlap, so that no paper shines through

struct Scales {
  Scale x;  // of the first axis
  Scale y;
};

Scale scale_of(const CellAxis& axis, double start, double end) {
  return {axis.edges.front(), axis.edges.back(), start, end, axis.is_logarithmic};
}

// Calls draw(cell, its area) for each cell of the map.
void for_each_cell(const Layout& layout, const Scales& scales, const std::function<void(std::size_t, Area)>& draw) {
  const CellAxis& first = layout.axes[0];
  const std::size_t rows = layout.axes.size() == 2 ? layout.axes[1].size() : 1;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double left = scales.x.to_pixel(first.edges[i]), right = scales.x.to_pixel(first.edges[i + 1]);
    for (std::size_t j = 0; j < rows; ++j) {
      const double bottom = rows == 1 ? scales.y.start : scales.y.to_pixel(layout.axes[1].edges[j]);
      const double top = rows == 1 ? scales.y.end : scales.y.to_pixel(layout.axes[1].edges[j + 1]);
      draw(i * rows + j, {left, top, right - left, bottom - top});
    }
  }
}

// The map without its frame; where `colour_of_cell` has none, the missing pattern shows.
void draw_cells(Canvas& canvas, const Area& chart, const Layout& layout,
                const std::function<std::optional<Colour>(std::size_t)>& colour_of_cell) {
  const CellAxis &first = layout.axes[0], &second = layout.axes[1];
  const Scales scales = {scale_of(first, chart.left, chart.right()), scale_of(second, chart.bottom(), chart.top)};
  draw_missing(canvas, chart);
  canvas.clip(chart);
  for_each_cell(layout, scales, [&](std::size_t cell, Area area) {
    const std::optional<Colour> colour = colour_of_cell(cell);
    if (!colour) return;
    canvas.fill_rectangle(
        {area.left - k_seam, area.top - k_seam, area.width + 2.0 * k_seam, area.height + 2.0 * k_seam}, *colour);
  });
  canvas.unclip();
  draw_x_axis(canvas, chart, scales.x, words_of(first.name), first.unit, false);
  draw_y_axis(canvas, chart, scales.y, words_of(second.name), second.unit, false);
}

std::int64_t solved_in(const OutcomeCounts& counts) {
  std::int64_t sum = 0;
  for (std::size_t k = 0; k < k_num_landed; ++k) sum += counts[k];
  return sum;
}

// The most frequent outcome in its colour, which is the paler the less frequent it is for sure: of what is drawn at
// random, the lower end of the interval of its share counts.
std::optional<Colour> face_colour(const OutcomeCounts& counts, bool is_drawn) {
  const std::int64_t solved = solved_in(counts);
  if (solved == 0) return std::nullopt;
  const auto most = std::max_element(counts.begin(), counts.begin() + k_num_landed);
  const double share =
      is_drawn ? interval_of_share(*most, solved).low : static_cast<double>(*most) / static_cast<double>(solved);
  const auto outcome = static_cast<Outcome>(most - counts.begin());
  return output::mix(output::k_paper, colour_of(outcome), std::clamp((share - 0.2) / 0.7, 0.12, 1.0));
}

void draw_face_legend(Canvas& canvas, const Area& chart, bool has_paler) {
  double y = chart.top + 6.0;
  const double left = chart.right() + 12.0;
  for (std::size_t k = 0; k < k_num_landed; ++k) {
    const auto outcome = static_cast<Outcome>(k);
    canvas.fill_rectangle({left, y - 5.0, 11.0, 11.0}, colour_of(outcome));
    canvas.draw_text({left + 16.0, y + 4.5}, outcome == Outcome::moving ? "moving" : name_of(outcome),
                     {k_small_text, output::k_muted});
    y += 18.0;
  }
  if (!has_paler || y + 30.0 > chart.bottom()) return;
  canvas.draw_text({left, y + 8.0}, "paler: less often", {k_small_text - 1.0, output::k_muted});
  canvas.draw_text({left, y + 21.0}, "or not sure", {k_small_text - 1.0, output::k_muted});
}

void draw_stacked_shares(Canvas& canvas, const Area& chart, const Statistics& statistics) {
  const CellAxis& axis = statistics.layout().axes[0];
  const Scales scales = {scale_of(axis, chart.left, chart.right()), scale_y(chart, 0.0, 100.0)};
  draw_missing(canvas, chart);
  for_each_cell(statistics.layout(), scales, [&](std::size_t cell, Area area) {
    const OutcomeCounts& counts = statistics.outcomes_in(cell);
    const auto solved = static_cast<double>(solved_in(counts));
    double below = 0.0;
    for (std::size_t k = 0; k < k_num_landed && solved > 0.0; ++k) {
      const double share = 100.0 * static_cast<double>(counts[k]) / solved;
      const double top = scales.y.to_pixel(below + share);
      canvas.fill_rectangle({area.left, top, area.width + k_seam, scales.y.to_pixel(below) - top},
                            colour_of(static_cast<Outcome>(k)));
      below += share;
    }
  });
  draw_x_axis(canvas, chart, scales.x, words_of(axis.name), axis.unit, false);
  draw_y_axis(canvas, chart, scales.y, "share", "%", false);
}

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

Range means_of(const Statistics& statistics, std::size_t measure) {
  Range range;  // stays reversed where there is none
  for (std::size_t cell = 0; cell < statistics.layout().num_cells(); ++cell) {
    const double mean = statistics.mean_in(cell, measure);
    if (std::isnan(mean)) continue;
    range.low = std::min(range.low, mean);
    range.high = std::max(range.high, mean);
  }
  const double size = std::max(std::abs(range.low), std::abs(range.high));
  if (range.high - range.low <= 1e-12 * size) {  // one colour, that of the middle
    const double room = size == 0.0 ? 1.0 : 0.1 * size;
    range = {range.low - room, range.high + room};
  }
  return range;
}

void draw_mean_line(Canvas& canvas, const Area& chart, const Statistics& statistics, std::size_t measure,
                    const Range& range) {
  const CellAxis& axis = statistics.layout().axes[0];
  const Measure& m = statistics.layout().measures[measure];
  const double room = 0.05 * (range.high - range.low);
  const Scale x = scale_of(axis, chart.left, chart.right());
  const Scale y = scale_y(chart, range.low - room, range.high + room);
  draw_x_axis(canvas, chart, x, words_of(axis.name), axis.unit);
  draw_y_axis(canvas, chart, y, "mean", m.unit);
  std::vector<Point> line;
  for (std::size_t cell = 0; cell < axis.size(); ++cell) {
    const double mean = statistics.mean_in(cell, measure);
    if (std::isnan(mean)) {
      canvas.draw_polyline(line, {output::k_accent, 2.0});
      line.clear();
      continue;
    }
    line.push_back({x.to_pixel(axis.edges[cell]), y.to_pixel(mean)});
    line.push_back({x.to_pixel(axis.edges[cell + 1]), y.to_pixel(mean)});
  }
  canvas.draw_polyline(line, {output::k_accent, 2.0});
}

}  // namespace

void draw_face_map(Canvas& canvas, const Area& area, const Statistics& statistics, bool is_drawn) {
  const std::vector<CellAxis>& axes = statistics.layout().axes;
  const Area chart = chart_in(area, k_legend);
  draw_heading(canvas, area, axes.size() == 2 ? "The face that is up most often" : "Which face is up");
  if (axes.empty()) return draw_nothing(canvas, chart, "nothing is swept");
  if (axes.size() == 1) {
    draw_stacked_shares(canvas, chart, statistics);
  } else {
    draw_cells(canvas, chart, statistics.layout(),
               [&](std::size_t cell) { return face_colour(statistics.outcomes_in(cell), is_drawn); });
  }
  draw_face_legend(canvas, chart, axes.size() == 2);
}

void draw_measure_map(Canvas& canvas, const Area& area, const Statistics& statistics, std::size_t measure) {
  const Layout& layout = statistics.layout();
  const Measure& m = layout.measures[measure];
  const Area chart = chart_in(area, k_legend);
  const std::string unit = m.unit.empty() ? "" : tumble::format(" [{}]", m.unit);
  draw_heading(canvas, area, tumble::format("Mean {}{}", words_of(m.name), unit));
  const Range range = means_of(statistics, measure);
  if (layout.axes.empty()) return draw_nothing(canvas, chart, "nothing is swept");
  if (!(range.low < range.high)) return draw_nothing(canvas, chart, "no instance has it");
  if (layout.axes.size() == 1) return draw_mean_line(canvas, chart, statistics, measure, range);
  draw_cells(canvas, chart, layout, [&](std::size_t cell) -> std::optional<Colour> {
    const double mean = statistics.mean_in(cell, measure);
    if (std::isnan(mean)) return std::nullopt;
    return colour_of_value((mean - range.low) / (range.high - range.low));
  });
  draw_colour_bar(canvas, {chart.right() + 12.0, chart.top, 13.0, chart.height}, range.low, range.high);
}

}  // namespace tumble::sweep
