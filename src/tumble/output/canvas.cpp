#include "tumble/output/canvas.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <utility>

#include <cairo-svg.h>
#include <cairo.h>

#include "tumble/math/format.hpp"

namespace tumble::output {
namespace {

constexpr const char* k_font = "DejaVu Sans";
constexpr double k_full_turn = 6.283185307179586;

cairo_status_t append(void* bytes, const unsigned char* data, unsigned length) {
  try {
    static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  } catch (...) {
    return CAIRO_STATUS_NO_MEMORY;  // no exception may pass through the C code
  }
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

Colour mix(const Colour& a, const Colour& b, double share) {
  const auto between = [share](double from, double to) { return from + share * (to - from); };
  return {between(a.red, b.red), between(a.green, b.green), between(a.blue, b.blue), between(a.opacity, b.opacity)};
}

Canvas::Canvas(int width, int height) : width_(width), height_(height) {}

Canvas::Canvas(Canvas&& other) noexcept
    : width_(other.width_),
      height_(other.height_),
      svg_bytes_(std::move(other.svg_bytes_)),
      surface_(std::exchange(other.surface_, nullptr)),
      context_(std::exchange(other.context_, nullptr)) {}

Canvas::~Canvas() {
  cairo_destroy(context_);
  cairo_surface_destroy(surface_);
}

Canvas Canvas::image(int width, int height, double scale) {
  Canvas canvas(width, height);
  canvas.surface_ = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
  canvas.start(scale);
  return canvas;
}

Canvas Canvas::svg(int width, int height, double scale) {
  Canvas canvas(width, height);
  canvas.svg_bytes_ = std::make_unique<std::string>();
  canvas.surface_ = cairo_svg_surface_create_for_stream(append, canvas.svg_bytes_.get(), width, height);
  cairo_svg_surface_set_document_unit(canvas.surface_, CAIRO_SVG_UNIT_PX);
  canvas.start(scale);
  return canvas;
}

void Canvas::start(double scale) {
  context_ = cairo_create(surface_);
  cairo_scale(context_, scale, scale);
  cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(context_, CAIRO_LINE_CAP_ROUND);
  // The same glyphs wherever the picture is made: no hints or subpixels of a desktop's settings.
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context_, options);
  cairo_font_options_destroy(options);
  check();
}

void Canvas::check() const {
  cairo_status_t status = cairo_status(context_);
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface_);
  if (status != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(tumble::format("cairo cannot draw: {}", cairo_status_to_string(status)));
  }
}

void Canvas::set_colour(const Colour& colour) {
  cairo_set_source_rgba(context_, colour.red, colour.green, colour.blue, colour.opacity);
}

void Canvas::fill(const Colour& colour) {
  set_colour(colour);
  cairo_paint(context_);
}

void Canvas::fill_rectangle(const Area& area, const Colour& colour) {
  set_colour(colour);
  cairo_rectangle(context_, area.left, area.top, area.width, area.height);
  cairo_fill(context_);
}

void Canvas::trace(const std::vector<Point>& points) {
  cairo_new_path(context_);
  for (const Point& point : points) cairo_line_to(context_, point.x, point.y);
}

void Canvas::stroke(const Stroke& stroke) {
  set_colour(stroke.colour);
  cairo_set_line_width(context_, stroke.width);
  const std::array<double, 2> dashes = {stroke.dash, stroke.gap};
  cairo_set_dash(context_, dashes.data(), stroke.gap > 0.0 ? 2 : 0, 0.0);
  cairo_stroke(context_);
}

void Canvas::draw_line(Point from, Point to, const Stroke& style) {
  trace({from, to});
  stroke(style);
}

void Canvas::draw_polyline(const std::vector<Point>& points, const Stroke& style) {
  trace(points);
  stroke(style);
}

void Canvas::draw_polygon(const std::vector<Point>& points, const Colour& colour, const Stroke& outline) {
  trace(points);
  cairo_close_path(context_);
  set_colour(colour);
  cairo_fill_preserve(context_);
  if (outline.width > 0.0) stroke(outline);
  cairo_new_path(context_);
}

void Canvas::draw_disc(Point centre, double radius, const Colour& colour) {
  cairo_new_path(context_);
  cairo_arc(context_, centre.x, centre.y, radius, 0.0, k_full_turn);
  set_colour(colour);
  cairo_fill(context_);
}

void Canvas::draw_circle(Point centre, double radius, const Stroke& style) {
  cairo_new_path(context_);
  cairo_arc(context_, centre.x, centre.y, radius, 0.0, k_full_turn);
  stroke(style);
}

void Canvas::set_font(const TextStyle& style) {
  cairo_select_font_face(context_, k_font, CAIRO_FONT_SLANT_NORMAL,
                         style.is_bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_, style.size);
}

double Canvas::text_width(std::string_view text, const TextStyle& style) {
  set_font(style);
  cairo_text_extents_t extents;
  cairo_text_extents(context_, std::string(text).c_str(), &extents);
  return extents.x_advance;
}

void Canvas::draw_text(Point at, std::string_view text, const TextStyle& style) {
  if (style.align != Align::left) {
    at.x -= text_width(text, style) * (style.align == Align::centre ? 0.5 : 1.0);
  }
  set_font(style);
  set_colour(style.colour);
  cairo_move_to(context_, at.x, at.y);
  cairo_show_text(context_, std::string(text).c_str());
  cairo_new_path(context_);
}

void Canvas::clip(const Area& area) {
  cairo_save(context_);
  cairo_rectangle(context_, area.left, area.top, area.width, area.height);
  cairo_clip(context_);
}

void Canvas::unclip() { cairo_restore(context_); }

void Canvas::copy_pixels(const Canvas& other) {
  cairo_surface_flush(surface_);
  cairo_surface_flush(other.surface_);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface_));
  std::memcpy(cairo_image_surface_get_data(surface_), cairo_image_surface_get_data(other.surface_),
              stride * static_cast<std::size_t>(height_));
  cairo_surface_mark_dirty(surface_);
}

std::vector<std::uint32_t> Canvas::pixels() {
  check();
  cairo_surface_flush(surface_);
  const auto row_size = static_cast<std::size_t>(width_);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface_));
  const unsigned char* data = cairo_image_surface_get_data(surface_);
  std::vector<std::uint32_t> values(row_size * static_cast<std::size_t>(height_));
  for (std::size_t row = 0; row < static_cast<std::size_t>(height_); ++row) {
    std::memcpy(values.data() + row * row_size, data + row * stride, row_size * sizeof(std::uint32_t));
  }
  for (std::uint32_t& value : values) value &= 0xffffff;
  return values;
}

std::string Canvas::to_png() {
  check();
  std::string bytes;
  const cairo_status_t status = cairo_surface_write_to_png_stream(surface_, append, &bytes);
  if (status != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(tumble::format("cairo cannot make a png: {}", cairo_status_to_string(status)));
  }
  return bytes;
}

std::string Canvas::to_svg() {
  check();
  cairo_surface_finish(surface_);
  const cairo_status_t status = cairo_surface_status(surface_);
  if (status != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(tumble::format("cairo cannot make an svg: {}", cairo_status_to_string(status)));
  }
  // cairo counts its surfaces: without the number the bytes depend on the drawing alone.
  constexpr std::string_view k_label = "id=\"surface";
  const std::size_t label = svg_bytes_->find(k_label);
  if (label != std::string::npos) {
    const std::size_t number = label + k_label.size();
    svg_bytes_->erase(number, svg_bytes_->find_first_not_of("0123456789", number) - number);
  }
  return std::move(*svg_bytes_);
}

}  // namespace tumble::output
