#include "tumble/output/animation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "tumble/math/format.hpp"
#include "tumble/output/draw.hpp"
#include "tumble/output/draw_bodies.hpp"

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

constexpr double k_fade_time = 0.3;            // of an impulse [s of the film]
constexpr std::size_t k_most_new_arrows = 40;  // per picture
constexpr int k_most_paths = 20;
constexpr double k_smallest_arrow = 0.02;  // of the largest impulse

std::string energy_text(double value, double largest) {
  if (!(std::abs(largest) < 1e6) || largest < 1e-4) return tumble::format("{:.2e} J", value);
  return tumble::format("{:.{}f} J", value, decimals_for(largest, 0));
}

// The lowest and the highest value that the bars show [J].
struct EnergyRange {
  double low = 0.0;
  double high = 0.0;

  double largest() const { return std::max(-low, high); }
  double share(double value) const { return high > low ? std::clamp((value - low) / (high - low), 0.0, 1.0) : 0.0; }
};

EnergyRange energy_range(const Trajectory& trajectory) {
  EnergyRange range;
  for (const EnergyLedger& energy : trajectory.energy) {
    if (!std::isfinite(energy.kinetic + energy.potential)) continue;
    range.low = std::min({range.low, energy.potential, energy.kinetic + energy.potential});
    range.high = std::max({range.high, energy.kinetic, energy.potential, energy.kinetic + energy.potential});
  }
  return range;
}

struct ShownImpulse {
  Impulse impulse;
  int frame;  // when it appeared
};

}  // namespace

struct Animation::Parts {
  Parts(const Trajectory& the_trajectory, int width, int height, double the_speed, int max_frames);

  std::size_t sample_of(int frame) const;
  void draw_background();
  void draw_impulse_legend(double left, double top);
  void draw_motion(int frame, std::size_t sample);
  void draw_arrows(int frame);
  void draw_panel(std::size_t sample);
  void extend_paths(std::size_t sample);
  void collect_impulses(int frame, std::size_t sample);
  void take(const Impulse& impulse, int frame);
  double arrow_length(const Impulse& impulse) const;

  const Trajectory& trajectory;
  double speed;
  int frames;
  double scale;
  Canvas background;
  Canvas canvas;
  View view;
  Area panel;
  std::optional<BodyDrawing> bodies;
  double arrow_room = 0.0;  // [px]
  double largest = 0.0;     // impulse [N s]
  EnergyRange energies;
  int time_decimals = 0;

  std::size_t next_step = 0;    // index into trajectory.contacts: the first one after the sample drawn last
  std::size_t path_sample = 0;  // the paths are in the background up to here
  double created = 0.0;         // energy from nothing up to path_sample [J]
  std::vector<ShownImpulse> shown;
};

int count_frames(double motion, double speed, int max_frames) {
  if (!(speed > 0.0 && std::isfinite(speed))) {
    throw std::invalid_argument(tumble::format("speed: must be finite and > 0, got {}", speed));
  }
  const double duration = motion / speed;
  // At least the first and the last state are shown, however short the run is.
  const double frames = motion > 0.0 ? std::max(std::ceil(duration / k_frame_time - 1e-6), 1.0) + 1.0 : 1.0;
  if (frames > max_frames) {
    throw std::invalid_argument(
        tumble::format("animation: at most {} s of film are made, this run needs {:.6g} s; show it faster or "
                       "less of it",
                       max_frames * k_frame_time, duration));
  }
  return static_cast<int>(frames);
}

Animation::Parts::Parts(const Trajectory& the_trajectory, int width, int height, double the_speed, int max_frames)
    : trajectory(the_trajectory),
      speed(the_speed),
      frames(count_frames(trajectory.time.empty() ? 0.0 : trajectory.time.back(), speed, max_frames)),
      scale(std::min(width / k_design_width, height / k_design_height)),
      background(Canvas::image(width, height, scale)),
      canvas(Canvas::image(width, height, scale)) {
  const double design_width = width / scale;
  const Area area{k_left, k_top, design_width - k_left - k_gap - k_panel - k_right, height / scale - k_top - k_bottom};
  panel = {area.right() + k_gap, k_top, k_panel, area.height};
  view = fit_view(sight_of(trajectory), area, k_margins);
  bodies.emplace(trajectory.scene, view);
  arrow_room = bodies->arrow_room(k_longest_arrow);
  for (const StepContacts& step : trajectory.contacts) {
    for (const ContactRecord& record : step.contacts) {
      largest = std::max(largest, impulse_of(record, trajectory.scene, step.step).size);
    }
  }
  energies = energy_range(trajectory);
  time_decimals = decimals_for(trajectory.time.back(), 2);
  draw_background();
}

std::size_t Animation::Parts::sample_of(int frame) const {
  return frame == frames - 1 ? trajectory.time.size() - 1 : sample_at(trajectory, frame * k_frame_time * speed);
}

double Animation::Parts::arrow_length(const Impulse& impulse) const {
  return largest > 0.0 ? arrow_room * impulse.size / largest : 0.0;
}

void Animation::Parts::draw_background() {
  background.fill(k_paper);
  std::string title = tumble::format("{}:  {}", title_of(trajectory), facts_text(trajectory));
  if (speed != 1.0) title += tumble::format(",  {:.4g} × real time", speed);
  draw_text_within(background, panel.right() - k_left, {k_left, 18.0}, title, {k_text, k_muted});
  draw_axes(background, view, 10.0);
  background.clip(view.area);
  bodies->draw_fixed(background);
  background.unclip();
  draw_impulse_legend(panel.left, panel.top + 168.0);
}

void Animation::Parts::draw_impulse_legend(double left, double top) {
  background.draw_text({left, top}, "Contact impulse", {k_text, k_ink, Align::left, true});
  if (largest == 0.0) {
    background.draw_text({left, top + 16.0}, "none in this run", {k_text, k_muted});
    return;
  }
  Impulse sample;
  sample.normal = {1.0, 0.0};
  sample.size = sample.along_normal = round_down_nicely(0.7 * largest);
  const double length = arrow_length(sample);
  draw_impulse(background, {left, top + 15.0}, sample, {length, 2.2, k_ink});
  background.draw_text({left + length + 7.0, top + 15.0 + 0.36 * k_text}, tumble::format("{:.6g} N s", sample.size),
                       {k_text, k_muted});
  double y = top + 34.0;
  for (const ContactMode mode : {ContactMode::stick, ContactMode::slip_left, ContactMode::slip_right}) {
    background.draw_line({left + 1.5, y}, {left + 20.0, y}, {colour_of(mode), 3.0});
    background.draw_text({left + 29.0, y + 0.36 * k_text}, to_string(mode), {k_text, k_muted});
    y += 16.0;
  }
}

// The paths only grow: what is new of them is added to the background, so that a long run costs no more per
// picture.
void Animation::Parts::extend_paths(std::size_t sample) {
  for (std::size_t k = path_sample + 1; k <= sample; ++k) created += trajectory.energy[k].created;
  if (bodies->moving().size() <= k_most_paths) {
    background.clip(view.area);
    for (const std::size_t body : bodies->moving()) {
      draw_path(background, view, trajectory, body, path_sample, sample,
                {mix(k_paper, bodies->colours(body).deep, 0.5), 1.1});
    }
    background.unclip();
  }
  path_sample = sample;
}

// One arrow for each contact: the newest, or the largest of one picture.
void Animation::Parts::take(const Impulse& impulse, int frame) {
  const auto old = std::find_if(shown.begin(), shown.end(), [&](const ShownImpulse& s) {
    return is_same_contact(s.impulse.contact, impulse.contact);
  });
  if (old == shown.end()) {
    shown.push_back({impulse, frame});
  } else {
    *old = {impulse, frame};
  }
}

void Animation::Parts::collect_impulses(int frame, std::size_t sample) {
  std::vector<Impulse> fresh;
  const double until = trajectory.time[sample] + 0.5 * trajectory.step_size;
  for (; next_step < trajectory.contacts.size(); ++next_step) {
    const StepContacts& step = trajectory.contacts[next_step];
    if (static_cast<double>(step.step) * trajectory.step_size > until) break;
    for (const ContactRecord& record : step.contacts) {
      fresh.push_back(impulse_of(record, trajectory.scene, step.step));
    }
  }
  const double smallest = std::max(k_smallest_arrow * largest, std::numeric_limits<double>::min());
  for (const Impulse& impulse : largest_of_each_contact(std::move(fresh), k_most_new_arrows, smallest)) {
    take(impulse, frame);
  }
  std::erase_if(shown, [&](const ShownImpulse& old) { return (frame - old.frame) * k_frame_time >= k_fade_time; });
}

void Animation::Parts::draw_arrows(int frame) {
  for (const auto& [impulse, since] : shown) {
    const double opacity = 1.0 - (frame - since) * k_frame_time / k_fade_time;
    const Point contact = view.to_pixel(impulse.place);
    const double length = arrow_length(impulse);
    if (length >= 6.0 && !bodies->is_crowd())
      draw_cone(canvas, contact, impulse.normal, impulse.friction, 1.15 * length, opacity);
    const Colour colour = colour_of(impulse.mode).with_opacity(opacity);
    draw_impulse(canvas, contact, impulse, {length, length < 10.0 ? 1.4 : 2.2, colour});
    if (!bodies->is_crowd()) canvas.draw_disc(contact, 2.6, colour);
  }
}

void Animation::Parts::draw_motion(int frame, std::size_t sample) {
  canvas.clip(view.area);
  const std::span<const BodyState> states = trajectory.bodies(sample);
  for (const std::size_t body : bodies->moving()) {
    bodies->draw(canvas, body, states[body].pose, solid_style(bodies->colours(body)));
  }
  bodies->draw_conveyors(canvas, states, trajectory.time[sample]);
  draw_arrows(frame);
  canvas.unclip();
}

void Animation::Parts::draw_panel(std::size_t sample) {
  const double left = panel.left;
  canvas.draw_text({left, panel.top + 14.0}, tumble::format("t = {:.{}f} s", trajectory.time[sample], time_decimals),
                   {17.0, k_ink, Align::left, true});
  canvas.draw_text({left, panel.top + 44.0}, "Energy", {k_text, k_ink, Align::left, true});
  const EnergyLedger& energy = trajectory.energy[sample];
  double y = panel.top + 62.0;
  const auto draw_row = [&](std::string_view name, double value, double low) {
    canvas.draw_text({left, y}, name, {k_text, k_muted});
    canvas.draw_text({left + k_panel, y}, energy_text(value, energies.largest()), {k_text, k_ink, Align::right});
    const double share = energies.share(value - low + energies.low);
    canvas.fill_rectangle({left, y + 5.0, k_panel, 3.0}, k_grid);
    if (share > 0.0) canvas.fill_rectangle({left, y + 5.0, k_panel * share, 3.0}, k_accent);
    y += 27.0;
  };
  draw_row("kinetic", energy.kinetic, 0.0);
  draw_row("potential", energy.potential, energies.low);
  draw_row("sum", energy.kinetic + energy.potential, energies.low);
  if (created > 0.0) {
    canvas.draw_text({left, y}, "from nothing", {k_text, k_slip_left});
    canvas.draw_text({left + k_panel, y}, energy_text(created, energies.largest()),
                     {k_text, k_slip_left, Align::right});
  }
}

Animation::Animation(const Trajectory& trajectory, int width, int height, double speed, int max_frames)
    : parts_(std::make_unique<Parts>(trajectory, width, height, speed, max_frames)) {}

Animation::~Animation() = default;

int Animation::frames() const { return parts_->frames; }

std::vector<std::uint32_t> Animation::draw(int i) {
  const std::size_t sample = parts_->sample_of(i);
  parts_->extend_paths(sample);
  parts_->canvas.copy_pixels(parts_->background);
  parts_->collect_impulses(i, sample);
  parts_->draw_motion(i, sample);
  parts_->draw_panel(sample);
  return parts_->canvas.pixels();
}

}  // namespace tumble::output
