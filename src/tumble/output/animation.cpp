#include "tumble/output/animation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "tumble/output/draw.hpp"
#include "tumble/output/record_fields.hpp"

namespace tumble::output {
namespace {

// Lengths are in units of the design, see Canvas.
constexpr double k_design_width = 640.0;
constexpr double k_design_height = 400.0;
constexpr double k_left = 46.0;
constexpr double k_top = 46.0;
constexpr double k_bottom = 40.0;
constexpr double k_panel = 142.0;
constexpr double k_gap = 18.0;
constexpr double k_right = 14.0;
constexpr Margins k_margins = {12.0, 12.0, 20.0};
constexpr double k_longest_arrow = 76.0;
constexpr double k_text = 10.5;

constexpr double k_fade_time = 0.3;           // of an impulse [s of the film]
constexpr std::size_t k_most_new_arrows = 3;  // per picture; a fine dt has thousands of contact steps in one
constexpr double k_smallest_arrow = 0.02;     // of the largest impulse

// What stands for the square in all pictures.
constexpr SquareStyle k_square = {{0.62, 0.73, 0.85}, {k_body, 1.6}, k_body};

std::string energy_text(double value, double largest) {
  if (!(std::abs(largest) < 1e6) || largest < 1e-4) return fmt::format("{:.2e} J", value);
  return fmt::format("{:.{}f} J", value, decimals_for(largest, 0));
}

struct Energies {
  double kinetic;
  double potential;
};

Energies energies_at(const drop::Record& record, int column) {
  return {kinetic_at(record, column), potential_at(record, column)};
}

// The largest magnitude of the sum, the scale of the bars [J].
double largest_energy(const drop::Record& record) {
  double largest = 0.0;
  for (int k = 0; k < record.trajectory.columns; ++k) {
    const auto [kinetic, potential] = energies_at(record, k);
    if (std::isfinite(kinetic + potential)) largest = std::max({largest, kinetic, std::abs(potential)});
  }
  return largest;
}

struct ShownImpulse {
  Impulse impulse;
  int frame;  // when it appeared
};

}  // namespace

struct Animation::Parts {
  Parts(const drop::Record& the_record, int width, int height, double the_speed, int max_frames);

  int column_of(int frame) const;
  void draw_background();
  void draw_impulse_legend(double left, double top);
  void draw_motion(int frame, int column);
  void draw_arrows(int frame);
  void draw_panel(int column);
  void extend_path(int column);
  void collect_impulses(int frame, int column);
  double arrow_length(const Impulse& impulse) const;

  const drop::Record& record;
  double speed;
  int frames;
  double scale;
  Canvas background;
  Canvas canvas;
  View view;
  Frame panel;
  std::vector<Impulse> impulses;
  double largest;         // impulse [N s]
  double largest_joules;  // [J]
  int time_decimals;

  std::size_t next_impulse = 0;  // the first one after the column drawn last
  int path_column = 0;           // the path is in the background up to here
  std::vector<ShownImpulse> shown;
};

int count_frames(double motion, double speed, int max_frames) {
  if (!(speed > 0.0 && std::isfinite(speed))) {
    throw std::invalid_argument(fmt::format("speed: must be finite and > 0, got {}", speed));
  }
  const double duration = motion / speed;
  // At least the first and the last state are shown, however short the run is.
  const double frames = motion > 0.0 ? std::max(std::ceil(duration / k_frame_time - 1e-6), 1.0) + 1.0 : 1.0;
  if (frames > max_frames) {
    throw std::invalid_argument(
        fmt::format("animation: at most {} s of film are made, this run needs {:.6g} s; show it faster or "
                    "less of it",
                    max_frames * k_frame_time, duration));
  }
  return static_cast<int>(frames);
}

Animation::Parts::Parts(const drop::Record& the_record, int width, int height, double the_speed, int max_frames)
    : record(the_record),
      speed(the_speed),
      frames(count_frames((record.trajectory.columns - 1) * record.parameters.dt, speed, max_frames)),
      scale(std::min(width / k_design_width, height / k_design_height)),
      background(Canvas::image(width, height, scale)),
      canvas(Canvas::image(width, height, scale)) {
  const double design_width = width / scale;
  const Frame frame{k_left, k_top, design_width - k_left - k_gap - k_panel - k_right,
                    height / scale - k_top - k_bottom};
  panel = {frame.right() + k_gap, k_top, k_panel, frame.height};
  view = fit_view(box_of(record), record.parameters.l, frame, k_margins);
  impulses = contact_impulses(record);
  largest = largest_size(impulses);
  largest_joules = largest_energy(record);
  time_decimals = decimals_for((record.trajectory.columns - 1) * record.parameters.dt, 2);
  draw_background();
}

int Animation::Parts::column_of(int frame) const {
  const double column = std::round(frame * k_frame_time * speed / record.parameters.dt);
  const int last = record.trajectory.columns - 1;
  return frame == frames - 1 || column >= last ? last : static_cast<int>(column);
}

double Animation::Parts::arrow_length(const Impulse& impulse) const {
  const double room = std::min(k_longest_arrow, 0.3 * view.frame.height);
  return largest > 0.0 ? room * impulse.size / largest : 0.0;
}

void Animation::Parts::draw_background() {
  background.fill(k_paper);
  std::string title = parameters_text(record.parameters);
  if (speed != 1.0) title += fmt::format(",  {:.4g} × real time", speed);
  draw_text_within(background, panel.right() - k_left, {k_left, 18.0}, title, {k_text, k_muted});
  draw_surroundings(background, view, 10.0);
  draw_impulse_legend(panel.left, panel.top + 168.0);
}

void Animation::Parts::draw_impulse_legend(double left, double top) {
  background.draw_text({left, top}, "Contact impulse", {k_text, k_ink, Align::left, true});
  if (impulses.empty()) {
    background.draw_text({left, top + 16.0}, "none in this run", {k_text, k_muted});
    return;
  }
  const double nice = round_down_nicely(0.7 * largest);
  const Impulse sample{0, 0.0, nice, nice, ContactMode::open};
  const double length = arrow_length(sample);
  draw_impulse(background, {left, top + 15.0}, sample, {length, 2.2, k_ink});
  background.draw_text({left + length + 7.0, top + 15.0 + 0.36 * k_text}, fmt::format("{:.6g} N s", nice),
                       {k_text, k_muted});
  double y = top + 34.0;
  for (const ContactMode mode : {ContactMode::stick, ContactMode::slip_left, ContactMode::slip_right}) {
    background.draw_line({left + 1.5, y}, {left + 20.0, y}, {colour_of(mode), 3.0});
    background.draw_text({left + 29.0, y + 0.36 * k_text}, to_string(mode), {k_text, k_muted});
    y += 16.0;
  }
}

// The path only grows: what is new of it is added to the background, so that a long run costs no more per
// picture.
void Animation::Parts::extend_path(int column) {
  background.clip(view.frame);
  draw_path(background, view, record, path_column, column, {mix(k_paper, k_body, 0.5), 1.1});
  background.unclip();
  path_column = column;
}

void Animation::Parts::collect_impulses(int frame, int column) {
  std::vector<Impulse> fresh;
  while (next_impulse < impulses.size() && impulses[next_impulse].column <= column)
    fresh.push_back(impulses[next_impulse++]);
  for (const Impulse& impulse : keep_largest(std::move(fresh), k_most_new_arrows, k_smallest_arrow * largest)) {
    shown.push_back({impulse, frame});
  }
  std::erase_if(shown, [&](const ShownImpulse& old) { return (frame - old.frame) * k_frame_time >= k_fade_time; });
}

void Animation::Parts::draw_arrows(int frame) {
  for (const auto& [impulse, since] : shown) {
    const double opacity = 1.0 - (frame - since) * k_frame_time / k_fade_time;
    const Point contact = contact_pixel(view, record, impulse.column);
    const double length = arrow_length(impulse);
    if (length >= 6.0) draw_cone(canvas, contact, record.parameters.mu, 1.15 * length, opacity);
    // Mixed with the paper instead of see-through: a .gif has few colours.
    const Colour colour = mix(k_paper, colour_of(impulse.mode), opacity);
    draw_impulse(canvas, contact, impulse, {length, length < 10.0 ? 1.4 : 2.2, colour});
    canvas.draw_disc(contact, 2.6, colour);
  }
}

void Animation::Parts::draw_motion(int frame, int column) {
  canvas.clip(view.frame);
  draw_square(canvas, view, record.trajectory.q_at(column), record.parameters, k_square);
  draw_arrows(frame);
  canvas.unclip();
}

void Animation::Parts::draw_panel(int column) {
  const double left = panel.left;
  canvas.draw_text({left, panel.top + 14.0}, fmt::format("t = {:.{}f} s", column * record.parameters.dt, time_decimals),
                   {17.0, k_ink, Align::left, true});
  canvas.draw_text({left, panel.top + 44.0}, "Energy", {k_text, k_ink, Align::left, true});
  const auto [kinetic, potential] = energies_at(record, column);
  double y = panel.top + 62.0;
  const auto draw_row = [&](std::string_view name, double value) {
    canvas.draw_text({left, y}, name, {k_text, k_muted});
    canvas.draw_text({left + k_panel, y}, energy_text(value, largest_joules), {k_text, k_ink, Align::right});
    const double share = largest_joules > 0.0 ? std::clamp(value / largest_joules, 0.0, 1.0) : 0.0;
    canvas.fill_rectangle({left, y + 5.0, k_panel, 3.0}, k_grid);
    if (share > 0.0) canvas.fill_rectangle({left, y + 5.0, k_panel * share, 3.0}, k_body);
    y += 27.0;
  };
  draw_row("kinetic", kinetic);
  draw_row("potential", potential);
  draw_row("sum", kinetic + potential);
}

Animation::Animation(const drop::Record& record, int width, int height, double speed, int max_frames) {
  check_record(record);
  parts_ = std::make_unique<Parts>(record, width, height, speed, max_frames);
}

Animation::~Animation() = default;

int Animation::frames() const { return parts_->frames; }

std::vector<std::uint32_t> Animation::draw(int i) {
  const int column = parts_->column_of(i);
  parts_->extend_path(column);
  parts_->canvas.copy_pixels(parts_->background);
  parts_->collect_impulses(i, column);
  parts_->draw_motion(i, column);
  parts_->draw_panel(column);
  return parts_->canvas.pixels();
}

}  // namespace tumble::output
