// The writing half of scene_toml.hpp.
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "tumble/math/format.hpp"
#include "tumble/math/numeric.hpp"
#include "tumble/scene/scene_toml.hpp"

namespace tumble {
namespace {

// Keeps the sign of zero, which the integer -0 would lose.
std::string number(double value) { return value == 0.0 && std::signbit(value) ? "-0.0" : to_text(value); }

std::string vector(Vector2 v) { return tumble::format("[{}, {}]", number(v.x), number(v.y)); }

std::string points(const std::vector<Vector2>& list) {
  std::string text = "[";
  for (const Vector2 point : list) text += (text.size() > 1 ? ", " : "") + vector(point);
  return text + "]";
}

// Names hold no control characters.
std::string quoted(std::string_view name) {
  std::string text = "\"";
  for (const char c : name) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + "\"";
}

std::string key(std::string_view name) {
  const bool is_bare = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return is_bare ? std::string(name) : quoted(name);
}

bool is_zero(double value) { return value == 0.0 && !std::signbit(value); }
bool is_zero(Vector2 v) { return is_zero(v.x) && is_zero(v.y); }

std::string pose_text(const Pose& pose) {
  std::string text;
  if (!is_zero(pose.position)) text += ", position = " + vector(pose.position);
  if (!is_zero(pose.angle)) text += ", angle = " + number(pose.angle);
  return text;
}

// The table of the shape, and what stands beside it.
std::string shape_text(const RoundedPolygon& polygon) {
  const std::vector<Vector2>& vertices = polygon.vertices;
  if (vertices.size() == 1)
    return tumble::format("{{ disc = {} }}", number(polygon.rounding)) + pose_text({vertices[0]});
  if (vertices.size() == 2 && polygon.rounding == 0.0) return tumble::format("{{ segment = {} }}", points(vertices));
  const std::string rounding = is_zero(polygon.rounding) ? "" : ", rounding = " + number(polygon.rounding);
  if (vertices.size() == 4) {
    // Short where the short form gives the same bits.
    const double width = 2.0 * (vertices[2].x + polygon.rounding);
    const double height = 2.0 * (vertices[2].y + polygon.rounding);
    const double x = width / 2.0 - polygon.rounding;
    const double y = height / 2.0 - polygon.rounding;
    if (x > 0.0 && y > 0.0 && vertices == std::vector<Vector2>{{-x, -y}, {x, -y}, {x, y}, {-x, y}}) {
      return tumble::format("{{ rectangle = {}{} }}", vector({width, height}), rounding);
    }
  }
  return tumble::format("{{ polygon = {}{} }}", points(vertices), rounding);
}

std::string shape_text(const Ellipse& ellipse) {
  return tumble::format("{{ ellipse = {} }}", vector({ellipse.semi_axis_x, ellipse.semi_axis_y})) +
         pose_text(ellipse.pose);
}

std::string shape_text(const HalfPlane& half_plane) {
  return tumble::format("{{ half_plane = {}, offset = {} }}", vector(half_plane.normal), number(half_plane.offset));
}

std::string shape_text(const Terrain& terrain) { return tumble::format("{{ terrain = {} }}", points(terrain.points)); }

std::string part_text(const Scene& scene, const Part& part) {
  std::string text = "{ shape = " + std::visit([](const auto& shape) { return shape_text(shape); }, part.shape);
  text += ", material = " + quoted(scene.materials[static_cast<std::size_t>(part.material)].name);
  if (!is_zero(part.surface_speed)) text += ", surface_speed = " + number(part.surface_speed);
  return text + " }";
}

std::string law_text(const ContactLaw& law) {
  return tumble::format("friction = {}\nstatic_friction = {}\nrestitution = {}\n", number(law.friction),
                        number(law.static_friction), number(law.restitution));
}

void write_line(std::string& text, std::string_view field, double value) {
  if (!is_zero(value)) text += tumble::format("{} = {}\n", field, number(value));
}

std::string body_text(const Scene& scene, const Body& body) {
  std::string text = "\n[[bodies]]\n";
  if (!body.name.empty()) text += tumble::format("name = {}\n", quoted(body.name));
  text += tumble::format("kind = \"{}\"\n", to_string(body.kind));
  if (body.kind == BodyKind::dynamic) {
    text += tumble::format("mass = {}\nmoment_of_inertia = {}\ncentre_of_mass = [0, 0]\n", number(body.mass),
                           number(body.moment_of_inertia));
  }
  text += tumble::format("position = {}\n", vector(body.pose.position));
  write_line(text, "angle", body.pose.angle);
  const Vector2 velocity{body.velocity[0], body.velocity[1]};
  if (!is_zero(velocity)) text += tumble::format("velocity = {}\n", vector(velocity));
  write_line(text, "angular_velocity", body.velocity[2]);
  write_line(text, "linear_damping", body.linear_damping);
  write_line(text, "angular_damping", body.angular_damping);
  // Lists in brackets: a header per part or knot would make reading quadratic in the number of bodies.
  const auto write_list = [&](std::string_view field, const auto& entries, auto entry_text) {
    if (entries.empty()) return;
    text += tumble::format("{} = [\n", field);
    for (const auto& entry : entries) text += "  " + entry_text(entry) + ",\n";
    text += "]\n";
  };
  write_list("parts", body.parts, [&](const Part& part) { return part_text(scene, part); });
  write_list("motion", body.motion, [](const Knot& knot) {
    return tumble::format("{{ time = {}, position = {}, angle = {} }}", number(knot.time), vector(knot.pose.position),
                          number(knot.pose.angle));
  });
  write_list("wrenches", body.wrenches, [](const Wrench& wrench) {
    return tumble::format("{{ time = {}, force = {}, torque = {} }}", number(wrench.time), vector(wrench.force),
                          number(wrench.torque));
  });
  return text;
}

}  // namespace

std::string to_toml(const Scene& scene) {
  validate(scene);
  std::string text = "tumble = 1\n";
  if (!scene.title.empty()) text += tumble::format("title = {}\n", quoted(scene.title));
  text += tumble::format("gravity = {}\nstep_size = {}\nduration = {}\n", vector(scene.gravity),
                         number(scene.step_size), number(scene.duration));
  for (const Material& material : scene.materials) {
    text += tumble::format("\n[materials.{}]\n{}", key(material.name), law_text(material.law));
  }
  for (const MaterialPair& pair : scene.pairs) {
    const auto name = [&](int index) { return quoted(scene.materials[static_cast<std::size_t>(index)].name); };
    text += tumble::format("\n[[pairs]]\nmaterials = [{}, {}]\n{}", name(pair.a), name(pair.b), law_text(pair.law));
  }
  for (const Body& body : scene.bodies) text += body_text(scene, body);
  return text;
}

}  // namespace tumble
