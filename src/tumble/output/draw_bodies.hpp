// The bodies of a scene in a picture: fixed, moved and moving.
#pragma once

#include <span>
#include <vector>

#include "tumble/output/canvas.hpp"
#include "tumble/output/outline.hpp"

namespace tumble::output {

// Of bodies of one kind; `deep` is for outlines and paths.
struct BodyColours {
  Colour fill;
  Colour deep;
};

// One for each body of the scene. Bodies whose names differ in a number at the end are of one kind.
std::vector<BodyColours> body_colours(const Scene& scene);

struct BodyStyle {
  Colour fill;
  Stroke outline;
  Colour mark;  // of the spoke or dot that lets a rotation be read
};

// What a body looks like where it is.
BodyStyle solid_style(const BodyColours& colours);

// Of more moving bodies the pictures show no cones, and arrows no longer than bodies.
inline constexpr std::size_t k_few_bodies = 8;

class BodyDrawing {
 public:
  // The scene must outlive it.
  BodyDrawing(const Scene& scene, const View& view);

  // Those that are fixed, without the moving surfaces of conveyors.
  void draw_fixed(Canvas& canvas) const;

  // A body at a pose; lines of small bodies are finer, and one too small to be seen is a dot.
  void draw(Canvas& canvas, std::size_t body, const Pose& pose, const BodyStyle& usual_style) const;

  // The surfaces of conveyors at a time [s]: chevrons that run with them.
  void draw_conveyors(Canvas& canvas, std::span<const BodyState> states, double time) const;

  const BodyColours& colours(std::size_t body) const { return colours_[body]; }

  // The bodies that are not fixed.
  const std::vector<std::size_t>& moving() const { return moving_; }
  bool is_crowd() const { return moving_.size() > k_few_bodies; }

  // How long the longest arrow may be [px], at most `usual`.
  double arrow_room(double usual) const;

 private:
  void draw_ground(Canvas& canvas, const PartOutline& outline, Point centre, const Frame& turn) const;

  const Scene& scene_;
  View view_;
  Area around_;  // the area of the view and some more
  std::vector<BodyOutline> outlines_;
  std::vector<BodyColours> colours_;
  std::vector<std::size_t> moving_;
};

// The way of a body over the samples [first, last], without points that no pixel would tell apart.
void draw_path(Canvas& canvas, const View& view, const Trajectory& trajectory, std::size_t body, std::size_t first,
               std::size_t last, const Stroke& style);

}  // namespace tumble::output
