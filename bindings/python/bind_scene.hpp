// The scene as Python holds it, for the bindings that simulate it.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "convert_scene.hpp"

#include "tumble/scene/scene.hpp"

namespace tumble::python {

// A scene that grows body by body; each is checked as it comes, so that the scene is always valid.
struct SceneHandle {
  Scene scene;
  std::map<std::string, int, std::less<>> materials, bodies;  // indices by name

  // By name or index; negative indices count from the end. Raises ValueError with a suggestion, IndexError, TypeError.
  int find_body(const py::handle& object) const;

  // By name. Raises ValueError with a suggestion, TypeError.
  int find_material(const py::handle& object, const std::string& field) const;
};

SceneHandle handle_of(Scene scene);

}  // namespace tumble::python
