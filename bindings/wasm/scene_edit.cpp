#include "scene_edit.hpp"

#include <algorithm>

#include "tumble/math/format.hpp"

namespace tumble::wasm {
namespace {

using Index = std::size_t;

val pose_of(const Pose& pose) { return to_array(Vector3{pose.position.x, pose.position.y, pose.angle}); }

val points_of(const std::vector<Vector2>& points) {
  std::vector<double> flat;
  for (const Vector2 p : points) flat.insert(flat.end(), {p.x, p.y});
  return to_typed_array(flat);
}

val describe(const Shape& shape) {
  val object = val::object();
  if (const auto* polygon = std::get_if<RoundedPolygon>(&shape)) {
    set(object, "kind", std::string("polygon"));
    set(object, "points", points_of(polygon->vertices));
    set(object, "rounding", polygon->rounding);
  } else if (const auto* ellipse = std::get_if<Ellipse>(&shape)) {
    set(object, "kind", std::string("ellipse"));
    set(object, "semi_axes", to_array(Vector2{ellipse->semi_axis_x, ellipse->semi_axis_y}));
    set(object, "pose", pose_of(ellipse->pose));
  } else if (const auto* half_plane = std::get_if<HalfPlane>(&shape)) {
    set(object, "kind", std::string("half_plane"));
    set(object, "normal", to_array(half_plane->normal));
    set(object, "offset", half_plane->offset);
  } else if (const auto* terrain = std::get_if<Terrain>(&shape)) {
    set(object, "kind", std::string("terrain"));
    set(object, "points", points_of(terrain->points));
  }
  return object;
}

val describe(const Body& body, const std::string& label) {
  val parts = val::array();
  for (Index i = 0; i < body.parts.size(); ++i) {
    val part = describe(body.parts[i].shape);
    set(part, "material", static_cast<double>(body.parts[i].material));
    set(part, "surface_speed", body.parts[i].surface_speed);
    parts.set(i, part);
  }
  val object = val::object();
  set(object, "name", label);
  set(object, "kind", std::string(to_string(body.kind)));
  set(object, "mass", body.mass);
  set(object, "moment_of_inertia", body.moment_of_inertia);
  set(object, "pose", pose_of(body.pose));
  set(object, "velocity", to_array(body.velocity));
  set(object, "parts", parts);
  return object;
}

template <class Item>
Item& item_at(std::vector<Item>& items, const val& edit, const char* what) {
  const double index = number_at(edit, "index");
  if (index >= 0.0 && index < static_cast<double>(items.size())) return items[static_cast<Index>(index)];
  throw std::invalid_argument(tumble::format("{}: there is none with index {}", what, index));
}

bool has(const val& object, const char* name) { return !object[name].isUndefined(); }

void apply_to_body(Scene& scene, const val& edit) {
  Body& body = item_at(scene.bodies, edit, "bodies");
  if (has(edit, "pose")) {
    const Vector3 pose = triple_at(edit, "pose");
    body.pose = {{pose[0], pose[1]}, pose[2]};
  }
  if (has(edit, "velocity")) body.velocity = triple_at(edit, "velocity");
  if (has(edit, "mass")) {  // of the same shape, denser
    const double mass = number_at(edit, "mass");
    body.moment_of_inertia *= mass / body.mass;
    body.mass = mass;
  }
}

void apply_to_material(Scene& scene, const val& edit) {
  ContactLaw& law = item_at(scene.materials, edit, "materials").law;
  if (has(edit, "friction")) {
    const bool is_one = law.static_friction == law.friction;
    law.friction = number_at(edit, "friction");
    law.static_friction = is_one ? law.friction : std::max(law.static_friction, law.friction);
  }
  if (has(edit, "restitution")) law.restitution = number_at(edit, "restitution");
}

template <class Apply>
void for_each_of(const val& edits, const char* name, Apply apply) {
  if (!has(edits, name)) return;
  const val list = edits[name];
  for (int i = 0; i < list["length"].as<int>(); ++i) apply(list[i]);
}

}  // namespace

val describe(const Scene& scene) {
  const std::vector<std::string> labels = body_labels(scene);
  val bodies = val::array(), materials = val::array();
  for (Index i = 0; i < scene.bodies.size(); ++i) bodies.set(i, describe(scene.bodies[i], labels[i]));
  for (Index i = 0; i < scene.materials.size(); ++i) {
    const Material& material = scene.materials[i];
    val object = val::object();
    set(object, "name", material.name);
    set(object, "friction", material.law.friction);
    set(object, "static_friction", material.law.static_friction);
    set(object, "restitution", material.law.restitution);
    materials.set(i, object);
  }
  val object = val::object();
  set(object, "title", scene.title);
  set(object, "bodies", bodies);
  set(object, "materials", materials);
  set(object, "gravity", to_array(scene.gravity));
  set(object, "step_size", scene.step_size);
  set(object, "duration", scene.duration);
  return object;
}

void apply_edits(Scene& scene, const val& edits) {
  for_each_of(edits, "bodies", [&](const val& edit) { apply_to_body(scene, edit); });
  for_each_of(edits, "materials", [&](const val& edit) { apply_to_material(scene, edit); });
  if (has(edits, "gravity")) {
    const val gravity = edits["gravity"];
    scene.gravity = {gravity[0].as<double>(), gravity[1].as<double>()};
  }
  if (has(edits, "step_size")) scene.step_size = number_at(edits, "step_size");
  if (has(edits, "duration")) scene.duration = number_at(edits, "duration");
  validate(scene);
}

}  // namespace tumble::wasm
