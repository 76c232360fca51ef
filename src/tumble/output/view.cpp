#include "tumble/output/view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace tumble::output {
namespace {

// Products of two such numbers stay finite.
constexpr double k_largest = 1e100;
constexpr double k_smallest_side = 1e-100;

// The ground is part of the picture while it is no farther below the path than this many times the path's own
// size.
constexpr double k_ground_reach = 2.0;
constexpr double k_smallest_size = 4.0;  // of the picture, in sides of the square: room around a square at rest

// Labels with more digits than this are told relative to the middle.
constexpr double k_longest_label = 1e4;

struct AxisRange {
  double middle;
  double half;
};

// `place` turns a position relative to the middle [m] into pixels.
template <class Place>
Axis make_axis(const AxisRange& range, int count, Place place) {
  Axis axis;
  const double step = round_up_nicely(2.0 * range.half / count);
  // Ticks are counted from a base that is a multiple of ten steps: 0 unless the numbers would become too
  // long.
  const bool is_far = std::abs(range.middle) / step > k_longest_label;
  const double base = is_far ? std::round(range.middle / (10.0 * step)) * (10.0 * step) : 0.0;
  const double shift = base - range.middle;
  const double first = std::ceil((-range.half - shift) / step - 1e-9);
  const double last = std::floor((range.half - shift) / step + 1e-9);
  const bool is_plain = step >= 1e-4 && step * std::max(std::abs(first), std::abs(last)) < 1e6;
  const int decimals = is_plain ? std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9))) : 0;
  for (double i = first; i <= last; i += 1.0) {
    // 0.0 + turns -0 into 0.
    const double value = 0.0 + i * step;
    axis.ticks.push_back(
        {place(shift + value), is_plain ? fmt::format("{:.{}f}", value, decimals) : fmt::format("{:.6g}", value)});
  }
  axis.unit = is_far ? fmt::format("m from {:.12g} m", base) : "m";
  return axis;
}

}  // namespace

double round_down_nicely(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {5.0, 2.0}) {
    if (value / power >= factor * (1.0 - 1e-9)) return factor * power;
  }
  return power;
}

double round_up_nicely(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= value * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

Box box_of(const drop::Record& record) {
  const auto columns = static_cast<std::size_t>(record.trajectory.columns);
  const double l = record.parameters.l;
  const auto x_begin = record.trajectory.q.begin();
  const auto y_begin = x_begin + static_cast<std::ptrdiff_t>(columns);
  const auto [x_low, x_high] = std::minmax_element(x_begin, y_begin);
  const auto [y_low, y_high] = std::minmax_element(y_begin, y_begin + static_cast<std::ptrdiff_t>(columns));
  for (const double value : {*x_low, *x_high, *y_low, *y_high, l}) {
    if (std::abs(value) <= k_largest && l >= k_smallest_side) continue;
    throw std::invalid_argument(
        fmt::format("picture: positions must lie in [-{0:g}, {0:g}] m and l in [{1:g}, {0:g}] m, got {2:g}", k_largest,
                    k_smallest_side, std::abs(value) <= k_largest ? l : value));
  }
  const double radius = l * std::sqrt(0.5);  // the square turns within this circle
  Box box{*x_low - radius, *x_high + radius, *y_low - radius, *y_high + radius, false};
  const double size = std::max({box.x_high - box.x_low, box.y_high - box.y_low, k_smallest_size * l});
  box.has_ground = box.y_low <= k_ground_reach * size && box.y_high >= -k_ground_reach * size;
  if (box.has_ground) {
    box.y_low = std::min(box.y_low, 0.0);
    box.y_high = std::max(box.y_high, 0.0);
  }
  return box;
}

View fit_view(const Box& box, double l, const Frame& frame, const Margins& margins) {
  const double width = std::max(1.0, frame.width - 2.0 * margins.side);
  const double height = std::max(1.0, frame.height - margins.top - margins.bottom);
  const double box_width = box.x_high - box.x_low;
  const double box_height = box.y_high - box.y_low;
  const double smallest = k_smallest_size * l;
  const double scale = std::min({width / box_width, height / box_height, std::min(width, height) / smallest});
  View view{frame, {}, scale, l * scale, box.has_ground};
  view.middle.x = 0.5 * box.x_low + 0.5 * box.x_high;
  // A box lower than the frame rests on the bottom margin if it stands on the ground, else it hangs in the
  // middle.
  const double spare = height - box_height * scale;
  const double below = margins.bottom + (box.has_ground && box.y_low > -smallest ? 0.0 : 0.5 * spare);
  view.middle.y = box.y_low + (0.5 * frame.height - below) / scale;
  return view;
}

Axis axis_x(const View& view, int count) {
  const double centre = view.frame.left + 0.5 * view.frame.width;
  return make_axis({view.middle.x, 0.5 * view.frame.width / view.scale}, count,
                   [&](double offset) { return centre + offset * view.scale; });
}

Axis axis_y(const View& view, int count) {
  const double centre = view.frame.top + 0.5 * view.frame.height;
  return make_axis({view.middle.y, 0.5 * view.frame.height / view.scale}, count,
                   [&](double offset) { return centre - offset * view.scale; });
}

}  // namespace tumble::output
