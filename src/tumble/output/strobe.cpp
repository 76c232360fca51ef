#include "tumble/output/strobe.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tumble/math/format.hpp"
#include "tumble/output/draw.hpp"
#include "tumble/output/draw_bodies.hpp"

namespace tumble::output {
namespace {

// Lengths are in units of the design, see Canvas.
constexpr double k_left = 70.0;
constexpr double k_top = 122.0;
constexpr double k_bottom = 52.0;
constexpr double k_panel = 244.0;
constexpr double k_gap = 26.0;
constexpr double k_right = 22.0;
constexpr double k_default_plot_height = 540.0;
constexpr double k_narrowest_plot = 400.0;
constexpr double k_widest_plot = 900.0;
constexpr double k_lowest_plot = 430.0;  // the words beside it need as much
constexpr double k_default_width = 1012.0;
constexpr double k_default_height = 714.0;
constexpr Margins k_margins = {22.0, 22.0, 48.0};
constexpr double k_png_scale = 1.6;

constexpr int k_most_poses = 30;   // of one body
constexpr int k_most_drawn = 150;  // poses of all bodies
constexpr int k_fewest_poses = 4;  // fewer are left out
constexpr int k_most_paths = 40;
constexpr std::size_t k_most_impacts = 8;   // with a number and a line in the table
constexpr double k_smallest_impact = 0.08;  // of the largest impulse
constexpr std::size_t k_most_arrows = 60;
// Of a crowd the contacts of the end are shown in place of impacts on the way.
constexpr std::size_t k_most_last_arrows = 2000;
constexpr double k_smallest_arrow = 0.02;
constexpr double k_longest_arrow = 110.0;
constexpr double k_text = 12.5;

struct Sizes {
  int width;     // [px]
  int height;    // [px]
  double scale;  // [px] per unit of the design
};

Sizes choose_sizes(const Sight& sight, int width, int height, double default_scale) {
  Vector2 size = sight.box.high - sight.box.low;  // may be 0 far from the origin
  size = {std::max(size.x, sight.smallest), std::max(size.y, sight.smallest)};
  double plot_height = k_default_plot_height;
  double plot_width = (plot_height - k_margins.top - k_margins.bottom) * size.x / size.y + 2.0 * k_margins.side;
  if (plot_width > k_widest_plot) {
    plot_height = std::max(k_lowest_plot, plot_height * k_widest_plot / plot_width);
    plot_width = k_widest_plot;
  }
  plot_width = std::max(plot_width, k_narrowest_plot);
  const double design_width = k_left + plot_width + k_gap + k_panel + k_right;
  const double design_height = k_top + plot_height + k_bottom;
  if (width == 0 && height == 0) {
    return {static_cast<int>(std::lround(default_scale * design_width)),
            static_cast<int>(std::lround(default_scale * design_height)), default_scale};
  }
  if (width == 0) width = static_cast<int>(std::lround(height * design_width / design_height));
  if (height == 0) height = static_cast<int>(std::lround(width * design_height / design_width));
  return {width, height, std::min(width / k_default_width, height / k_default_height)};
}

// What the picture shows.
struct Show {
  Show(const Trajectory& the_trajectory, const View& the_view);

  double duration() const { return trajectory.time.back(); }
  std::size_t last() const { return trajectory.time.size() - 1; }

  const Trajectory& trajectory;
  View view;
  BodyDrawing bodies;
  double arrow_room;             // [px]
  double interval;               // between poses [s]; 0: none but the first and the last
  std::vector<Impulse> touches;  // of the whole run, of a crowd those of the last step
  double largest;                // of these [N s]
  std::vector<Impulse> arrows;
  std::vector<Impulse> impacts;  // those with a number
};

double choose_interval(const Trajectory& trajectory, std::size_t num_moving) {
  const double duration = trajectory.time.back();
  const int poses = std::min(k_most_poses, k_most_drawn / static_cast<int>(std::max<std::size_t>(num_moving, 1)));
  if (!(duration > 0.0 && std::isfinite(duration)) || poses < k_fewest_poses) return 0.0;
  return std::max(round_up_nicely(duration / poses), trajectory.time[1]);
}

Show::Show(const Trajectory& the_trajectory, const View& the_view)
    : trajectory(the_trajectory),
      view(the_view),
      bodies(trajectory.scene, view),
      arrow_room(bodies.arrow_room(k_longest_arrow)),
      interval(choose_interval(trajectory, bodies.moving().size())),
      touches(bodies.is_crowd() ? impulses_at_end(trajectory) : largest_of_each_touch(trajectory)),
      largest(largest_size(touches)) {
  const std::size_t most = bodies.is_crowd() ? k_most_last_arrows : k_most_arrows;
  arrows = keep_largest(touches, most, k_smallest_arrow * largest);
  if (!bodies.is_crowd()) impacts = keep_largest(touches, k_most_impacts, k_smallest_impact * largest);
}

double start_of(const Impulse& impulse, const Show& show) {
  return static_cast<double>(impulse.step - 1) * show.trajectory.step_size;
}

// ---- The plot ----

// Of one kind of bodies at the start, on the way and at the end.
BodyStyle start_style(const BodyColours& c) { return {k_paper.with_opacity(0.6), {c.deep, 1.4, 5.0, 3.5}, c.deep}; }
BodyStyle end_style(const BodyColours& c) { return {c.fill, {c.deep, 1.9}, c.deep}; }

Colour colour_at(const BodyColours& c, double share) { return mix(mix(k_paper, c.deep, 0.45), c.deep, share); }

BodyStyle pose_style(const Colour& colour) {
  return {colour.with_opacity(0.10), {colour.with_opacity(0.75), 1.0}, colour.with_opacity(0.75)};
}

const Pose& pose_at(const Show& show, std::size_t body, std::size_t sample) {
  return show.trajectory.bodies(sample)[body].pose;
}

// Poses that fall on one another are drawn once: many thin layers would make one thick one.
void draw_poses(Canvas& canvas, const Show& show) {
  if (show.interval == 0.0) return;
  for (const std::size_t body : show.bodies.moving()) {
    std::optional<Pose> drawn;
    for (int i = 0; i <= k_most_poses + 1; ++i) {
      const std::size_t sample = sample_at(show.trajectory, i * show.interval);
      if (sample >= show.last()) break;
      const Pose& pose = pose_at(show, body, sample);
      if (drawn && length(pose.position - drawn->position) * show.view.scale < 2.0 &&
          std::abs(pose.angle - drawn->angle) < 0.03) {
        continue;
      }
      drawn = pose;
      const double share = show.duration() > 0.0 ? show.trajectory.time[sample] / show.duration() : 0.0;
      show.bodies.draw(canvas, body, pose, pose_style(colour_at(show.bodies.colours(body), share)));
    }
  }
}

void draw_first_and_last(Canvas& canvas, const Show& show) {
  for (const std::size_t body : show.bodies.moving()) {
    if (show.last() > 0) show.bodies.draw(canvas, body, pose_at(show, body, 0), start_style(show.bodies.colours(body)));
  }
  for (const std::size_t body : show.bodies.moving()) {
    show.bodies.draw(canvas, body, pose_at(show, body, show.last()), end_style(show.bodies.colours(body)));
  }
}

// The moving bodies of the numbered impacts.
void draw_impact_poses(Canvas& canvas, const Show& show) {
  for (const Impulse& impact : show.impacts) {
    const Colour colour = colour_of(impact.mode);
    const std::size_t sample = sample_at(show.trajectory, start_of(impact, show));
    for (const int index : {impact.contact.body_a, impact.contact.body_b}) {
      const auto body = static_cast<std::size_t>(index);
      if (show.trajectory.scene.bodies[body].kind == BodyKind::fixed) continue;
      show.bodies.draw(canvas, body, pose_at(show, body, sample),
                       {colour.with_opacity(0.07), {colour.with_opacity(0.9), 1.5}, colour.with_opacity(0.6)});
    }
  }
}

void draw_paths(Canvas& canvas, const Show& show) {
  if (show.bodies.moving().size() > k_most_paths) return;
  for (const std::size_t body : show.bodies.moving()) {
    const Colour colour = show.bodies.moving().size() == 1 ? k_ink : show.bodies.colours(body).deep;
    draw_path(canvas, show.view, show.trajectory, body, 0, show.last(), {colour.with_opacity(0.7), 1.2, 1.0, 3.2});
  }
}

double arrow_length(const Show& show, const Impulse& impulse) {
  return show.largest > 0.0 ? show.arrow_room * impulse.size / show.largest : 0.0;
}

void draw_impacts(Canvas& canvas, const Show& show) {
  constexpr double k_strong_cones = 3.0;
  const double opacity = std::min(1.0, k_strong_cones / static_cast<double>(show.impacts.size()));
  for (const Impulse& impact : show.impacts) {
    draw_cone(canvas, show.view.to_pixel(impact.place), impact.normal, impact.friction,
              1.18 * arrow_length(show, impact), opacity);
  }
  for (const Impulse& impulse : show.arrows) {
    const Point contact = show.view.to_pixel(impulse.place);
    const Colour colour = colour_of(impulse.mode);
    const double length = arrow_length(show, impulse);
    draw_impulse(canvas, contact, impulse, {length, length < 12.0 ? 1.3 : 2.4, colour});
    if (length >= 12.0) canvas.draw_disc(contact, 2.6, colour);
  }
}

// A number stands behind the surface that was hit, moved aside where another one has the place.
void draw_numbers(Canvas& canvas, const Show& show) {
  constexpr double k_radius = 9.0;
  constexpr double k_pitch = 2.0 * k_radius + 3.0;
  constexpr double k_distance = 24.0;
  const Area& area = show.view.area;
  std::vector<Point> taken;
  for (std::size_t i = 0; i < show.impacts.size(); ++i) {
    const Impulse& impact = show.impacts[i];
    const Point contact = show.view.to_pixel(impact.place);
    const Vector2 n = impact.normal, t = turned_right(n);
    Point centre{};
    for (int tries = 0; tries < 2 * static_cast<int>(k_most_impacts); ++tries) {  // 0, 1, -1, 2, -2, ... places aside
      const double aside = k_pitch * ((tries + 1) / 2) * (tries % 2 == 0 ? -1.0 : 1.0);
      centre = {contact.x - k_distance * n.x + aside * t.x, contact.y + k_distance * n.y - aside * t.y};
      centre.x = std::clamp(centre.x, area.left + k_radius, area.right() - k_radius - 1.0);
      centre.y = std::clamp(centre.y, area.top + k_radius, area.bottom() - k_radius - 1.0);
      const bool is_free = std::none_of(taken.begin(), taken.end(), [&](Point other) {
        return std::hypot(other.x - centre.x, other.y - centre.y) < k_pitch - 1.0;
      });
      if (is_free) break;
    }
    taken.push_back(centre);
    const Colour colour = colour_of(impact.mode);
    canvas.draw_disc(centre, k_radius, k_paper);
    canvas.draw_circle(centre, k_radius, {colour, 1.4});
    canvas.draw_text({centre.x, centre.y + 4.1}, tumble::format("{}", i + 1), {11.5, colour, Align::centre, true});
  }
}

void draw_plot(Canvas& canvas, const Show& show) {
  draw_axes(canvas, show.view, 12.0);
  canvas.clip(show.view.area);
  show.bodies.draw_fixed(canvas);
  draw_poses(canvas, show);
  draw_impact_poses(canvas, show);
  draw_first_and_last(canvas, show);
  show.bodies.draw_conveyors(canvas, show.trajectory.bodies(show.last()), 0.0);
  draw_paths(canvas, show);
  draw_impacts(canvas, show);
  draw_numbers(canvas, show);
  canvas.unclip();
}

// ---- The words beside it ----

class Panel {
 public:
  Panel(Canvas& canvas, const Area& area) : canvas_(canvas), area_(area), y_(area.top) {}

  bool has_room(double height) const { return y_ + height <= area_.bottom(); }

  void heading(std::string_view text) {
    y_ += 14.0;
    canvas_.draw_text({area_.left, y_}, text, {k_text, k_ink, Align::left, true});
    y_ += 9.0;
  }

  // Middle of a new line of the height; what stands left of `text` is drawn by the caller around it.
  Point line(double height, std::string_view text) {
    const Point middle{area_.left + 18.0, y_ + 0.5 * height};
    canvas_.draw_text({area_.left + 46.0, middle.y + 0.36 * k_text}, text, {k_text, k_muted});
    y_ += height;
    return middle;
  }

  // Cells at the given distances from the left edge; those behind the first one are numbers, aligned to the
  // right.
  void cells(const std::vector<std::pair<double, std::string>>& texts, const Colour& colour, Align align) {
    y_ += 17.5;
    for (const auto& [x, text] : texts) canvas_.draw_text({area_.left + x, y_}, text, {k_text - 0.5, colour, align});
  }

  double baseline() const { return y_; }
  double left() const { return area_.left; }
  void skip(double height) { y_ += height; }

 private:
  Canvas& canvas_;
  Area area_;
  double y_;
};

void draw_sample(Canvas& canvas, Point middle, const BodyStyle& style) {
  constexpr double h = 8.0;
  canvas.draw_polygon({{middle.x - h, middle.y - h},
                       {middle.x + h, middle.y - h},
                       {middle.x + h, middle.y + h},
                       {middle.x - h, middle.y + h}},
                      style.fill, style.outline);
  canvas.draw_disc({middle.x - 0.56 * h, middle.y + 0.56 * h}, 1.7, style.mark);
}

void draw_pose_legend(Canvas& canvas, Panel& panel, const Show& show) {
  const BodyColours colours =
      show.bodies.moving().empty() ? BodyColours{k_grid, k_ground} : show.bodies.colours(show.bodies.moving()[0]);
  panel.heading("Poses");
  if (show.last() == 0) {
    draw_sample(canvas, panel.line(24.0, "start, t = 0: the only one"), end_style(colours));
    panel.skip(8.0);
    return;
  }
  draw_sample(canvas, panel.line(24.0, "start, t = 0"), start_style(colours));
  if (show.interval > 0.0) {
    draw_sample(canvas, panel.line(24.0, tumble::format("every {:.6g} s, later is darker", show.interval)),
                pose_style(colour_at(colours, 0.4)));
  }
  draw_sample(canvas, panel.line(24.0, tumble::format("end, t = {:.6g} s", show.duration())), end_style(colours));
  panel.skip(8.0);
}

// The friction of all numbered impacts, if it is one for all.
std::optional<double> only_friction(const Show& show) {
  if (show.impacts.empty()) return std::nullopt;
  const double friction = show.impacts[0].friction;
  const bool is_only = std::all_of(show.impacts.begin(), show.impacts.end(),
                                   [&](const Impulse& impact) { return impact.friction == friction; });
  return is_only ? std::optional(friction) : std::nullopt;
}

void draw_impulse_legend(Canvas& canvas, Panel& panel, const Show& show) {
  panel.heading(show.bodies.is_crowd() ? "Contact impulse in the last step" : "Contact impulse");
  if (show.arrows.empty()) {
    panel.cells({{0.0, show.bodies.is_crowd() ? "none" : "none in this run"}}, k_muted, Align::left);
    return;
  }
  Impulse sample;
  sample.normal = {-1.0, 0.0};  // its tangent points up, the sample itself to the right
  sample.size = round_down_nicely(0.45 * show.largest);
  sample.along_normal = -sample.size;
  const double length = arrow_length(show, sample);
  panel.skip(6.0);
  const double y = panel.baseline() + 8.0;
  draw_impulse(canvas, {panel.left(), y}, sample, {length, 2.4, k_ink});
  canvas.draw_text({panel.left() + length + 8.0, y + 0.36 * k_text}, tumble::format("{:.6g} N s", sample.size),
                   {k_text, k_muted});
  panel.skip(22.0);
  for (const ContactMode mode : {ContactMode::stick, ContactMode::slip_left, ContactMode::slip_right}) {
    const Point middle = panel.line(19.0, to_string(mode));
    canvas.draw_line({middle.x - 12.0, middle.y}, {middle.x + 12.0, middle.y}, {colour_of(mode), 3.0});
  }
  if (const std::optional<double> friction = only_friction(show)) {
    const Point cone = panel.line(24.0, tumble::format("friction cone, μ = {:.6g}", *friction));
    draw_cone(canvas, {cone.x, cone.y + 9.0}, {0.0, 1.0}, *friction, 18.0, 1.0);
  }
  panel.skip(8.0);
}

void draw_impact_table(Canvas& canvas, Panel& panel, const Show& show) {
  constexpr double k_row = 17.5;
  if (show.impacts.empty() || !panel.has_room(14.0 + 9.0 + 2.0 * k_row)) return;
  const double duration = show.duration();
  const auto time_text = [&](double t) {
    return duration < 1e-2 || duration >= 1e4 ? tumble::format("{:.4g}", t)
                                              : tumble::format("{:.{}f}", t, decimals_for(duration, 2));
  };
  panel.heading("Contacts");
  const std::string counted = show.impacts.size() == 1 ? "" : tumble::format("{} ", show.impacts.size());
  if (show.impacts.size() < show.touches.size()) {
    panel.cells({{0.0, tumble::format("the {}largest of {}", counted, show.touches.size())}}, k_muted, Align::left);
  }
  panel.cells({{74.0, "t [s]"}, {168.0, "impulse [N s]"}}, k_muted, Align::right);
  for (std::size_t i = 0; i < show.impacts.size() && panel.has_room(k_row); ++i) {
    const Impulse& impact = show.impacts[i];
    panel.cells({{74.0, time_text(start_of(impact, show))}, {168.0, tumble::format("{:#.3g}", impact.size)}}, k_ink,
                Align::right);
    const Colour colour = colour_of(impact.mode);
    const double baseline = panel.baseline();
    canvas.draw_text({panel.left(), baseline}, tumble::format("{}", i + 1), {k_text - 0.5, colour, Align::left, true});
    canvas.draw_text({panel.left() + 180.0, baseline}, to_string(impact.mode), {k_text - 0.5, colour});
  }
}

// How it starts, or, of several bodies, nothing.
std::string start_text(const Show& show) {
  if (show.bodies.moving().size() != 1) return "";
  const auto& [pose, v] = show.trajectory.bodies(0)[show.bodies.moving()[0]];
  return tumble::format(
      "start: x = {:.4g} m, y = {:.4g} m, θ = {:.4g} rad,  vx = {:.4g} m/s, vy = {:.4g} m/s, ω = {:.4g} rad/s",
      pose.position.x, pose.position.y, pose.angle, v[0], v[1], v[2]);
}

void draw_title(Canvas& canvas, const Show& show) {
  const double width = show.view.area.width + k_gap + k_panel;
  draw_text_within(canvas, width, {k_left, 34.0}, title_of(show.trajectory), {19.0, k_ink, Align::left, true});
  draw_text_within(canvas, width, {k_left, 57.0}, facts_text(show.trajectory), {k_text, k_muted});
  draw_text_within(canvas, width, {k_left, 76.0}, start_text(show), {k_text, k_muted});
}

void draw_strobe(Canvas& canvas, const Trajectory& trajectory, const Sight& sight, double scale) {
  const double width = canvas.width() / scale;
  const double height = canvas.height() / scale;
  const Area area{k_left, k_top, std::max(10.0, width - k_left - k_gap - k_panel - k_right),
                  std::max(10.0, height - k_top - k_bottom)};
  const Show show(trajectory, fit_view(sight, area, k_margins));
  canvas.fill(k_paper);
  draw_title(canvas, show);
  draw_plot(canvas, show);
  Panel panel(canvas, {area.right() + k_gap, k_top - 14.0, k_panel, height - k_top});
  draw_pose_legend(canvas, panel, show);
  draw_impulse_legend(canvas, panel, show);
  draw_impact_table(canvas, panel, show);
}

}  // namespace

std::string to_strobe_png(const Trajectory& trajectory, int width, int height) {
  const Sight sight = sight_of(trajectory);
  const Sizes sizes = choose_sizes(sight, width, height, k_png_scale);
  Canvas canvas = Canvas::image(sizes.width, sizes.height, sizes.scale);
  draw_strobe(canvas, trajectory, sight, sizes.scale);
  return canvas.to_png();
}

std::string to_strobe_svg(const Trajectory& trajectory, int width, int height) {
  const Sight sight = sight_of(trajectory);
  const Sizes sizes = choose_sizes(sight, width, height, 1.0);
  Canvas canvas = Canvas::svg(sizes.width, sizes.height, sizes.scale);
  draw_strobe(canvas, trajectory, sight, sizes.scale);
  return canvas.to_svg();
}

}  // namespace tumble::output
