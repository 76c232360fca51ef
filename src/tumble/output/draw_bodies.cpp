#include "tumble/output/draw_bodies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "tumble/output/draw.hpp"

namespace tumble::output {
namespace {

constexpr double k_smallest_radius = 2.0;  // [px]; a smaller body is a dot of this size
constexpr double k_hatch_depth = 9.0;      // [px]
constexpr double k_hatch_step = 9.0;
constexpr double k_chevron_step = 26.0;
constexpr double k_chevron_inset = 5.0;
constexpr double k_margin = 60.0;  // around the area, for what is drawn beside its edge

constexpr std::array<BodyColours, 5> k_kinds = {{{{0.62, 0.73, 0.85}, {0.13, 0.34, 0.60}},
                                                 {{0.97, 0.85, 0.60}, {0.60, 0.41, 0.05}},
                                                 {{0.72, 0.86, 0.70}, {0.20, 0.45, 0.23}},
                                                 {{0.94, 0.74, 0.73}, {0.62, 0.20, 0.25}},
                                                 {{0.81, 0.75, 0.90}, {0.37, 0.25, 0.60}}}};
constexpr BodyColours k_moved = {{0.78, 0.81, 0.84}, {0.28, 0.33, 0.38}};  // by its own motion
constexpr BodyColours k_fixed = {k_fixed_fill, k_ground};

Point to_point(Vector2 p) { return {p.x, -p.y}; }
Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }

void draw_chevron(Canvas& canvas, Point place, Vector2 along, Vector2 inward) {
  const Point tip = place + to_point(2.6 * along + k_chevron_inset * inward);
  const Point one = tip + to_point(-4.0 * along + 3.2 * inward), other = tip + to_point(-4.0 * along - 3.2 * inward);
  canvas.draw_polyline({one, tip, other}, {k_ground, 1.3});
}

// A side of an outline in the picture.
struct Side {
  Point start;
  Vector2 along;  // of length 1, y up
  double length;  // [px]
};

Side side_of(const PartOutline& outline, std::size_t i, Point centre, const Frame& turn) {
  const Vector2 run = direction_to_world(turn, outline.points[(i + 1) % outline.points.size()] - outline.points[i]);
  const double size = length(run);
  return {placed(outline.points[i], centre, turn), size > 0.0 ? 1.0 / size * run : Vector2{}, size};
}

std::size_t count_sides(const PartOutline& outline) {
  return outline.points.size() - (outline.kind == LineKind::closed ? 0 : 1);
}

// Calls mark(at) every `step` pixels along a side as far as it lies in the area, the first at `next`. Returns the first
// one on the next side.
template <class DrawMark>
double mark_side(const Side& side, double next, double step, const Area& area, DrawMark mark) {
  const auto from = [&](double low) { return next + step * std::ceil(std::max(0.0, low - next) / step); };
  Point a = side.start, b = side.start + to_point(side.length * side.along);
  if (clip_line(a, b, area)) {
    const double last = std::hypot(b.x - side.start.x, b.y - side.start.y);
    for (double at = from(std::hypot(a.x - side.start.x, a.y - side.start.y)); at < last; at += step) mark(at);
  }
  return from(side.length) - side.length;
}

}  // namespace

std::vector<BodyColours> body_colours(const Scene& scene) {
  std::map<std::string, std::size_t> kinds;
  std::vector<BodyColours> colours;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    if (body.kind != BodyKind::dynamic) {
      colours.push_back(body.kind == BodyKind::fixed ? k_fixed : k_moved);
      continue;
    }
    const std::string kind = body.name.substr(0, body.name.find_last_not_of("0123456789") + 1);
    const std::size_t next = kinds.size();
    colours.push_back(k_kinds[kinds.try_emplace(kind, next).first->second % k_kinds.size()]);
  }
  return colours;
}

BodyStyle solid_style(const BodyColours& colours) { return {colours.fill, {colours.deep, 1.6}, colours.deep}; }

BodyDrawing::BodyDrawing(const Scene& scene, const View& view)
    : scene_(scene), view_(view), around_(view.area), colours_(body_colours(scene)) {
  around_.left -= k_margin;
  around_.top -= k_margin;
  around_.width += 2.0 * k_margin;
  around_.height += 2.0 * k_margin;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    outlines_.push_back(outline_of(scene.bodies[i], view));
    if (scene.bodies[i].kind != BodyKind::fixed) moving_.push_back(i);
  }
}

double BodyDrawing::arrow_room(double usual) const {
  const double room = std::min(usual, 0.3 * view_.area.height);
  if (!is_crowd()) return room;
  std::vector<double> radii;
  for (const std::size_t body : moving_) radii.push_back(outlines_[body].radius);
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  constexpr double k_least = 24.0;  // [px]
  return std::min(room, std::max(k_least, 1.3 * *middle));
}

void BodyDrawing::draw_fixed(Canvas& canvas) const {
  for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
    const Body& body = scene_.bodies[i];
    if (body.kind != BodyKind::fixed) continue;
    draw(canvas, i, body.pose, {colours_[i].fill, {colours_[i].deep, 1.5}, colours_[i].deep.with_opacity(0.0)});
  }
}

void BodyDrawing::draw_ground(Canvas& canvas, const PartOutline& outline, Point centre, const Frame& turn) const {
  canvas.clip(view_.area);
  double next = 0.0;
  Side before{};
  for (std::size_t i = 0; i < count_sides(outline); ++i) {
    const Side side = side_of(outline, i, centre, turn);
    next = mark_side(side, next, k_hatch_step, around_, [&](double at) {
      const Point foot = side.start + to_point(at * side.along);
      const Point end = foot + to_point(k_hatch_depth * (turned_right(side.along) - side.along));
      // None that would come out of the ground behind a corner.
      const Vector2 way = {end.x - before.start.x, before.start.y - end.y};
      if (at < k_hatch_depth && cross(before.along, way) > 0.0) return;
      canvas.draw_line(foot, end, {k_ground.with_opacity(0.55), 0.9});
    });
    Point a = side.start, b = a + to_point(side.length * side.along);
    if (clip_line(a, b, around_)) canvas.draw_line(a, b, {k_ground, 1.5});
    before = side;
  }
  canvas.unclip();
}

void BodyDrawing::draw(Canvas& canvas, std::size_t body, const Pose& pose, const BodyStyle& usual_style) const {
  const BodyOutline& outline = outlines_[body];
  constexpr double k_thin_below = 18.0;  // [px]; lines of smaller bodies are finer
  BodyStyle style = usual_style;
  style.outline.width *= std::clamp(outline.radius / k_thin_below, 0.45, 1.0);
  const Point centre = view_.to_pixel(pose.position);
  const Area& area = view_.area;
  const double far =
      std::max({area.left - centre.x, centre.x - area.right(), area.top - centre.y, centre.y - area.bottom()});
  if (far > outline.radius + k_margin) return;
  if (outline.radius < k_smallest_radius) {
    canvas.draw_disc(centre, k_smallest_radius, style.outline.colour);
    return;
  }
  const Frame turn = frame_of({{}, pose.angle});
  std::vector<std::vector<Point>> closed;
  constexpr double k_largest_radius = 3000.0;  // [px]
  for (const PartOutline& part : outline.parts) {
    if (part.kind == LineKind::ground) draw_ground(canvas, part, centre, turn);
    if (part.kind == LineKind::wall) {
      Point a = placed(part.points[0], centre, turn), b = placed(part.points[1], centre, turn);
      if (clip_line(a, b, around_)) canvas.draw_line(a, b, {style.outline.colour, 1.4 * style.outline.width});
    }
    if (part.kind != LineKind::closed) continue;
    std::vector<Point> points;
    for (const Vector2 point : part.points) points.push_back(placed(point, centre, turn));
    if (outline.radius > k_largest_radius) points = clipped(std::move(points), around_);
    if (!points.empty()) closed.push_back(std::move(points));
  }
  if (closed.size() == 1) {
    canvas.draw_polygon(closed[0], style.fill, style.outline);
  } else if (!closed.empty()) {
    // Of several parts only the outer half of the outlines stays, so that they look like one.
    const auto on_paper = [](const Colour& c) { return mix(k_paper, c.with_opacity(1.0), c.opacity); };
    Stroke wide = style.outline;
    wide.width *= 2.0;
    wide.colour = on_paper(wide.colour);
    for (const std::vector<Point>& points : closed) canvas.draw_polygon(points, wide.colour, wide);
    for (const std::vector<Point>& points : closed)
      canvas.draw_polygon(points, on_paper(style.fill), {wide.colour, 0.0});
  }
  const Mark& mark = outline.mark;
  if (style.mark.opacity == 0.0) return;
  if (mark.radius > 0.0) canvas.draw_disc(placed(mark.from, centre, turn), mark.radius, style.mark);
  if (mark.from != mark.to) {
    canvas.draw_line(placed(mark.from, centre, turn), placed(mark.to, centre, turn), {style.mark, style.outline.width});
  }
}

void BodyDrawing::draw_conveyors(Canvas& canvas, std::span<const BodyState> states, double time) const {
  canvas.clip(view_.area);
  for (std::size_t i = 0; i < outlines_.size(); ++i) {
    const Frame turn = frame_of({{}, states[i].pose.angle});
    const Point centre = view_.to_pixel(states[i].pose.position);
    for (const PartOutline& part : outlines_[i].parts) {
      if (part.surface_speed == 0.0) continue;
      // The surface runs along the outward normal turned right: against the order of a closed outline.
      const double sense = part.kind == LineKind::closed ? -1.0 : 1.0;
      const double direction = std::copysign(1.0, sense * part.surface_speed);
      double next = std::fmod(sense * part.surface_speed * time, k_chevron_step);
      if (next < 0.0) next += k_chevron_step;
      for (std::size_t k = 0; k < count_sides(part); ++k) {
        const Side side = side_of(part, k, centre, turn);
        const Vector2 inward = sense < 0.0 ? turned_left(side.along) : turned_right(side.along);
        next = mark_side(side, next, k_chevron_step, around_, [&](double at) {
          draw_chevron(canvas, side.start + to_point(at * side.along), direction * side.along, inward);
        });
      }
    }
  }
  canvas.unclip();
}

void draw_path(Canvas& canvas, const View& view, const Trajectory& trajectory, std::size_t body, std::size_t first,
               std::size_t last, const Stroke& style) {
  constexpr double k_closest = 0.3;  // [px]
  std::vector<Point> points;
  for (std::size_t k = first; k <= last; ++k) {
    const Point point = view.to_pixel(trajectory.bodies(k)[body].pose.position);
    if (points.empty() || std::abs(point.x - points.back().x) > k_closest ||
        std::abs(point.y - points.back().y) > k_closest) {
      points.push_back(point);
    }
  }
  canvas.draw_polyline(points, style);
}

}  // namespace tumble::output
