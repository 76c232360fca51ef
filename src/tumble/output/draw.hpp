// The things that all pictures show beside bodies: axes, contact impulses, and the words beside them.
#pragma once

#include <string>

#include "tumble/output/canvas.hpp"
#include "tumble/output/impulses.hpp"
#include "tumble/output/view.hpp"

namespace tumble::output {

// One restrained set of colours. The three of the contact modes stay apart for the colour-blind as well
// [Okabe & Ito 2008].
inline constexpr Colour k_paper{1.0, 1.0, 1.0};
inline constexpr Colour k_ink{0.13, 0.17, 0.21};
inline constexpr Colour k_muted{0.42, 0.47, 0.53};
inline constexpr Colour k_grid{0.915, 0.93, 0.945};
inline constexpr Colour k_ground{0.36, 0.41, 0.46};
inline constexpr Colour k_fixed_fill{0.90, 0.915, 0.93};
inline constexpr Colour k_accent{0.13, 0.34, 0.60};  // bars
inline constexpr Colour k_stick{0.00, 0.53, 0.42};
inline constexpr Colour k_slip_left{0.84, 0.37, 0.00};
inline constexpr Colour k_slip_right{0.58, 0.24, 0.62};

Colour colour_of(ContactMode mode);

// That of the scene, or what stands in its place.
std::string title_of(const Trajectory& trajectory);

// "m = 0.3 kg, ...": what tells one run of a scene from another.
std::string facts_text(const Trajectory& trajectory);

// The sample nearest to a time [s].
std::size_t sample_at(const Trajectory& trajectory, double time);

// Digits behind the point that show three figures of the largest value, in [low, 6].
int decimals_for(double largest, int low);

// As Canvas::draw_text, in smaller type if the text would be wider than `width` [px].
void draw_text_within(Canvas& canvas, double width, Point at, std::string_view text, TextStyle style);

// Grid, and tick labels at the left and the bottom edge of the area.
void draw_axes(Canvas& canvas, const View& view, double text_size);

struct ArrowStyle {
  double length;  // [px]
  double width;   // of the shaft [px]
  Colour colour;
};

// From `tail` [px] along an impulse.
void draw_impulse(Canvas& canvas, Point tail, const Impulse& impulse, const ArrowStyle& style);

// The friction cone of a contact: two edges of `length` [px] beside the normal, and the area between them.
void draw_cone(Canvas& canvas, Point apex, Vector2 normal, double friction, double length, double opacity);

}  // namespace tumble::output
