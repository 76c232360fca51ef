#include "tumble/sweep/panels.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <utility>

#include "tumble/math/format.hpp"
#include "tumble/output/draw.hpp"
#include "tumble/sweep/chart.hpp"

namespace tumble::sweep {
namespace {

using output::Align;
using output::Area;
using output::Canvas;
using output::Colour;
using output::Point;
using output::Stroke;
using output::TextStyle;

// ---- Faces ----

// The square as it lies with this face up; the dot is fixed to it.
void draw_square_icon(Canvas& canvas, Point middle, double half, Outcome outcome) {
  const double turn = 0.5 * std::numbers::pi * static_cast<double>(outcome);
  const double dot = 0.56 * half;
  canvas.draw_polygon({{middle.x - half, middle.y - half},
                       {middle.x + half, middle.y - half},
                       {middle.x + half, middle.y + half},
                       {middle.x - half, middle.y + half}},
                      colour_of(outcome).with_opacity(0.16), {colour_of(outcome), 1.4});
  // (-dot, -dot) in the frame of the body, whose +x side is up after a quarter turn.
  const double c = std::cos(turn), s = std::sin(turn);
  canvas.draw_disc({middle.x + (-dot * c + dot * s), middle.y - (-dot * s - dot * c)}, 1.9, colour_of(outcome));
}

double top_of_shares(const Summary& summary) {
  double top = 0.01;
  for (const Share& share : summary.shares) top = std::max(top, share.interval.high);
  return std::min(1.0, top);
}

void draw_share(Canvas& canvas, const Area& chart, const Scale& y, const Share& share, double middle, double width,
                bool is_narrow) {
  const Colour colour = colour_of(share.outcome);
  const double top = y.to_pixel(share.share);
  const double low = y.to_pixel(share.interval.low), high = y.to_pixel(share.interval.high);
  canvas.fill_rectangle({middle - 0.5 * width, top, width, chart.bottom() - top},
                        output::mix(output::k_paper, colour, 0.82));
  if (low - high > 3.0) {
    const double cap = std::min(7.0, 0.2 * width);
    const Stroke ink{output::k_ink, 1.3};
    canvas.draw_line({middle, low}, {middle, high}, ink);
    canvas.draw_line({middle - cap, low}, {middle + cap, low}, ink);
    canvas.draw_line({middle - cap, high}, {middle + cap, high}, ink);
  }
  const double percent = 100.0 * share.share;
  std::string text = share.count == 0 ? "0" : percent < 0.1 ? "< 0.1 %" : tumble::format("{:.1f} %", percent);
  if (is_narrow) text = tumble::format("{:.0f}", percent);
  const double baseline = std::min(top, high) - 6.0;
  output::draw_text_within(canvas, 1.4 * width, {middle, baseline}, text,
                           {k_small_text + 0.5, output::k_ink, Align::centre, true});
}

// ---- Histograms ----

struct Bins {
  std::vector<double> edges;
  bool is_cut;  // there are values beyond
};

Bins choose_bins(const MeasureSummary& m, const Histogram& histogram) {
  const auto at = [&](double p) { return quantile(histogram, p, m.min, m.max, m.measure.is_whole); };
  double low = at(0.001), high = at(0.999);
  const bool is_cut = m.max - m.min > 3.0 * (high - low);
  if (!is_cut) low = m.min, high = m.max;
  // Rice's rule, within what can be seen.
  const double wanted = std::clamp(2.0 * std::cbrt(static_cast<double>(m.count)), 8.0, 60.0);
  const double resolution = std::max(std::abs(low), std::abs(high)) / 256.0;
  double width = high > low ? output::round_up_nicely(std::max((high - low) / wanted, resolution)) : 0.0;
  if (m.measure.is_whole) width = std::max(1.0, std::round(width));
  if (width == 0.0) width = low == 0.0 ? 1.0 : output::round_up_nicely(0.1 * std::abs(low));
  const double shift = m.measure.is_whole ? 0.5 : 0.0;
  const double first = std::floor((low + shift) / width), last = std::floor((high + shift) / width) + 1.0;
  Bins bins{{}, is_cut};
  for (double k = first; k <= last + 0.5; k += 1.0) bins.edges.push_back(k * width - shift);
  return bins;
}

void draw_mark(Canvas& canvas, const Area& chart, double x, const Stroke& stroke) {
  if (x >= chart.left && x <= chart.right()) canvas.draw_line({x, chart.top}, {x, chart.bottom()}, stroke);
}

// ---- Fans ----

std::vector<Point> band(const Scale& x, const Scale& y, const std::vector<double>& time, const std::vector<double>& low,
                        const std::vector<double>& high) {
  std::vector<Point> points;
  for (std::size_t k = 0; k < low.size(); ++k) points.push_back({x.to_pixel(time[k]), y.to_pixel(high[k])});
  for (std::size_t k = low.size(); k-- > 0;) points.push_back({x.to_pixel(time[k]), y.to_pixel(low[k])});
  return points;
}

// The quantile of the instances at each time, until the first time without any.
std::vector<double> quantiles(const Fan& fan, double p) {
  std::vector<double> result, values;
  for (std::size_t k = 0; k < fan.time.size(); ++k) {
    values.clear();
    for (const std::vector<double>& line : fan.lines) {
      if (!std::isnan(line[k])) values.push_back(line[k]);
    }
    if (values.empty()) break;
    const double place = p * static_cast<double>(values.size() - 1);
    const auto low = static_cast<std::ptrdiff_t>(place);
    std::nth_element(values.begin(), values.begin() + low, values.end());
    const double first = values[static_cast<std::size_t>(low)];
    const bool is_last = low + 1 == static_cast<std::ptrdiff_t>(values.size());
    const double next = is_last ? first : *std::min_element(values.begin() + low + 1, values.end());
    result.push_back(first + (place - static_cast<double>(low)) * (next - first));
  }
  return result;
}

void draw_fan_legend(Canvas& canvas, const Area& chart, double right) {
  const Colour colour = output::k_accent;
  const TextStyle style{k_small_text, output::k_muted, Align::right};
  const double y = chart.top - 0.9 * k_small_text - 4.0;
  const auto entry = [&](std::string_view text, const auto& draw) {
    canvas.draw_text({right, y + 4.0}, text, style);
    right -= canvas.text_width(text, style) + 6.0;
    draw(right);
    right -= 32.0;
  };
  const auto box = [&](double opacity) {
    return [&canvas, &colour, y, opacity](double x) {
      canvas.fill_rectangle({x - 18.0, y - 5.0, 18.0, 10.0}, colour.with_opacity(opacity));
    };
  };
  entry("90 %", box(0.16));
  entry("50 %", box(0.42));
  entry("median", [&](double x) { canvas.draw_line({x - 18.0, y}, {x, y}, {colour, 2.4}); });
  if (right < chart.left + 140.0) return;
  entry("single", [&](double x) { canvas.draw_line({x - 18.0, y}, {x, y}, {output::k_ink.with_opacity(0.5), 0.9}); });
}

}  // namespace

void draw_faces(Canvas& canvas, const Area& area, const Summary& summary) {
  draw_heading(canvas, area, "Which face is up", summary.solved > 0 ? "with 95 % intervals" : "");
  Area chart = chart_in(area);
  if (summary.solved == 0) return draw_nothing(canvas, chart, "no instance was solved");
  const Scale y = scale_y(chart, 0.0, 112.0 * top_of_shares(summary));
  draw_y_axis(canvas, chart, y, "share", "%");
  const double pitch = chart.width / static_cast<double>(summary.shares.size());
  const bool is_narrow = pitch < 44.0;
  const Scale shares{y.low, y.high / 100.0, y.start, y.end};
  for (std::size_t k = 0; k < summary.shares.size(); ++k) {
    const Share& share = summary.shares[k];
    const double middle = chart.left + (static_cast<double>(k) + 0.5) * pitch;
    draw_share(canvas, chart, shares, share, middle, 0.62 * pitch, is_narrow);
    const bool is_face = share.outcome != Outcome::moving;
    if (is_face) draw_square_icon(canvas, {middle, chart.bottom() + 14.0}, 7.5, share.outcome);
    const std::string_view name = is_face ? name_of(share.outcome) : "moving";
    output::draw_text_within(canvas, 0.96 * pitch, {middle, chart.bottom() + (is_face ? 35.0 : 18.0)},
                             is_face && is_narrow ? name.substr(0, 2) : name,
                             {k_small_text, output::k_muted, Align::centre});
  }
  canvas.draw_line({chart.left, chart.bottom()}, {chart.right(), chart.bottom()}, {output::k_muted, 1.0});
}

void draw_histogram(Canvas& canvas, const Area& area, const Statistics& statistics, const Summary& summary,
                    std::size_t measure) {
  const MeasureSummary& m = summary.measures[measure];
  const std::string name = words_of(m.measure.name);
  std::string heading = name;
  heading[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  const Area chart = chart_in(area);
  if (m.count == 0) {
    draw_heading(canvas, area, heading);
    return draw_nothing(canvas, chart, "no instance has it");
  }
  const auto [edges, is_cut] = choose_bins(m, statistics.histogram(measure));
  const std::vector<double> counts = rebin(statistics.histogram(measure), edges, m.min, m.max, m.measure.is_whole);
  const double most = *std::max_element(counts.begin(), counts.end());
  const double percent = 100.0 / static_cast<double>(m.count);
  const std::string unit = m.measure.unit.empty() ? "" : tumble::format(" {}", m.measure.unit);
  std::string note = tumble::format("mean {:.3g}{}, median dashed, 90 % on the dark bar", m.mean, unit);
  if (m.missing > 0) {
    note += tumble::format("; {:.3g} % have none",
                           100.0 * static_cast<double>(m.missing) / static_cast<double>(summary.solved));
  }
  if (is_cut) note += tumble::format("; all in {:.3g} to {:.3g}", m.min, m.max);
  draw_heading(canvas, area, heading, note);
  const Scale x = scale_x(chart, edges.front(), edges.back()), y = scale_y(chart, 0.0, 1.06 * most * percent);
  draw_y_axis(canvas, chart, y, "share of each bar", "%");
  draw_x_axis(canvas, chart, x, name, m.measure.unit, false);
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const double left = x.to_pixel(edges[k]), right = x.to_pixel(edges[k + 1]), top = y.to_pixel(counts[k] * percent);
    const double gap = std::min(1.0, 0.12 * (right - left));
    canvas.fill_rectangle({left + 0.5 * gap, top, right - left - gap, chart.bottom() - top},
                          output::mix(output::k_paper, output::k_accent, 0.78));
  }
  canvas.draw_line({chart.left, chart.bottom()}, {chart.right(), chart.bottom()}, {output::k_muted, 1.0});
  draw_mark(canvas, chart, x.to_pixel(m.median), {output::k_ink, 1.3, 4.0, 3.0});
  // The middle 90 %, as a bar that lies on the axis.
  const double from = std::clamp(x.to_pixel(m.low), chart.left, chart.right());
  const double to = std::clamp(x.to_pixel(m.high), chart.left, chart.right());
  canvas.draw_line({from, chart.bottom()}, {to, chart.bottom()}, {output::k_ink, 3.0});
}

void draw_fan(Canvas& canvas, const Area& area, const Fan& fan) {
  constexpr std::size_t k_most_lines = 24;
  const Area chart = chart_in(area);
  draw_heading(canvas, area, tumble::format("{} over time", words_of(fan.name)),
               tumble::format("{} instances of the sweep", fan.lines.size()));
  const std::vector<double> low = quantiles(fan, 0.05), high = quantiles(fan, 0.95);
  if (low.empty()) return draw_nothing(canvas, chart, "no instance was solved");
  double bottom = low[0], top = high[0];
  for (const std::vector<double>& line : fan.lines) {
    for (const double value : line) {
      if (std::isnan(value)) continue;
      bottom = std::min(bottom, value);
      top = std::max(top, value);
    }
  }
  const double size = std::max(std::abs(top), std::abs(bottom));
  const bool is_flat = top - bottom <= 1e-12 * size;
  const double room = is_flat ? (size > 0.0 ? 0.5 * size : 1.0) : 0.04 * (top - bottom);
  const double end = fan.time.back() > fan.time.front() ? fan.time.back() : fan.time.front() + 1.0;
  const Scale x = scale_x(chart, fan.time.front(), end), y = scale_y(chart, bottom - room, top + room);
  draw_x_axis(canvas, chart, x, "time", "s");
  draw_y_axis(canvas, chart, y, words_of(fan.name), fan.unit);
  const Colour colour = output::k_accent;
  canvas.clip(chart);
  canvas.draw_polygon(band(x, y, fan.time, low, high), colour.with_opacity(0.16), {colour, 0.0});
  canvas.draw_polygon(band(x, y, fan.time, quantiles(fan, 0.25), quantiles(fan, 0.75)), colour.with_opacity(0.30),
                      {colour, 0.0});
  const std::size_t stride = std::max<std::size_t>(1, (fan.lines.size() + k_most_lines - 1) / k_most_lines);
  for (std::size_t i = 0; i < fan.lines.size(); i += stride) {
    std::vector<Point> points;
    for (std::size_t k = 0; k < fan.time.size() && !std::isnan(fan.lines[i][k]); ++k) {
      points.push_back({x.to_pixel(fan.time[k]), y.to_pixel(fan.lines[i][k])});
    }
    canvas.draw_polyline(points, {output::k_ink.with_opacity(0.38), 0.8});
  }
  const std::vector<double> median = quantiles(fan, 0.5);
  std::vector<Point> middle;
  for (std::size_t k = 0; k < median.size(); ++k) middle.push_back({x.to_pixel(fan.time[k]), y.to_pixel(median[k])});
  canvas.draw_polyline(middle, {colour, 2.4});
  canvas.unclip();
  draw_fan_legend(canvas, chart, chart.right());
}

}  // namespace tumble::sweep
