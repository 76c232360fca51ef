// tumble._core: scenes. Public face: tumble/_scene.py.
#include "bind_scene.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tumble/math/format.hpp"
#include "tumble/scene/check.hpp"
#include "tumble/scene/scene_toml.hpp"
#include "tumble/scene/suggestion.hpp"
#include "tumble/trajectory/scene_warnings.hpp"

namespace tumble::python {
namespace {

using namespace py::literals;
using Names = std::map<std::string, int, std::less<>>;

template <class Entries>
Names names_of(const Entries& entries) {
  Names names;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (!entries[i].name.empty()) names[entries[i].name] = static_cast<int>(i);
  }
  return names;
}

[[noreturn]] void refuse_unknown(const std::string& field, const char* what, const std::string& name,
                                 const Names& names) {
  std::vector<std::string_view> words;
  for (const auto& [word, index] : names) words.push_back(word);
  throw std::invalid_argument(
      tumble::format("{}: must be the name of a {}, got {}{}", field, what, shown(name), suggestion(name, words)));
}

int add_material_to(SceneHandle& handle, Material material) {
  const std::size_t index = handle.scene.materials.size();
  if (index == k_max_materials) {
    throw std::invalid_argument(tumble::format("materials: a scene has at most {}", k_max_materials));
  }
  handle.materials[material.name] = static_cast<int>(index);
  handle.scene.materials.push_back(std::move(material));
  return static_cast<int>(index);
}

// The law with what is given in its place; the static friction is the other one's value unless it is given itself.
ContactLaw as_law(ContactLaw law, const py::handle& friction, const py::handle& static_friction,
                  const py::handle& restitution) {
  if (!friction.is_none()) law.friction = law.static_friction = as_number(friction, "friction");
  if (!static_friction.is_none()) law.static_friction = as_number(static_friction, "static_friction");
  if (!restitution.is_none()) law.restitution = as_number(restitution, "restitution");
  check_law(law);
  return law;
}

void add_material(SceneHandle& handle, const py::handle& name_object, const py::handle& friction,
                  const py::handle& static_friction, const py::handle& restitution) {
  const std::string name = as_text(name_object, "name");
  if (name.empty()) throw std::invalid_argument("name: must not be empty");
  check_name("name", name, k_max_name_bytes);
  if (handle.materials.count(name) > 0) {
    const bool is_default = name == k_default_material;
    throw std::invalid_argument(
        tumble::format("name: must differ from the materials before, got {}{}", shown(name),
                       is_default ? "; bodies without a material have it already: add it before them" : ""));
  }
  add_material_to(handle, {name, as_law({}, friction, static_friction, restitution)});
}

void add_pair(SceneHandle& handle, const py::handle& a, const py::handle& b, const py::handle& friction,
              const py::handle& static_friction, const py::handle& restitution) {
  MaterialPair pair{handle.find_material(a, "a"), handle.find_material(b, "b"), {}};
  const Scene& scene = handle.scene;
  if (pair.a == pair.b) throw std::invalid_argument("b: must be another material than a");
  if (scene.pairs.size() == k_max_pairs) {
    throw std::invalid_argument(tumble::format("pairs: a scene has at most {}", k_max_pairs));
  }
  const auto is_same = [&](const MaterialPair& other) {
    return std::minmax(pair.a, pair.b) == std::minmax(other.a, other.b);
  };
  if (std::any_of(scene.pairs.begin(), scene.pairs.end(), is_same)) {
    throw std::invalid_argument("a, b: these two are a pair already");
  }
  pair.law = as_law(contact_law(scene, pair.a, pair.b), friction, static_friction, restitution);
  handle.scene.pairs.push_back(pair);
}

// What add_body, add_kinematic and add_fixed of Scene were called with; those of other kinds are absent.
struct BodyFields {
  const py::dict& fields;

  py::object find(const char* name) const {
    return fields.contains(name) ? py::object(fields[name]) : py::object(py::none());
  }
  double number_or(const char* name, double otherwise) const {
    const py::object value = find(name);
    return value.is_none() ? otherwise : as_number(value, name);
  }
};

Part as_part(SceneHandle& handle, const py::handle& object, const BodyFields& body, const std::string& place) {
  const auto entries = py::reinterpret_borrow<py::tuple>(object);  // shape, position, angle, material, surface_speed
  Part part;
  part.shape = as_shape(entries[0], place + "shape");
  const Pose pose = as_pose(entries[1], entries[2], place);
  if (!(pose == Pose{})) part.shape = moved(part.shape, pose);
  const bool has_material = !entries[3].is_none();
  const py::object material = has_material ? py::object(entries[3]) : body.find("material");
  if (!material.is_none()) {
    part.material = handle.find_material(material, has_material ? place + "material" : "material");
  } else {
    const auto found = handle.materials.find(k_default_material);
    part.material = found != handle.materials.end() ? found->second
                                                    : add_material_to(handle, {std::string(k_default_material), {}});
  }
  const bool has_speed = !entries[4].is_none();
  const py::object speed = has_speed ? py::object(entries[4]) : body.find("surface_speed");
  part.surface_speed = as_number_in(k_speed_range, speed, has_speed ? place + "surface_speed" : "surface_speed");
  return part;
}

void read_mass(const BodyFields& fields, Body& body) {
  const py::object density = fields.find("density"), mass = fields.find("mass");
  const py::object inertia = fields.find("moment_of_inertia"), centre = fields.find("centre_of_mass");
  if (density.is_none() == mass.is_none()) {
    throw std::invalid_argument(density.is_none() ? "mass: a dynamic body must have a mass or a density"
                                                  : "mass: must not stand beside density, which gives it");
  }
  if (!density.is_none()) {
    if (!inertia.is_none() || !centre.is_none()) {
      throw std::invalid_argument(tumble::format("{}: must not stand beside density, which gives it",
                                                 inertia.is_none() ? "centre_of_mass" : "moment_of_inertia"));
    }
    set_density(body, as_number_in(k_density_range, density, "density"));
    return;
  }
  const double value = as_number_in(k_mass_range, mass, "mass");
  if (inertia.is_none()) {
    if (!centre.is_none()) {
      throw std::invalid_argument("centre_of_mass: must stand beside moment_of_inertia, which is about it");
    }
    set_mass(body, value);
    return;
  }
  Vector2 origin;
  if (centre.is_none()) {
    Body filled = body;
    filled.pose = {};
    set_density(filled, 1.0);
    origin = filled.pose.position;
  } else {
    origin = as_vector2(k_coordinate_range, centre, "centre_of_mass");
  }
  move_origin(body, origin);
  body.mass = value;
  body.moment_of_inertia = as_number_in(k_inertia_range, inertia, "moment_of_inertia");
}

// Knots as tuples (time, position or None, angle or None): None is that of the knot before, first that of the body.
void read_motion(const BodyFields& fields, Body& body) {
  const py::object motion = fields.find("motion");
  if (motion.is_none()) return;
  Pose last = body.pose;
  for (const py::handle object : motion) {
    const auto knot = py::reinterpret_borrow<py::tuple>(object);
    const std::string place = tumble::format("motion[{}].", body.motion.size());
    if (!knot[1].is_none()) last.position = as_vector2(k_coordinate_range, knot[1], place + "position");
    if (!knot[2].is_none()) last.angle = as_angle(knot[2], place + "angle");
    body.motion.push_back({as_number(knot[0], (place + "time").c_str()), last});
  }
  // A body without a pose of its own starts at its first knot.
  if (body.motion.empty()) return;
  const Pose& first = body.motion.front().pose;
  if (fields.find("position").is_none()) body.pose.position = first.position;
  if (fields.find("angle").is_none()) body.pose.angle = first.angle;
}

// Wrenches as tuples (time, force, torque).
void read_wrenches(const BodyFields& fields, Body& body) {
  const py::object wrenches = fields.find("wrenches");
  if (wrenches.is_none()) return;
  for (const py::handle object : wrenches) {
    const auto wrench = py::reinterpret_borrow<py::tuple>(object);
    const std::string place = tumble::format("wrenches[{}].", body.wrenches.size());
    body.wrenches.push_back({as_number(wrench[0], (place + "time").c_str()),
                             as_vector2(k_force_range, wrench[1], place + "force"),
                             as_number(wrench[2], (place + "torque").c_str())});
  }
}

BodyKind as_kind(const std::string& word) {
  for (const BodyKind kind : {BodyKind::dynamic, BodyKind::kinematic}) {
    if (word == to_string(kind)) return kind;
  }
  return BodyKind::fixed;
}

Body as_body(SceneHandle& handle, const std::string& kind, const py::list& parts, const py::dict& dict) {
  const BodyFields fields{dict};
  Body body;
  const py::object name = fields.find("name");
  if (!name.is_none()) body.name = as_text(name, "name");
  check_name("name", body.name, k_max_name_bytes);
  if (!body.name.empty() && handle.bodies.count(body.name) > 0) {
    throw std::invalid_argument(tumble::format("name: must differ from the bodies before, got {}", shown(body.name)));
  }
  body.kind = as_kind(kind);
  const py::object position = fields.find("position"), angle = fields.find("angle");
  if (!position.is_none()) body.pose.position = as_vector2(k_coordinate_range, position, "position");
  if (!angle.is_none()) body.pose.angle = as_angle(angle, "angle");
  require_count("parts", parts.size(), 1, k_max_parts);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string place = parts.size() == 1 ? "" : tumble::format("parts[{}].", i);
    body.parts.push_back(as_part(handle, parts[i], fields, place));
  }
  if (body.kind == BodyKind::dynamic) read_mass(fields, body);
  const py::object velocity = fields.find("velocity");
  if (!velocity.is_none()) {
    const Vector2 v = as_vector2(k_speed_range, velocity, "velocity");
    body.velocity = {v.x, v.y, 0.0};
  }
  const py::object spin = fields.find("angular_velocity");
  if (!spin.is_none()) body.velocity[2] = as_number_in(k_angular_velocity_range, spin, "angular_velocity");
  body.linear_damping = fields.number_or("linear_damping", 0.0);
  body.angular_damping = fields.number_or("angular_damping", 0.0);
  read_motion(fields, body);
  read_wrenches(fields, body);
  return body;
}

int add_body(SceneHandle& handle, const std::string& kind, const py::list& parts, const py::dict& fields) {
  const std::size_t num_materials = handle.scene.materials.size();
  try {
    if (handle.scene.bodies.size() == k_max_bodies) {
      throw std::invalid_argument(tumble::format("bodies: a scene has at most {}", k_max_bodies));
    }
    Body body = as_body(handle, kind, parts, fields);
    check_body(body, handle.scene.materials.size());
    const auto index = static_cast<int>(handle.scene.bodies.size());
    if (!body.name.empty()) handle.bodies[body.name] = index;
    handle.scene.bodies.push_back(std::move(body));
    return index;
  } catch (...) {
    // A body that is refused leaves no material behind.
    if (handle.scene.materials.size() > num_materials) {
      handle.scene.materials.pop_back();
      handle.materials.erase(handle.materials.find(k_default_material));
    }
    throw;
  }
}

py::dict body_dict(const SceneHandle& handle, int index) {
  const Body& body = handle.scene.bodies.at(static_cast<std::size_t>(index));
  py::list parts, motion, wrenches;
  for (const Part& part : body.parts) {
    const std::string& material = handle.scene.materials[static_cast<std::size_t>(part.material)].name;
    parts.append(py::make_tuple(to_python(part.shape), material, part.surface_speed));
  }
  for (const Knot& knot : body.motion) {
    motion.append(py::make_tuple(knot.time, to_tuple(knot.pose.position), knot.pose.angle));
  }
  for (const Wrench& wrench : body.wrenches) {
    wrenches.append(py::make_tuple(wrench.time, to_tuple(wrench.force), wrench.torque));
  }
  return py::dict("name"_a = body.name, "kind"_a = py::str(to_string(body.kind)), "parts"_a = parts,
                  "mass"_a = body.mass, "moment_of_inertia"_a = body.moment_of_inertia,
                  "position"_a = to_tuple(body.pose.position), "angle"_a = body.pose.angle,
                  "velocity"_a = py::make_tuple(body.velocity[0], body.velocity[1]),
                  "angular_velocity"_a = body.velocity[2], "motion"_a = motion, "wrenches"_a = wrenches,
                  "linear_damping"_a = body.linear_damping, "angular_damping"_a = body.angular_damping);
}

py::tuple law_tuple(const ContactLaw& law) {
  return py::make_tuple(law.friction, law.static_friction, law.restitution);
}

SceneHandle parse(const py::bytes& text, const py::handle& name_object) {
  const auto view = static_cast<std::string_view>(text);
  const std::string name = as_text(name_object, "name");
  const py::gil_scoped_release without_gil;
  return handle_of(parse_scene(view, name));
}

py::list check(const SceneHandle& handle) {
  const std::vector<std::string> labels = body_labels(handle.scene);
  py::list lines;
  for (const SceneWarning& warning : scene_warnings(handle.scene)) {
    lines.append(to_text(warning, handle.scene, labels));
  }
  return lines;
}

void set_title(SceneHandle& handle, const py::handle& object) {
  std::string title = as_text(object, "title");
  check_name("title", title, k_max_title_bytes);
  handle.scene.title = std::move(title);
}

}  // namespace

SceneHandle handle_of(Scene scene) {
  SceneHandle handle{std::move(scene), {}, {}};
  handle.materials = names_of(handle.scene.materials);
  handle.bodies = names_of(handle.scene.bodies);
  return handle;
}

int SceneHandle::find_body(const py::handle& object) const {
  const auto count = static_cast<long>(scene.bodies.size());
  if (py::isinstance<py::str>(object)) {
    const std::string name = as_text(object, "body");
    const auto found = bodies.find(name);
    if (found == bodies.end()) refuse_unknown("body", "body", name, bodies);
    return found->second;
  }
  if (!PyIndex_Check(object.ptr()) || PyBool_Check(object.ptr())) {
    throw py::type_error(tumble::format("body: must be a name or an index, got {}", short_repr(object)));
  }
  const long index = PyLong_AsLong(object.ptr());
  const bool is_too_large = PyErr_Occurred() != nullptr;
  PyErr_Clear();
  if (is_too_large || index < -count || index >= count) {
    throw py::index_error(tumble::format("body: must be in [{}, {}], got {}", -count, count - 1, short_repr(object)));
  }
  return static_cast<int>(index < 0 ? index + count : index);
}

int SceneHandle::find_material(const py::handle& object, const std::string& field) const {
  const std::string name = as_text(object, field.c_str());
  const auto found = materials.find(name);
  if (found == materials.end()) refuse_unknown(field, "material", name, materials);
  return found->second;
}

void bind_scene(py::module_& module) {
  py::class_<SceneHandle>(module, "Scene")
      .def(py::init([] { return SceneHandle{}; }))
      .def_static("parse", &parse, "text"_a, "name"_a)
      .def("to_toml", [](const SceneHandle& handle) { return to_toml(handle.scene); })
      .def("check", &check)
      .def("copy", [](const SceneHandle& handle) { return handle; })
      .def("add_material", &add_material, "name"_a, "friction"_a, "static_friction"_a, "restitution"_a)
      .def("add_pair", &add_pair, "a"_a, "b"_a, "friction"_a, "static_friction"_a, "restitution"_a)
      .def("add_body", &add_body, "kind"_a, "parts"_a, "fields"_a)
      .def("body", &body_dict, "index"_a)
      .def("find_body", &SceneHandle::find_body, "body"_a)
      .def("law",
           [](const SceneHandle& handle, const py::object& a, const py::object& b) {
             return law_tuple(contact_law(handle.scene, handle.find_material(a, "a"), handle.find_material(b, "b")));
           })
      .def("materials",
           [](const SceneHandle& handle) {
             py::list materials;
             for (const Material& m : handle.scene.materials) {
               materials.append(py::make_tuple(m.name) + law_tuple(m.law));
             }
             return materials;
           })
      .def("__len__", [](const SceneHandle& handle) { return handle.scene.bodies.size(); })
      .def("__eq__", [](const SceneHandle& a, const SceneHandle& b) { return a.scene == b.scene; })
      .def_property(
          "title", [](const SceneHandle& handle) { return handle.scene.title; }, &set_title)
      .def_property(
          "gravity", [](const SceneHandle& handle) { return to_tuple(handle.scene.gravity); },
          [](SceneHandle& handle, const py::object& value) {
            handle.scene.gravity = as_vector2(k_gravity_range, value, "gravity");
          })
      .def_property(
          "step_size", [](const SceneHandle& handle) { return handle.scene.step_size; },
          [](SceneHandle& handle, const py::object& value) {
            handle.scene.step_size = as_number_in(k_step_size_range, value, "step_size");
          })
      .def_property(
          "duration", [](const SceneHandle& handle) { return handle.scene.duration; },
          [](SceneHandle& handle, const py::object& value) {
            handle.scene.duration = as_number_in(k_duration_range, value, "duration");
          });
  module.attr("MAX_SCENE_BYTES") = k_max_scene_bytes;
}

}  // namespace tumble::python
