#include "tumble/output/view.hpp"

#include <algorithm>
#include <cmath>

#include "tumble/math/format.hpp"

namespace tumble::output {
namespace {

// Labels with more digits than this are told relative to the middle.
constexpr double k_longest_label = 1e4;

struct AxisRange {
  double middle;
  double half;
};

// `place` turns a position relative to the middle [m] into pixels.
template <class Place>
Axis make_axis(const AxisRange& range, int count, const std::string& unit, Place place) {
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
    axis.ticks.push_back({place(shift + value),
                          is_plain ? tumble::format("{:.{}f}", value, decimals) : tumble::format("{:.6g}", value)});
  }
  axis.unit = is_far ? tumble::format("{0} from {1:.12g} {0}", unit, base) : unit;
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

View fit_view(const Sight& sight, const Area& area, const Margins& margins) {
  const double width = std::max(1.0, area.width - 2.0 * margins.side);
  const double height = std::max(1.0, area.height - margins.top - margins.bottom);
  const Vector2 size = sight.box.high - sight.box.low;
  const double scale = std::min({width / size.x, height / size.y, std::min(width, height) / sight.smallest});
  View view{area, {}, scale};
  view.middle.x = 0.5 * sight.box.low.x + 0.5 * sight.box.high.x;
  // A box lower than the area rests on the bottom margin if it stands on the ground, else it hangs in the middle.
  const double spare = height - size.y * scale;
  const double below = margins.bottom + (sight.has_ground ? 0.0 : 0.5 * spare);
  view.middle.y = sight.box.low.y + (0.5 * area.height - below) / scale;
  return view;
}

Axis axis_x(const View& view, int count) {
  const double centre = view.area.left + 0.5 * view.area.width;
  return make_axis({view.middle.x, 0.5 * view.area.width / view.scale}, count, "m",
                   [&](double offset) { return centre + offset * view.scale; });
}

Axis axis_y(const View& view, int count) {
  const double centre = view.area.top + 0.5 * view.area.height;
  return make_axis({view.middle.y, 0.5 * view.area.height / view.scale}, count, "m",
                   [&](double offset) { return centre - offset * view.scale; });
}

Axis axis_along(double low, double high, double start, double end, int count, const std::string& unit) {
  const double half = 0.5 * high - 0.5 * low;
  const double scale = 0.5 * (end - start) / half;
  return make_axis({low + half, half}, count, unit,
                   [&](double offset) { return start + 0.5 * (end - start) + offset * scale; });
}

}  // namespace tumble::output
