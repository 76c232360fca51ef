#include "tumble/output/draw.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "tumble/math/numeric.hpp"

namespace tumble::output {
namespace {

constexpr double k_smallest_side = 4.0;    // [px]; a smaller square is a dot of this size
constexpr double k_hatch_depth = 9.0;      // [px]
constexpr double k_hatch_step = 9.0;       // [px]
constexpr double k_tick_spacing_x = 64.0;  // [px], about
constexpr double k_tick_spacing_y = 42.0;

void draw_ground(Canvas& canvas, const View& view) {
  const double y = view.to_pixel(0.0, 0.0).y;
  const Frame& frame = view.frame;
  if (y < frame.top || y > frame.bottom()) return;
  canvas.clip({frame.left, y, frame.width, k_hatch_depth});
  for (double x = frame.left; x < frame.right() + k_hatch_depth; x += k_hatch_step) {
    canvas.draw_line({x, y}, {x - k_hatch_depth, y + k_hatch_depth}, {k_ground.with_opacity(0.55), 0.9});
  }
  canvas.unclip();
  canvas.draw_line({frame.left, y}, {frame.right(), y}, {k_ground, 1.5});
}

}  // namespace

Colour colour_of(ContactMode mode) {
  switch (mode) {
    case ContactMode::stick: return k_stick;
    case ContactMode::slip_left: return k_slip_left;
    case ContactMode::slip_right: return k_slip_right;
    case ContactMode::open: break;
  }
  return k_muted;
}

std::string parameters_text(const drop::Parameters& p) {
  return fmt::format("l = {:.6g} m,  m = {:.6g} kg,  μ = {:.6g},  ε = {:.6g},  Δt = {:.6g} s{}", p.l, p.m, p.mu, p.eps,
                     p.dt, p.g == drop::Parameters{}.g ? "" : fmt::format(",  g = {:.6g} m/s²", p.g));
}

int decimals_for(double largest, int low) {
  if (!(largest > 0.0) || !std::isfinite(largest)) return low;
  return std::clamp(2 - static_cast<int>(std::floor(std::log10(largest))), low, 6);
}

void draw_text_within(Canvas& canvas, double width, Point at, std::string_view text, TextStyle style) {
  const double needed = canvas.text_width(text, style);
  if (needed > width) style.size *= width / needed;
  canvas.draw_text(at, text, style);
}

void draw_surroundings(Canvas& canvas, const View& view, double text_size) {
  const Frame& frame = view.frame;
  const Axis x_axis = axis_x(view, std::max(2, static_cast<int>(frame.width / k_tick_spacing_x)));
  const Axis y_axis = axis_y(view, std::max(2, static_cast<int>(frame.height / k_tick_spacing_y)));
  const Stroke grid{k_grid, 1.0};
  TextStyle label{text_size, k_muted, Align::centre};
  for (const Tick& tick : x_axis.ticks) canvas.draw_line({tick.pixel, frame.top}, {tick.pixel, frame.bottom()}, grid);
  for (const Tick& tick : y_axis.ticks) canvas.draw_line({frame.left, tick.pixel}, {frame.right(), tick.pixel}, grid);

  const double baseline = frame.bottom() + 1.5 * text_size;
  for (const Tick& tick : x_axis.ticks) canvas.draw_text({tick.pixel, baseline}, tick.label, label);
  canvas.draw_text({frame.left + 0.5 * frame.width, baseline + 1.5 * text_size}, fmt::format("x [{}]", x_axis.unit),
                   label);
  label.align = Align::right;
  for (const Tick& tick : y_axis.ticks) {
    canvas.draw_text({frame.left - 0.6 * text_size, tick.pixel + 0.36 * text_size}, tick.label, label);
  }
  label.align = Align::left;
  canvas.draw_text({frame.left - 2.6 * text_size, frame.top - 0.8 * text_size}, fmt::format("y [{}]", y_axis.unit),
                   label);
  if (view.has_ground) draw_ground(canvas, view);
}

void draw_square(Canvas& canvas, const View& view, const Vector3& q, const drop::Parameters& parameters,
                 const SquareStyle& style) {
  const Point centre = view.to_pixel(q[0], q[1]);
  if (view.side < k_smallest_side) {
    canvas.draw_disc(centre, 0.5 * k_smallest_side, style.outline.colour);
    return;
  }
  // The corners of a unit square at the origin: exact however far away the real one is.
  drop::Parameters unit = parameters;
  unit.l = 1.0;
  unit.m = 1.0;
  std::vector<Point> corners;
  for (const auto& [x, y] : corner_positions({0.0, 0.0, q[2]}, unit)) {
    corners.push_back({centre.x + x * view.side, centre.y - y * view.side});
  }
  canvas.draw_polygon(corners, style.fill, style.outline);
  constexpr double k_mark_place = 0.56;  // from the centre to the corner
  const Point mark{centre.x + k_mark_place * (corners[0].x - centre.x),
                   centre.y + k_mark_place * (corners[0].y - centre.y)};
  canvas.draw_disc(mark, 0.085 * view.side, style.mark);
}

Point contact_pixel(const View& view, const drop::Record& record, int column) {
  const Vector3 q = record.trajectory.q_at(column);
  const auto corner = static_cast<std::size_t>(record.steps[static_cast<std::size_t>(column)].corner);
  drop::Parameters unit = record.parameters;
  unit.l = 1.0;
  unit.m = 1.0;
  const auto [x, y] = corner_positions({0.0, 0.0, q[2]}, unit)[corner];
  const Point centre = view.to_pixel(q[0], q[1]);
  return {centre.x + x * view.side, centre.y - y * view.side};
}

void draw_impulse(Canvas& canvas, Point tail, const Impulse& impulse, const ArrowStyle& style) {
  const double along_x = impulse.tangent / impulse.size;
  const double along_y = -impulse.normal / impulse.size;
  const double head = std::min(3.6 * style.width, 0.7 * style.length);
  const double half = 0.42 * head;
  const Point tip{tail.x + style.length * along_x, tail.y + style.length * along_y};
  const Point neck{tip.x - head * along_x, tip.y - head * along_y};
  canvas.draw_line(tail, {neck.x + 0.2 * head * along_x, neck.y + 0.2 * head * along_y}, {style.colour, style.width});
  canvas.draw_polygon(
      {tip, {neck.x - half * along_y, neck.y + half * along_x}, {neck.x + half * along_y, neck.y - half * along_x}},
      style.colour, {style.colour, 0.0});
}

void draw_cone(Canvas& canvas, Point apex, double mu, double length, double opacity) {
  const double along_y = 1.0 / std::hypot(1.0, mu);
  const double along_x = std::min(1.0, mu * along_y);  // mu may be so large that the product rounds above 1
  const Point left{apex.x - length * along_x, apex.y - length * along_y};
  const Point right{apex.x + length * along_x, apex.y - length * along_y};
  canvas.draw_polygon({apex, left, right}, k_muted.with_opacity(0.10 * opacity), {k_muted, 0.0});
  canvas.draw_polyline({left, apex, right}, {k_muted.with_opacity(0.45 * opacity), 0.8});
}

void draw_path(Canvas& canvas, const View& view, const drop::Record& record, int first, int last, const Stroke& style) {
  constexpr double k_closest = 0.3;  // [px]
  std::vector<Point> points;
  for (int k = first; k <= last; ++k) {
    const Vector3 q = record.trajectory.q_at(k);
    const Point point = view.to_pixel(q[0], q[1]);
    if (points.empty() || std::abs(point.x - points.back().x) > k_closest ||
        std::abs(point.y - points.back().y) > k_closest) {
      points.push_back(point);
    }
  }
  canvas.draw_polyline(points, style);
}

}  // namespace tumble::output
