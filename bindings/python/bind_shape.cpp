// tumble._core: shapes. Public face: tumble/_shapes.py.
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "convert_scene.hpp"

#include "tumble/math/format.hpp"
#include "tumble/math/numeric.hpp"
#include "tumble/scene/check.hpp"
#include "tumble/scene/shape.hpp"

namespace tumble::python {
namespace {

using namespace py::literals;

// What Python calls a Shape: immutable. A struct of its own, as pybind11 has a meaning for variants.
struct ShapeHandle {
  Shape shape;
};

ShapeHandle checked(Shape shape) {
  validate(shape);
  return {std::move(shape)};
}

std::vector<Vector2> as_points(const py::handle& object, const char* field, py::ssize_t count = -1) {
  const Array array = as_array(object, field, {count, 2}, count < 0 ? "(n, 2)" : "");
  std::vector<Vector2> points(static_cast<std::size_t>(array.shape(0)));
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {array.data()[2 * i], array.data()[2 * i + 1]};
  return points;
}

py::array_t<double> to_numpy(const std::vector<Vector2>& points) {
  py::array_t<double> array({static_cast<py::ssize_t>(points.size()), py::ssize_t{2}});
  double* out = array.mutable_data();
  for (const Vector2 point : points) {
    *out++ = point.x;
    *out++ = point.y;
  }
  return array;
}

int as_corners(const py::handle& object) {
  if (!PyIndex_Check(object.ptr()) || PyBool_Check(object.ptr())) {
    throw std::invalid_argument(tumble::format("corners: must be a whole number, got {}", short_repr(object)));
  }
  int overflow = 0;
  const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(object.ptr()));
  const long value = PyLong_AsLongAndOverflow(index.ptr(), &overflow);
  constexpr long too_many = static_cast<long>(k_max_vertices) + 1;
  if (overflow != 0 || value > too_many) return static_cast<int>(overflow < 0 ? -1 : too_many);
  return static_cast<int>(value < -1 ? -1 : value);
}

ShapeHandle make_polygon(const py::handle& vertices, const py::handle& rounding) {
  return checked(RoundedPolygon{as_points(vertices, "vertices"), as_number_in(k_rounding_range, rounding, "rounding")});
}

ShapeHandle make_segment(const py::handle& start, const py::handle& end) {
  return {segment(as_vector2(k_coordinate_range, start, "start"), as_vector2(k_coordinate_range, end, "end"))};
}

ShapeHandle make_half_plane(const py::handle& normal, const py::handle& offset) {
  return {half_plane(as_vector2(k_coordinate_range, normal, "normal"), as_number(offset, "offset"))};
}

py::dict as_dict(const ShapeHandle& handle) {
  if (const auto* polygon = std::get_if<RoundedPolygon>(&handle.shape)) {
    return py::dict("kind"_a = "polygon", "vertices"_a = to_numpy(polygon->vertices), "rounding"_a = polygon->rounding);
  }
  if (const auto* ellipse = std::get_if<Ellipse>(&handle.shape)) {
    return py::dict("kind"_a = "ellipse", "semi_axis_x"_a = ellipse->semi_axis_x,
                    "semi_axis_y"_a = ellipse->semi_axis_y, "position"_a = to_tuple(ellipse->pose.position),
                    "angle"_a = ellipse->pose.angle);
  }
  if (const auto* half_plane = std::get_if<HalfPlane>(&handle.shape)) {
    return py::dict("kind"_a = "half_plane", "normal"_a = to_tuple(half_plane->normal),
                    "offset"_a = half_plane->offset);
  }
  return py::dict("kind"_a = "terrain", "points"_a = to_numpy(std::get<Terrain>(handle.shape).points));
}

ShapeHandle from_dict(const py::dict& fields) {
  const auto kind = fields["kind"].cast<std::string>();
  if (kind == "polygon") return make_polygon(fields["vertices"], fields["rounding"]);
  if (kind == "half_plane") return make_half_plane(fields["normal"], fields["offset"]);
  if (kind == "terrain") return checked(Terrain{as_points(fields["points"], "points")});
  return checked(Ellipse{as_number(fields["semi_axis_x"], "semi_axis_x"),
                         as_number(fields["semi_axis_y"], "semi_axis_y"),
                         as_pose(fields["position"], fields["angle"])});
}

std::string shape_repr(const ShapeHandle& handle) {
  if (const auto* polygon = std::get_if<RoundedPolygon>(&handle.shape)) {
    const std::size_t corners = polygon->vertices.size();
    if (corners == 1) return tumble::format("<Shape: disc of radius {} m>", polygon->rounding);
    const std::string what = corners == 2 ? "segment" : tumble::format("polygon of {} corners", corners);
    return polygon->rounding == 0.0 ? tumble::format("<Shape: {}>", what)
                                    : tumble::format("<Shape: {}, rounding {} m>", what, polygon->rounding);
  }
  if (const auto* ellipse = std::get_if<Ellipse>(&handle.shape)) {
    return tumble::format("<Shape: ellipse of semi-axes {} m and {} m>", ellipse->semi_axis_x, ellipse->semi_axis_y);
  }
  if (const auto* half_plane = std::get_if<HalfPlane>(&handle.shape)) {
    return tumble::format("<Shape: half-plane of normal ({}, {}), offset {} m>", half_plane->normal.x,
                          half_plane->normal.y, half_plane->offset);
  }
  return tumble::format("<Shape: terrain of {} points>", std::get<Terrain>(handle.shape).points.size());
}

}  // namespace

double as_number_in(const Range& range, const py::handle& object, const std::string& field) {
  const double value = as_number(object, field.c_str());
  require_in(range, field, value);
  return value;
}

Vector2 as_vector2(const Range& range, const py::handle& object, const std::string& field) {
  const Array array = as_array(object, field.c_str(), {2});
  const Vector2 value{array.data()[0], array.data()[1]};
  require_in(range, field + "[0]", value.x);
  require_in(range, field + "[1]", value.y);
  return value;
}

double as_angle(const py::handle& object, const std::string& field) {
  if (py::isinstance<py::str>(object)) {
    const std::optional<double> value = parse_degrees(as_text(object, field.c_str()));
    if (!value) {
      throw std::invalid_argument(
          tumble::format("{}: must be a number in rad or text like \"30 deg\", got {}", field, short_repr(object)));
    }
    require_in(k_angle_range, field, *value);
    return *value;
  }
  return as_number_in(k_angle_range, object, field);
}

Pose as_pose(const py::handle& position, const py::handle& angle, const std::string& prefix) {
  return {as_vector2(k_coordinate_range, position, prefix + "position"), as_angle(angle, prefix + "angle")};
}

const Shape& as_shape(const py::handle& object, const std::string& field) {
  if (py::isinstance<ShapeHandle>(object)) return object.cast<const ShapeHandle&>().shape;
  throw py::type_error(
      tumble::format("{}: must be a shape like tumble.square(0.2), got {}", field, short_repr(object)));
}

py::object to_python(const Shape& shape) { return py::cast(ShapeHandle{shape}); }

void bind_shape(py::module_& module) {
  py::class_<ShapeHandle>(module, "Shape")
      .def_property_readonly("area", [](const ShapeHandle& s) { return area_moments(s.shape).area; })
      .def_property_readonly("centroid", [](const ShapeHandle& s) { return to_tuple(area_moments(s.shape).centroid); })
      .def_property_readonly("polar_moment", [](const ShapeHandle& s) { return area_moments(s.shape).polar_moment; })
      .def("asdict", &as_dict)
      .def(
          "moved",
          [](const ShapeHandle& s, const py::object& position, const py::object& angle) {
            return checked(moved(s.shape, as_pose(position, angle)));
          },
          "position"_a = py::make_tuple(0.0, 0.0), "angle"_a = 0.0)
      .def("__eq__",
           [](const ShapeHandle& a, const py::object& b) {
             return py::isinstance<ShapeHandle>(b) && a.shape == b.cast<const ShapeHandle&>().shape;
           })
      .def("__hash__", [](const ShapeHandle& s) { return py::hash(py::str(shape_repr(s))); })
      .def("__repr__", &shape_repr)
      .def(py::pickle(&as_dict, &from_dict));

  module.def(
      "square",
      [](const py::object& side, const py::object& rounding) {
        return ShapeHandle{square(as_number(side, "side"), as_number(rounding, "rounding"))};
      },
      "side"_a, "rounding"_a);
  module.def(
      "rectangle",
      [](const py::object& width, const py::object& height, const py::object& rounding) {
        return ShapeHandle{
            rectangle(as_number(width, "width"), as_number(height, "height"), as_number(rounding, "rounding"))};
      },
      "width"_a, "height"_a, "rounding"_a);
  module.def(
      "regular_polygon",
      [](const py::object& corners, const py::object& circumradius, const py::object& rounding) {
        return ShapeHandle{regular_polygon(as_corners(corners), as_number(circumradius, "circumradius"),
                                           as_number(rounding, "rounding"))};
      },
      "corners"_a, "circumradius"_a, "rounding"_a);
  module.def("polygon", &make_polygon, "vertices"_a, "rounding"_a);
  module.def(
      "disc", [](const py::object& radius) { return ShapeHandle{disc(as_number(radius, "radius"))}; }, "radius"_a);
  module.def(
      "ellipse",
      [](const py::object& x, const py::object& y) {
        return ShapeHandle{ellipse(as_number(x, "semi_axis_x"), as_number(y, "semi_axis_y"))};
      },
      "semi_axis_x"_a, "semi_axis_y"_a);
  module.def(
      "capsule",
      [](const py::object& length, const py::object& radius) {
        return ShapeHandle{capsule(as_number(length, "length"), as_number(radius, "radius"))};
      },
      "length"_a, "radius"_a);
  module.def("segment", &make_segment, "start"_a, "end"_a);
  module.def("half_plane", &make_half_plane, "normal"_a, "offset"_a);
  module.def(
      "terrain", [](const py::object& points) { return checked(Terrain{as_points(points, "points")}); }, "points"_a);
}

}  // namespace tumble::python
