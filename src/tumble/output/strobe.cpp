#include "tumble/output/strobe.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "tumble/output/draw.hpp"
#include "tumble/output/record_fields.hpp"

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

constexpr int k_most_poses = 30;
constexpr std::size_t k_most_impacts = 8;   // with a number and a line in the table
constexpr double k_smallest_impact = 0.08;  // of the largest impulse
constexpr std::size_t k_most_arrows = 60;
constexpr double k_smallest_arrow = 0.02;
constexpr double k_longest_arrow = 110.0;
constexpr double k_text = 12.5;

struct Sizes {
  int width;     // [px]
  int height;    // [px]
  double scale;  // [px] per unit of the design
};

Sizes choose_sizes(const Box& box, int width, int height, double default_scale) {
  double plot_height = k_default_plot_height;
  double plot_width =
      (plot_height - k_margins.top - k_margins.bottom) * (box.x_high - box.x_low) / (box.y_high - box.y_low) +
      2.0 * k_margins.side;
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

struct Scene {
  const drop::Record& record;
  View view;
  double interval;  // between poses [s]
  double largest;   // impulse [N s]
  std::vector<Impulse> arrows;
  std::vector<Impulse> impacts;  // those with a number
};

double choose_interval(const drop::Record& record) {
  const double duration = (record.trajectory.columns - 1) * record.parameters.dt;
  if (!(duration > 0.0 && std::isfinite(duration))) return record.parameters.dt;
  return std::max(round_up_nicely(duration / k_most_poses), record.parameters.dt);
}

Scene make_scene(const drop::Record& record, const View& view) {
  const std::vector<Impulse> impulses = contact_impulses(record);
  const double largest = largest_size(impulses);
  return {record,
          view,
          choose_interval(record),
          largest,
          keep_largest(impulses, k_most_arrows, k_smallest_arrow * largest),
          keep_largest(impulses, k_most_impacts, k_smallest_impact * largest)};
}

// ---- The plot ----

constexpr SquareStyle k_start_style = {k_paper.with_opacity(0.6), {k_body, 1.4, 5.0, 3.5}, k_body};
constexpr SquareStyle k_end_style = {{0.62, 0.73, 0.85}, {k_body, 1.9}, k_body};

Colour colour_at(double share) { return mix(k_body_early, k_body, share); }

void draw_pose(Canvas& canvas, const Scene& scene, int column, const SquareStyle& style) {
  draw_square(canvas, scene.view, scene.record.trajectory.q_at(column), scene.record.parameters, style);
}

// Poses that fall on one another are drawn once: many thin layers would make one thick one.
void draw_poses(Canvas& canvas, const Scene& scene) {
  const int last = scene.record.trajectory.columns - 1;
  std::optional<Vector3> drawn;
  for (int i = 0; i <= k_most_poses + 1; ++i) {
    const double column = std::round(i * scene.interval / scene.record.parameters.dt);
    if (column >= last) break;
    const Vector3 q = scene.record.trajectory.q_at(static_cast<int>(column));
    if (drawn && std::hypot(q[0] - (*drawn)[0], q[1] - (*drawn)[1]) * scene.view.scale < 2.0 &&
        std::abs(q[2] - (*drawn)[2]) < 0.03) {
      continue;
    }
    drawn = q;
    const Colour colour = colour_at(last > 0 ? column / last : 0.0);
    draw_pose(canvas, scene, static_cast<int>(column),
              {colour.with_opacity(0.10), {colour.with_opacity(0.75), 1.0}, colour.with_opacity(0.75)});
  }
}

void draw_first_and_last(Canvas& canvas, const Scene& scene) {
  const int last = scene.record.trajectory.columns - 1;
  if (last > 0) draw_pose(canvas, scene, 0, k_start_style);
  draw_pose(canvas, scene, last, k_end_style);
}

double arrow_length(const Scene& scene, const Impulse& impulse) {
  const double room = std::min(k_longest_arrow, 0.3 * scene.view.frame.height);
  return scene.largest > 0.0 ? room * impulse.size / scene.largest : 0.0;
}

void draw_impacts(Canvas& canvas, const Scene& scene) {
  const drop::Record& record = scene.record;
  for (const Impulse& impact : scene.impacts) {
    draw_cone(canvas, contact_pixel(scene.view, record, impact.column), record.parameters.mu,
              1.18 * arrow_length(scene, impact), 1.0);
  }
  for (const Impulse& impulse : scene.arrows) {
    const Point contact = contact_pixel(scene.view, record, impulse.column);
    const Colour colour = colour_of(impulse.mode);
    const double length = arrow_length(scene, impulse);
    draw_impulse(canvas, contact, impulse, {length, length < 12.0 ? 1.3 : 2.4, colour});
    if (length >= 12.0) canvas.draw_disc(contact, 2.6, colour);
  }
}

// The numbers stand in a row under the ground, moved aside where two impacts are too close for both.
void draw_numbers(Canvas& canvas, const Scene& scene) {
  constexpr double k_radius = 9.0;
  constexpr double k_pitch = 2.0 * k_radius + 3.0;
  std::vector<std::pair<double, std::size_t>> places;
  double lowest = scene.view.has_ground ? scene.view.to_pixel(0.0, 0.0).y : scene.view.frame.top;
  for (std::size_t i = 0; i < scene.impacts.size(); ++i) {
    const Point contact = contact_pixel(scene.view, scene.record, scene.impacts[i].column);
    places.emplace_back(contact.x, i);
    lowest = std::max(lowest, contact.y);
  }
  std::sort(places.begin(), places.end());
  double least = scene.view.frame.left + k_radius;
  for (auto& [x, i] : places) {
    x = std::max(x, least);
    least = x + k_pitch;
  }
  double most = scene.view.frame.right() - k_radius - 1.0;
  for (auto place = places.rbegin(); place != places.rend(); ++place) {
    place->first = std::min(place->first, most);
    most = place->first - k_pitch;
  }
  for (const auto& [x, i] : places) {
    const Point centre{x, lowest + 24.0};
    const Colour colour = colour_of(scene.impacts[i].mode);
    canvas.draw_disc(centre, k_radius, k_paper);
    canvas.draw_circle(centre, k_radius, {colour, 1.4});
    canvas.draw_text({centre.x, centre.y + 4.1}, fmt::format("{}", i + 1), {11.5, colour, Align::centre, true});
  }
}

void draw_plot(Canvas& canvas, const Scene& scene) {
  const drop::Record& record = scene.record;
  draw_surroundings(canvas, scene.view, 12.0);
  canvas.clip(scene.view.frame);
  draw_poses(canvas, scene);
  const int last = record.trajectory.columns - 1;
  for (const Impulse& impact : scene.impacts) {
    const Colour colour = colour_of(impact.mode);
    draw_pose(canvas, scene, impact.column,
              {colour.with_opacity(0.07), {colour.with_opacity(0.9), 1.5}, colour.with_opacity(0.6)});
  }
  draw_first_and_last(canvas, scene);
  draw_path(canvas, scene.view, record, 0, last, {k_ink.with_opacity(0.7), 1.2, 1.0, 3.2});
  draw_impacts(canvas, scene);
  draw_numbers(canvas, scene);
  canvas.unclip();
}

// ---- The words beside it ----

class Panel {
 public:
  Panel(Canvas& canvas, const Frame& frame) : canvas_(canvas), frame_(frame), y_(frame.top) {}

  bool has_room(double height) const { return y_ + height <= frame_.bottom(); }

  void heading(std::string_view text) {
    y_ += 14.0;
    canvas_.draw_text({frame_.left, y_}, text, {k_text, k_ink, Align::left, true});
    y_ += 9.0;
  }

  // Middle of a new line of the height; what stands left of `text` is drawn by the caller around it.
  Point line(double height, std::string_view text) {
    const Point middle{frame_.left + 18.0, y_ + 0.5 * height};
    canvas_.draw_text({frame_.left + 46.0, middle.y + 0.36 * k_text}, text, {k_text, k_muted});
    y_ += height;
    return middle;
  }

  // Cells at the given distances from the left edge; those behind the first one are numbers, aligned to the
  // right.
  void cells(const std::vector<std::pair<double, std::string>>& texts, const Colour& colour, Align align) {
    y_ += 17.5;
    for (const auto& [x, text] : texts) canvas_.draw_text({frame_.left + x, y_}, text, {k_text - 0.5, colour, align});
  }

  double baseline() const { return y_; }
  double left() const { return frame_.left; }
  void skip(double height) { y_ += height; }

 private:
  Canvas& canvas_;
  Frame frame_;
  double y_;
};

void draw_square_sample(Canvas& canvas, Point middle, const SquareStyle& style) {
  constexpr double h = 8.0;
  canvas.draw_polygon({{middle.x - h, middle.y - h},
                       {middle.x + h, middle.y - h},
                       {middle.x + h, middle.y + h},
                       {middle.x - h, middle.y + h}},
                      style.fill, style.outline);
  canvas.draw_disc({middle.x - 0.56 * h, middle.y + 0.56 * h}, 1.7, style.mark);
}

void draw_pose_legend(Canvas& canvas, Panel& panel, const Scene& scene) {
  const double duration = (scene.record.trajectory.columns - 1) * scene.record.parameters.dt;
  panel.heading("Poses");
  const Colour pose = colour_at(0.4);
  if (scene.record.trajectory.columns == 1) {
    draw_square_sample(canvas, panel.line(24.0, "start, t = 0: the only column"), k_end_style);
    panel.skip(8.0);
    return;
  }
  draw_square_sample(canvas, panel.line(24.0, "start, t = 0"), k_start_style);
  draw_square_sample(canvas, panel.line(24.0, fmt::format("every {:.6g} s, later is darker", scene.interval)),
                     {pose.with_opacity(0.10), {pose, 1.0}, pose});
  draw_square_sample(canvas, panel.line(24.0, fmt::format("end, t = {:.6g} s", duration)), k_end_style);
  panel.skip(8.0);
}

void draw_impulse_legend(Canvas& canvas, Panel& panel, const Scene& scene) {
  panel.heading("Contact impulse");
  if (scene.arrows.empty()) {
    panel.cells({{0.0, "no contact in this run"}}, k_muted, Align::left);
    return;
  }
  const Impulse sample{0, 0.0, round_down_nicely(0.45 * scene.largest), round_down_nicely(0.45 * scene.largest),
                       ContactMode::open};
  const double length = arrow_length(scene, sample);
  panel.skip(6.0);
  const double y = panel.baseline() + 8.0;
  draw_impulse(canvas, {panel.left(), y}, sample, {length, 2.4, k_ink});
  canvas.draw_text({panel.left() + length + 8.0, y + 0.36 * k_text}, fmt::format("{:.6g} N s", sample.size),
                   {k_text, k_muted});
  panel.skip(22.0);
  for (const ContactMode mode : {ContactMode::stick, ContactMode::slip_left, ContactMode::slip_right}) {
    const Point middle = panel.line(19.0, to_string(mode));
    canvas.draw_line({middle.x - 12.0, middle.y}, {middle.x + 12.0, middle.y}, {colour_of(mode), 3.0});
  }
  const Point cone = panel.line(24.0, fmt::format("friction cone, μ = {:.6g}", scene.record.parameters.mu));
  draw_cone(canvas, {cone.x, cone.y + 9.0}, scene.record.parameters.mu, 18.0, 1.0);
  panel.skip(8.0);
}

void draw_impact_table(Canvas& canvas, Panel& panel, const Scene& scene) {
  constexpr double k_row = 17.5;
  if (scene.impacts.empty() || !panel.has_room(14.0 + 9.0 + 2.0 * k_row)) return;
  const std::size_t all = contact_impulses(scene.record).size();
  const double dt = scene.record.parameters.dt;
  const double duration = (scene.record.trajectory.columns - 1) * dt;
  const auto time_text = [&](double t) {
    return duration < 1e-2 || duration >= 1e4 ? fmt::format("{:.4g}", t)
                                              : fmt::format("{:.{}f}", t, decimals_for(duration, 2));
  };
  panel.heading("Impacts");
  if (scene.impacts.size() < all) {
    panel.cells({{0.0, fmt::format("the {} largest of {} contact steps", scene.impacts.size(), all)}}, k_muted,
                Align::left);
  }
  panel.cells({{74.0, "t [s]"}, {168.0, "impulse [N s]"}}, k_muted, Align::right);
  for (std::size_t i = 0; i < scene.impacts.size() && panel.has_room(k_row); ++i) {
    const Impulse& impact = scene.impacts[i];
    panel.cells({{74.0, time_text(impact.column * dt)}, {168.0, fmt::format("{:#.3g}", impact.size)}}, k_ink,
                Align::right);
    const Colour colour = colour_of(impact.mode);
    const double baseline = panel.baseline();
    canvas.draw_text({panel.left(), baseline}, fmt::format("{}", i + 1), {k_text - 0.5, colour, Align::left, true});
    canvas.draw_text({panel.left() + 180.0, baseline}, to_string(impact.mode), {k_text - 0.5, colour});
  }
}

void draw_title(Canvas& canvas, const Scene& scene) {
  const drop::Record& record = scene.record;
  const Vector3 q = record.trajectory.q_at(0);
  const Vector3 v = record.trajectory.v_at(0);
  canvas.draw_text({k_left, 34.0}, "Drop of a square", {19.0, k_ink, Align::left, true});
  const double width = scene.view.frame.width + k_gap + k_panel;
  draw_text_within(canvas, width, {k_left, 57.0}, parameters_text(record.parameters), {k_text, k_muted});
  draw_text_within(canvas, width, {k_left, 76.0},
                   fmt::format("start: x = {:.4g} m, y = {:.4g} m, θ = {:.4g} rad,  vx = {:.4g} m/s, vy = "
                               "{:.4g} m/s, ω = {:.4g} rad/s",
                               q[0], q[1], q[2], v[0], v[1], v[2]),
                   {k_text, k_muted});
}

void draw_strobe(Canvas& canvas, const drop::Record& record, const Box& box, double scale) {
  const double width = canvas.width() / scale;
  const double height = canvas.height() / scale;
  const Frame frame{k_left, k_top, std::max(10.0, width - k_left - k_gap - k_panel - k_right),
                    std::max(10.0, height - k_top - k_bottom)};
  const Scene scene = make_scene(record, fit_view(box, record.parameters.l, frame, k_margins));
  canvas.fill(k_paper);
  draw_title(canvas, scene);
  draw_plot(canvas, scene);
  Panel panel(canvas, {frame.right() + k_gap, k_top - 14.0, k_panel, height - k_top});
  draw_pose_legend(canvas, panel, scene);
  draw_impulse_legend(canvas, panel, scene);
  draw_impact_table(canvas, panel, scene);
}

}  // namespace

std::string to_strobe_png(const drop::Record& record, int width, int height) {
  check_record(record);
  const Box box = box_of(record);
  const Sizes sizes = choose_sizes(box, width, height, k_png_scale);
  Canvas canvas = Canvas::image(sizes.width, sizes.height, sizes.scale);
  draw_strobe(canvas, record, box, sizes.scale);
  return canvas.to_png();
}

std::string to_strobe_svg(const drop::Record& record, int width, int height) {
  check_record(record);
  const Box box = box_of(record);
  const Sizes sizes = choose_sizes(box, width, height, 1.0);
  Canvas canvas = Canvas::svg(sizes.width, sizes.height, sizes.scale);
  draw_strobe(canvas, record, box, sizes.scale);
  return canvas.to_svg();
}

}  // namespace tumble::output
