// A thin skin over cairo: a drawing surface with the few marks that the pictures are made of.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tumble/output/view.hpp"

struct _cairo;
struct _cairo_surface;

namespace tumble::output {

struct Colour {
  double red;  // 0 to 1
  double green;
  double blue;
  double opacity = 1.0;

  constexpr Colour with_opacity(double value) const { return {red, green, blue, value}; }
};

// a at 0, b at 1.
Colour mix(const Colour& a, const Colour& b, double share);

enum class Align { left, centre, right };

struct TextStyle {
  double size;  // [px]
  Colour colour;
  Align align = Align::left;
  bool is_bold = false;
};

struct Stroke {
  Colour colour;
  double width;       // [px]
  double dash = 0.0;  // [px]; 0: no dashes
  double gap = 0.0;   // [px]
};

// All lengths are in units of `scale` pixels, so that one layout serves all picture sizes.
class Canvas {
 public:
  static Canvas image(int width, int height, double scale);
  static Canvas svg(int width, int height, double scale);

  Canvas(Canvas&&) noexcept;
  ~Canvas();

  void fill(const Colour& colour);  // all of it
  void fill_rectangle(const Area& area, const Colour& colour);
  void draw_line(Point from, Point to, const Stroke& stroke);
  void draw_polyline(const std::vector<Point>& points, const Stroke& stroke);
  void draw_polygon(const std::vector<Point>& points, const Colour& fill, const Stroke& outline);
  void draw_disc(Point centre, double radius, const Colour& colour);
  void draw_circle(Point centre, double radius, const Stroke& stroke);
  void draw_text(Point at, std::string_view text, const TextStyle& style);
  double text_width(std::string_view text, const TextStyle& style);

  // Everything until `unclip` shows only inside the area.
  void clip(const Area& area);
  void unclip();

  // Replaces all pixels of an image by those of another of the same size.
  void copy_pixels(const Canvas& other);

  // The pixels of an image, 0x00RRGGBB, row after row, width() per row.
  std::vector<std::uint32_t> pixels();

  std::string to_png();
  std::string to_svg();  // ends the drawing

  int width() const { return width_; }    // [px]
  int height() const { return height_; }  // [px]

 private:
  Canvas(int width, int height);
  void start(double scale);
  void set_colour(const Colour& colour);
  void trace(const std::vector<Point>& points);
  void stroke(const Stroke& stroke);
  void set_font(const TextStyle& style);
  void check() const;

  int width_;
  int height_;
  std::unique_ptr<std::string> svg_bytes_;  // at a fixed address: cairo writes to it
  _cairo_surface* surface_ = nullptr;
  _cairo* context_ = nullptr;
};

}  // namespace tumble::output
