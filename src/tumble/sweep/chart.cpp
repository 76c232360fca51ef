#include "tumble/sweep/chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tumble/math/format.hpp"
#include "tumble/output/draw.hpp"

namespace tumble::sweep {
namespace {

using output::Align;
using output::Area;
using output::Canvas;
using output::Colour;
using output::Point;
using output::TextStyle;
using output::Tick;

constexpr double k_tick_spacing_x = 70.0;
constexpr double k_tick_spacing_y = 38.0;

// Powers of ten; where there are fewer than three, their 2 and 5 times too.
std::vector<Tick> logarithmic_ticks(const Scale& scale) {
  const double first = std::floor(std::log10(scale.low)), last = std::ceil(std::log10(scale.high));
  const auto stride = std::max(1.0, std::ceil((last - first) / 8.0));
  std::vector<Tick> ticks;
  for (double power = first; power <= last; power += stride) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double value = factor * std::pow(10.0, power);
      if ((factor != 1.0 && last - first > 3.0) || value < scale.low * (1.0 - 1e-9) ||
          value > scale.high * (1.0 + 1e-9)) {
        continue;
      }
      ticks.push_back({scale.to_pixel(value), tumble::format("{:.6g}", value)});
    }
  }
  return ticks;
}

output::Axis axis_of(const Scale& scale, double spacing, const std::string& unit) {
  if (scale.is_logarithmic) return {logarithmic_ticks(scale), unit};
  const int count = std::max(2, static_cast<int>(std::abs(scale.end - scale.start) / spacing));
  return output::axis_along(scale.low, scale.high, scale.start, scale.end, count, unit);
}

std::string label_with_unit(std::string_view label, const std::string& unit) {
  return unit.empty() ? std::string(label) : tumble::format("{} [{}]", label, unit);
}

}  // namespace

Area chart_in(const Area& area, double right) {
  constexpr double k_left = 52.0, k_top = 50.0, k_bottom = 40.0;
  return {area.left + k_left, area.top + k_top, std::max(20.0, area.width - k_left - right),
          std::max(20.0, area.height - k_top - k_bottom)};
}

void draw_heading(Canvas& canvas, const Area& area, std::string_view text, std::string_view note) {
  constexpr double k_indent = 16.0;
  const TextStyle bold{k_panel_text, output::k_ink, Align::left, true};
  const Point start{area.left + k_indent, area.top + 16.0};
  output::draw_text_within(canvas, area.width - k_indent, start, text, bold);
  const TextStyle small{k_small_text, output::k_muted};
  const double used = canvas.text_width(text, bold) + 10.0;
  if (note.empty() || used + canvas.text_width(note, small) > area.width - k_indent) return;
  canvas.draw_text({start.x + used, start.y}, note, small);
}

void draw_nothing(Canvas& canvas, const Area& chart, std::string_view why) {
  draw_missing(canvas, chart);
  const TextStyle style{k_small_text + 1.0, output::k_muted, Align::centre};
  const double width = canvas.text_width(why, style) + 16.0;
  const Point middle{chart.left + 0.5 * chart.width, chart.top + 0.5 * chart.height};
  canvas.fill_rectangle({middle.x - 0.5 * width, middle.y - 13.0, width, 22.0}, output::k_paper);
  canvas.draw_text({middle.x, middle.y + 2.0}, why, style);
}

double Scale::to_pixel(double value) const {
  const double share = is_logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  return start + share * (end - start);
}

Scale scale_x(const Area& area, double low, double high, bool is_logarithmic) {
  return {low, high, area.left, area.right(), is_logarithmic};
}

Scale scale_y(const Area& area, double low, double high, bool is_logarithmic) {
  return {low, high, area.bottom(), area.top, is_logarithmic};
}

void draw_x_axis(Canvas& canvas, const Area& area, const Scale& scale, std::string_view label, const std::string& unit,
                 bool has_grid) {
  const output::Axis axis = axis_of(scale, k_tick_spacing_x, unit);
  const TextStyle style{k_small_text, output::k_muted, Align::centre};
  const double baseline = area.bottom() + 1.5 * k_small_text;
  double free_from = area.left - 2.0 * k_small_text;  // a label never runs into the one before it
  for (const Tick& tick : axis.ticks) {
    if (has_grid) canvas.draw_line({tick.pixel, area.top}, {tick.pixel, area.bottom()}, {output::k_grid, 1.0});
    canvas.draw_line({tick.pixel, area.bottom()}, {tick.pixel, area.bottom() + 3.0}, {output::k_muted, 1.0});
    const double half = 0.5 * canvas.text_width(tick.label, style);
    if (tick.pixel - half < free_from) continue;
    canvas.draw_text({tick.pixel, baseline}, tick.label, style);
    free_from = tick.pixel + half + 5.0;
  }
  canvas.draw_text({area.left + 0.5 * area.width, baseline + 1.45 * k_small_text}, label_with_unit(label, axis.unit),
                   style);
}

void draw_y_axis(Canvas& canvas, const Area& area, const Scale& scale, std::string_view label, const std::string& unit,
                 bool has_grid) {
  const output::Axis axis = axis_of(scale, k_tick_spacing_y, unit);
  TextStyle style{k_small_text, output::k_muted, Align::right};
  for (const Tick& tick : axis.ticks) {
    if (has_grid) canvas.draw_line({area.left, tick.pixel}, {area.right(), tick.pixel}, {output::k_grid, 1.0});
    canvas.draw_text({area.left - 0.6 * k_small_text, tick.pixel + 0.36 * k_small_text}, tick.label, style);
  }
  style.align = Align::left;
  canvas.draw_text({area.left - 3.2 * k_small_text, area.top - 0.9 * k_small_text}, label_with_unit(label, axis.unit),
                   style);
}

std::string words_of(std::string_view name) {
  std::string words(name);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

Colour colour_of_value(double share) {
  // Every sixteenth of the 256 colours.
  static constexpr std::array<std::array<unsigned char, 3>, 17> k_viridis = {{{68, 1, 84},
                                                                              {72, 20, 103},
                                                                              {72, 38, 119},
                                                                              {69, 55, 129},
                                                                              {63, 71, 136},
                                                                              {57, 85, 140},
                                                                              {50, 100, 142},
                                                                              {45, 113, 142},
                                                                              {39, 127, 142},
                                                                              {34, 140, 141},
                                                                              {31, 154, 138},
                                                                              {42, 168, 132},
                                                                              {66, 182, 120},
                                                                              {103, 196, 101},
                                                                              {149, 208, 76},
                                                                              {202, 219, 46},
                                                                              {253, 231, 37}}};
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(k_viridis.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(place), k_viridis.size() - 2);
  const auto at = [&](std::size_t index) {
    const auto& [red, green, blue] = k_viridis[index];
    return Colour{red / 255.0, green / 255.0, blue / 255.0};
  };
  return output::mix(at(k), at(k + 1), place - static_cast<double>(k));
}

Colour colour_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::face_0: return output::k_accent;
    case Outcome::face_1: return output::k_slip_left;
    case Outcome::face_2: return output::k_stick;
    case Outcome::face_3: return output::k_slip_right;
    case Outcome::moving:
    case Outcome::numerical:
    case Outcome::invalid: break;
  }
  return output::k_muted;
}

void draw_missing(Canvas& canvas, const Area& area) {
  constexpr double k_spacing = 6.0;
  canvas.fill_rectangle(area, output::k_fixed_fill);
  canvas.clip(area);
  for (double x = area.left - area.height; x < area.right(); x += k_spacing) {
    canvas.draw_line({x, area.bottom()}, {x + area.height, area.top}, {{0.78, 0.81, 0.84}, 0.8});
  }
  canvas.unclip();
}

void draw_colour_bar(Canvas& canvas, const Area& strip, double low, double high) {
  constexpr int k_steps = 64;
  for (int k = 0; k < k_steps; ++k) {
    const double height = strip.height / k_steps;
    canvas.fill_rectangle({strip.left, strip.bottom() - height * (k + 1), strip.width, height + (k > 0 ? 0.5 : 0.0)},
                          colour_of_value((k + 0.5) / k_steps));
  }
  const TextStyle style{k_small_text, output::k_muted};
  const Scale scale{low, high, strip.bottom(), strip.top};
  for (const Tick& tick : axis_of(scale, k_tick_spacing_y, "").ticks) {
    canvas.draw_line({strip.right(), tick.pixel}, {strip.right() + 3.0, tick.pixel}, {output::k_muted, 1.0});
    canvas.draw_text({strip.right() + 6.0, tick.pixel + 0.36 * k_small_text}, tick.label, style);
  }
}

}  // namespace tumble::sweep
