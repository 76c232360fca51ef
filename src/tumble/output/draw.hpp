// The things that all pictures show: ground, axes, the square, contact impulses, and the words beside them.
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
inline constexpr Colour k_body_early{0.60, 0.74, 0.89};
inline constexpr Colour k_body{0.13, 0.34, 0.60};
inline constexpr Colour k_stick{0.00, 0.53, 0.42};
inline constexpr Colour k_slip_left{0.84, 0.37, 0.00};
inline constexpr Colour k_slip_right{0.58, 0.24, 0.62};

Colour colour_of(ContactMode mode);

// "l = 0.2 m, m = 0.3 kg, ..."
std::string parameters_text(const drop::Parameters& parameters);

// Digits behind the point that show three figures of the largest value, in [low, 6].
int decimals_for(double largest, int low);

// As Canvas::draw_text, in smaller type if the text would be wider than `width` [px].
void draw_text_within(Canvas& canvas, double width, Point at, std::string_view text, TextStyle style);

// Grid, tick labels at the left and the bottom edge of the frame, and the ground with its hatching.
void draw_surroundings(Canvas& canvas, const View& view, double text_size);

struct SquareStyle {
  Colour fill;
  Stroke outline;
  Colour mark;  // of the dot near the corner (-,-), which lets a rotation be read
};

// A square too small to be seen is drawn as a dot.
void draw_square(Canvas& canvas, const View& view, const Vector3& q, const drop::Parameters& parameters,
                 const SquareStyle& style);

// The corner in contact [px].
Point contact_pixel(const View& view, const drop::Record& record, int column);

struct ArrowStyle {
  double length;  // [px]
  double width;   // of the shaft [px]
  Colour colour;
};

// From `tail` along the impulse.
void draw_impulse(Canvas& canvas, Point tail, const Impulse& impulse, const ArrowStyle& style);

// The friction cone: two edges of `length` [px] with the slope of mu, and the area between them.
void draw_cone(Canvas& canvas, Point apex, double mu, double length, double opacity);

// The way of the centre over the columns [first, last], without points that no pixel would tell apart.
void draw_path(Canvas& canvas, const View& view, const drop::Record& record, int first, int last, const Stroke& style);

}  // namespace tumble::output
