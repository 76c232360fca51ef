#include "tumble/output/draw.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "tumble/math/format.hpp"
#include "tumble/math/numeric.hpp"

namespace tumble::output {
namespace {

constexpr double k_tick_spacing_x = 64.0;  // [px], about
constexpr double k_tick_spacing_y = 42.0;

// The law of all contacts, if there is one for all.
std::optional<ContactLaw> only_law(const Scene& scene) {
  if (scene.materials.empty() || !scene.pairs.empty()) return std::nullopt;
  const ContactLaw& law = scene.materials[0].law;
  const bool is_only = std::all_of(scene.materials.begin(), scene.materials.end(),
                                   [&](const Material& material) { return material.law == law; });
  return is_only ? std::optional(law) : std::nullopt;
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

std::string title_of(const Trajectory& trajectory) {
  return trajectory.scene.title.empty() ? "A scene" : trajectory.scene.title;
}

std::size_t sample_at(const Trajectory& trajectory, double time) {
  const std::vector<double>& times = trajectory.time;
  const auto next = std::lower_bound(times.begin(), times.end(), time);
  if (next == times.begin()) return 0;
  if (next == times.end()) return times.size() - 1;
  const auto index = static_cast<std::size_t>(next - times.begin());
  return *next - time < time - *(next - 1) ? index : index - 1;
}

std::string facts_text(const Trajectory& trajectory) {
  const Scene& scene = trajectory.scene;
  std::vector<const Body*> dynamic;
  for (const Body& body : scene.bodies) {
    if (body.kind == BodyKind::dynamic) dynamic.push_back(&body);
  }
  std::string text = dynamic.size() == 1 ? tumble::format("m = {:.6g} kg,  ", dynamic[0]->mass)
                                         : tumble::format("{} bodies,  ", dynamic.size());
  if (const std::optional<ContactLaw> law = only_law(scene)) {
    text += tumble::format("μ = {:.6g},  ", law->friction);
    if (law->static_friction != law->friction) text += tumble::format("static {:.6g},  ", law->static_friction);
    text += tumble::format("ε = {:.6g},  ", law->restitution);
  }
  const Vector2 g = scene.gravity;
  if (g.x != 0.0) {
    text += tumble::format("g = ({:.6g}, {:.6g}) m/s²,  ", g.x, g.y);
  } else if (g != Scene{}.gravity) {
    text += tumble::format("g = {:.6g} m/s²,  ", 0.0 - g.y);
  }
  return text + tumble::format("Δt = {:.6g} s", trajectory.step_size);
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

void draw_axes(Canvas& canvas, const View& view, double text_size) {
  const Area& area = view.area;
  const Axis x_axis = axis_x(view, std::max(2, static_cast<int>(area.width / k_tick_spacing_x)));
  const Axis y_axis = axis_y(view, std::max(2, static_cast<int>(area.height / k_tick_spacing_y)));
  const Stroke grid{k_grid, 1.0};
  TextStyle label{text_size, k_muted, Align::centre};
  for (const Tick& tick : x_axis.ticks) canvas.draw_line({tick.pixel, area.top}, {tick.pixel, area.bottom()}, grid);
  for (const Tick& tick : y_axis.ticks) canvas.draw_line({area.left, tick.pixel}, {area.right(), tick.pixel}, grid);

  const double baseline = area.bottom() + 1.5 * text_size;
  for (const Tick& tick : x_axis.ticks) canvas.draw_text({tick.pixel, baseline}, tick.label, label);
  canvas.draw_text({area.left + 0.5 * area.width, baseline + 1.5 * text_size}, tumble::format("x [{}]", x_axis.unit),
                   label);
  label.align = Align::right;
  for (const Tick& tick : y_axis.ticks) {
    canvas.draw_text({area.left - 0.6 * text_size, tick.pixel + 0.36 * text_size}, tick.label, label);
  }
  label.align = Align::left;
  canvas.draw_text({area.left - 2.6 * text_size, area.top - 0.8 * text_size}, tumble::format("y [{}]", y_axis.unit),
                   label);
}

void draw_impulse(Canvas& canvas, Point tail, const Impulse& impulse, const ArrowStyle& style) {
  const Vector2 n = impulse.normal, t = turned_right(n);
  const Vector2 along = 1.0 / impulse.size * (impulse.along_normal * n + impulse.along_tangent * t);
  const double x = along.x, y = -along.y;  // in the picture y points down
  const double head = std::min(3.6 * style.width, 0.7 * style.length);
  const double half = 0.42 * head;
  const Point tip{tail.x + style.length * x, tail.y + style.length * y};
  const Point neck{tip.x - head * x, tip.y - head * y};
  canvas.draw_line(tail, {neck.x + 0.2 * head * x, neck.y + 0.2 * head * y}, {style.colour, style.width});
  canvas.draw_polygon({tip, {neck.x - half * y, neck.y + half * x}, {neck.x + half * y, neck.y - half * x}},
                      style.colour, {style.colour, 0.0});
}

void draw_cone(Canvas& canvas, Point apex, Vector2 normal, double friction, double length, double opacity) {
  const double along_n = 1.0 / std::hypot(1.0, friction);
  const double along_t = std::min(1.0, friction * along_n);  // friction may be so large that the product rounds above 1
  const auto edge = [&](double side) {
    const Vector2 end = length * (along_n * normal + side * along_t * turned_right(normal));
    return Point{apex.x + end.x, apex.y - end.y};
  };
  const Point left = edge(-1.0), right = edge(1.0);
  canvas.draw_polygon({apex, left, right}, k_muted.with_opacity(0.10 * opacity), {k_muted, 0.0});
  canvas.draw_polyline({left, apex, right}, {k_muted.with_opacity(0.45 * opacity), 0.8});
}

}  // namespace tumble::output
