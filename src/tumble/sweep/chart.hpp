// What the charts of a sweep are made of: scales, axes, colours of values.
#pragma once

#include <string>
#include <string_view>

#include "tumble/output/canvas.hpp"
#include "tumble/output/view.hpp"
#include "tumble/sweep/statistics.hpp"

namespace tumble::sweep {

inline constexpr double k_small_text = 11.5;  // [px], as all lengths in units of Canvas
inline constexpr double k_panel_text = 14.0;

// Where the chart of a panel is: the area without heading and labels, and `right` [px] free beside it.
output::Area chart_in(const output::Area& area, double right = 16.0);

// The note only if there is room beside the heading.
void draw_heading(output::Canvas& canvas, const output::Area& area, std::string_view text, std::string_view note = "");

// In place of a chart.
void draw_nothing(output::Canvas& canvas, const output::Area& chart, std::string_view why);

// From values to pixels along an axis.
struct Scale {
  double low;  // value at the pixel `start`
  double high;
  double start;
  double end;
  bool is_logarithmic = false;

  double to_pixel(double value) const;
};

Scale scale_x(const output::Area& area, double low, double high, bool is_logarithmic = false);
Scale scale_y(const output::Area& area, double low, double high, bool is_logarithmic = false);

// Ticks and a grid line at each if `has_grid`, and the words "label [unit]": below the area, and above its upper left
// corner.
void draw_x_axis(output::Canvas& canvas, const output::Area& area, const Scale& scale, std::string_view label,
                 const std::string& unit, bool has_grid = true);
void draw_y_axis(output::Canvas& canvas, const output::Area& area, const Scale& scale, std::string_view label,
                 const std::string& unit, bool has_grid = true);

// The name of a column for reading: "final x" for "final_x".
std::string words_of(std::string_view name);

// The map viridis, even to the eye: dark at 0, light at 1.
output::Colour colour_of_value(double share);

// Apart also for the colour-blind [Okabe & Ito 2008].
output::Colour colour_of(Outcome outcome);

// What stands where there is no value.
void draw_missing(output::Canvas& canvas, const output::Area& area);

// A strip of the colours of values from low to high, with ticks at its right.
void draw_colour_bar(output::Canvas& canvas, const output::Area& strip, double low, double high);

}  // namespace tumble::sweep
