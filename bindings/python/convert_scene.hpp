// Shapes, points and angles <-> Python, for the bindings of scenes.
#pragma once

#include <string>
#include <vector>

#include "convert.hpp"

#include "tumble/math/vector2.hpp"
#include "tumble/scene/limits.hpp"
#include "tumble/scene/scene.hpp"

namespace tumble::python {

// All raise ValueError naming the field, the value and what is allowed.
double as_number_in(const Range& range, const py::handle& object, const std::string& field);
Vector2 as_vector2(const Range& range, const py::handle& object, const std::string& field);
// Radians, or text like "30 deg".
double as_angle(const py::handle& object, const std::string& field);
Pose as_pose(const py::handle& position, const py::handle& angle, const std::string& prefix = "");

inline py::tuple to_tuple(Vector2 v) { return py::make_tuple(v.x, v.y); }

// Raises TypeError for anything but a shape.
const Shape& as_shape(const py::handle& object, const std::string& field);
py::object to_python(const Shape& shape);

}  // namespace tumble::python
