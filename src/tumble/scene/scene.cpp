#include "tumble/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "tumble/math/format.hpp"
#include "tumble/scene/check.hpp"

namespace tumble {
namespace {

[[noreturn]] void refuse(const std::string& text) { throw std::invalid_argument(text); }

// Calls `check`; its message gets the place in front.
template <class Check>
void check_at(const std::string& place, Check check) {
  try {
    check();
  } catch (const std::invalid_argument& error) {
    refuse(place + error.what());
  }
}

void require_vector_in(const Range& range, const std::string& field, Vector2 value) {
  require_in(range, field + ".x", value.x);
  require_in(range, field + ".y", value.y);
}

void check_pose(const std::string& field, const Pose& pose) {
  require_vector_in(k_coordinate_range, field + ".position", pose.position);
  require_in(k_angle_range, field + ".angle", pose.angle);
}

template <class Entry>
void check_times(const std::string& field, const std::vector<Entry>& entries) {
  require_count(field, entries.size(), 0, k_max_table_entries);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    require_in(k_time_range, tumble::format("{}[{}].time", field, i), entries[i].time);
    if (i == 0 || entries[i].time > entries[i - 1].time) continue;
    refuse(tumble::format("{}[{}].time: must be later than {} s, that of the entry before, got {}", field, i,
                          entries[i - 1].time, entries[i].time));
  }
}

void check_part(const Part& part, BodyKind kind, std::size_t material_count) {
  check_at("shape.", [&] { validate(part.shape); });
  if (part.material < 0 || static_cast<std::size_t>(part.material) >= material_count) {
    refuse(
        tumble::format("material: must be an index of one of the {} materials, got {}", material_count, part.material));
  }
  require_in(k_speed_range, "surface_speed", part.surface_speed);
  if (std::holds_alternative<HalfPlane>(part.shape) && kind != BodyKind::fixed) {
    refuse(tumble::format("shape: a half-plane must belong to a fixed body, got a {} one", to_string(kind)));
  }
  if (std::holds_alternative<Terrain>(part.shape) && kind == BodyKind::dynamic) {
    refuse("shape: terrain must belong to a fixed or kinematic body, got a dynamic one");
  }
}

void require_zero(bool is_zero, const char* field, const char* owner, BodyKind kind) {
  if (!is_zero) refuse(tumble::format("{}: only {} have one, got it for a {} one", field, owner, to_string(kind)));
}

// What the other kinds must not have: it would be ignored in silence.
void check_kind(const Body& body) {
  if (body.kind == BodyKind::dynamic) {
    require_in(k_mass_range, "mass", body.mass);
    require_in(k_inertia_range, "moment_of_inertia", body.moment_of_inertia);
  } else {
    constexpr const char* dynamic = "dynamic bodies";
    require_zero(body.mass == 0.0, "mass", dynamic, body.kind);
    require_zero(body.moment_of_inertia == 0.0, "moment_of_inertia", dynamic, body.kind);
    require_zero(body.wrenches.empty(), "wrenches", dynamic, body.kind);
    require_zero(body.linear_damping == 0.0, "linear_damping", dynamic, body.kind);
    require_zero(body.angular_damping == 0.0, "angular_damping", dynamic, body.kind);
  }
  const bool is_at_rest = body.velocity == Vector3{};
  if (body.kind == BodyKind::fixed && !is_at_rest) refuse("velocity: must be 0 for a fixed body");
  require_zero(body.kind == BodyKind::kinematic || body.motion.empty(), "motion", "kinematic bodies", body.kind);
  if (body.motion.empty()) return;
  if (!is_at_rest) refuse("velocity: must be 0 for a body with motion, whose knots give it");
  const Pose& first = body.motion.front().pose;
  if (first.position != body.pose.position || first.angle != body.pose.angle) {
    refuse(tumble::format(
        "motion[0]: must be at the pose of the body, ({}, {}) m and {} rad, got ({}, {}) m and {} rad",
        body.pose.position.x, body.pose.position.y, body.pose.angle, first.position.x, first.position.y, first.angle));
  }
}

std::string place_of(const Scene& scene, std::size_t body) {
  const std::string& name = scene.bodies[body].name;
  return tumble::format("bodies[{}]{}", body,
                        name.empty() || !is_plain_text(name) ? "" : tumble::format(" '{}'", name));
}

// Throws for two equal names; empty ones do not count. `name(i)` is that of entry i.
template <class NameOf>
void check_unique(const char* field, std::size_t count, NameOf name) {
  std::vector<std::pair<std::string_view, std::size_t>> names;
  for (std::size_t i = 0; i < count; ++i) {
    if (!name(i).empty()) names.push_back({name(i), i});
  }
  std::sort(names.begin(), names.end());
  for (std::size_t i = 1; i < names.size(); ++i) {
    if (names[i].first != names[i - 1].first) continue;
    refuse(tumble::format("{0}[{1}].name: must differ from that of {0}[{2}], got '{3}' twice", field, names[i].second,
                          names[i - 1].second, names[i].first));
  }
}

void check_materials(const Scene& scene) {
  require_count("materials", scene.materials.size(), 0, k_max_materials);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& material = scene.materials[i];
    check_at(tumble::format("materials[{}].", i), [&] {
      if (material.name.empty()) refuse("name: must not be empty");
      check_name("name", material.name, k_max_name_bytes);
      check_law(material.law);
    });
  }
  check_unique("materials", scene.materials.size(),
               [&](std::size_t i) -> const std::string& { return scene.materials[i].name; });
}

void check_pairs(const Scene& scene) {
  require_count("pairs", scene.pairs.size(), 0, k_max_pairs);
  const auto count = static_cast<int>(scene.materials.size());
  std::vector<std::pair<int, int>> seen;
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const MaterialPair& pair = scene.pairs[i];
    check_at(tumble::format("pairs[{}].", i), [&] {
      for (const auto& [field, index] : {std::pair{"a", pair.a}, std::pair{"b", pair.b}}) {
        if (index < 0 || index >= count) {
          refuse(tumble::format("{}: must be an index of one of the {} materials, got {}", field, count, index));
        }
      }
      if (pair.a == pair.b) refuse(tumble::format("b: must be another material than a, got {} twice", pair.a));
      check_law(pair.law);
    });
    seen.push_back(std::minmax({pair.a, pair.b}));
  }
  std::sort(seen.begin(), seen.end());
  const auto twice = std::adjacent_find(seen.begin(), seen.end());
  if (twice != seen.end()) {
    refuse(tumble::format("pairs: must name two materials once, got '{}' and '{}' twice",
                          scene.materials[static_cast<std::size_t>(twice->first)].name,
                          scene.materials[static_cast<std::size_t>(twice->second)].name));
  }
}

}  // namespace

std::string_view to_string(BodyKind kind) {
  switch (kind) {
    case BodyKind::dynamic: return "dynamic";
    case BodyKind::kinematic: return "kinematic";
    case BodyKind::fixed: return "fixed";
  }
  return "?";
}

ContactLaw contact_law(const Scene& scene, int material_a, int material_b) {
  const ContactLaw& a = scene.materials.at(static_cast<std::size_t>(material_a)).law;
  const ContactLaw& b = scene.materials.at(static_cast<std::size_t>(material_b)).law;
  if (material_a == material_b) return a;
  for (const MaterialPair& pair : scene.pairs) {
    if (std::minmax(pair.a, pair.b) == std::minmax(material_a, material_b)) return pair.law;
  }
  return {std::sqrt(a.friction * b.friction), std::sqrt(a.static_friction * b.static_friction),
          std::sqrt(a.restitution * b.restitution)};
}

bool is_plain_text(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u; };
    const unsigned first = byte(i);
    const std::size_t size = first < 0x80         ? 1
                             : first >> 5 == 0x6  ? 2
                             : first >> 4 == 0xe  ? 3
                             : first >> 3 == 0x1e ? 4
                                                  : 0;
    if (size == 0) return false;
    unsigned code = size == 1 ? first : first & (0x7fu >> size);
    for (std::size_t k = 1; k < size; ++k) {
      if (byte(i + k) >> 6 != 0x2) return false;
      code = code << 6 | (byte(i + k) & 0x3f);
    }
    constexpr unsigned least[] = {0, 0, 0x80, 0x800, 0x10000};  // shorter codes must be written shorter
    if (code < least[size] || code > 0x10ffff || (code >= 0xd800 && code <= 0xdfff)) return false;
    if (code < 0x20 || (code >= 0x7f && code <= 0x9f)) return false;
    i += size;
  }
  return true;
}

void check_name(std::string_view field, std::string_view name, std::size_t max_bytes) {
  if (name.size() > max_bytes) {
    refuse(tumble::format("{}: must have at most {} bytes, got {}", field, max_bytes, name.size()));
  }
  if (!is_plain_text(name)) refuse(tumble::format("{}: must be UTF-8 without control characters", field));
}

void check_law(const ContactLaw& law) {
  require_in(k_friction_range, "friction", law.friction);
  require_in(k_friction_range, "static_friction", law.static_friction);
  if (law.static_friction < law.friction) {
    refuse(
        tumble::format("static_friction: must be >= friction, which is {}, got {}", law.friction, law.static_friction));
  }
  require_in(k_restitution_range, "restitution", law.restitution);
}

void check_body(const Body& body, std::size_t material_count) {
  check_name("name", body.name, k_max_name_bytes);
  require_count("parts", body.parts.size(), 1, k_max_parts);
  for (std::size_t i = 0; i < body.parts.size(); ++i) {
    check_at(tumble::format("parts[{}].", i), [&] { check_part(body.parts[i], body.kind, material_count); });
  }
  check_pose("pose", body.pose);
  require_in(k_speed_range, "velocity[0]", body.velocity[0]);
  require_in(k_speed_range, "velocity[1]", body.velocity[1]);
  require_in(k_angular_velocity_range, "velocity[2]", body.velocity[2]);
  check_times("motion", body.motion);
  for (std::size_t i = 0; i < body.motion.size(); ++i) {
    check_pose(tumble::format("motion[{}].pose", i), body.motion[i].pose);
  }
  check_times("wrenches", body.wrenches);
  for (std::size_t i = 0; i < body.wrenches.size(); ++i) {
    require_vector_in(k_force_range, tumble::format("wrenches[{}].force", i), body.wrenches[i].force);
    require_in(k_torque_range, tumble::format("wrenches[{}].torque", i), body.wrenches[i].torque);
  }
  require_in(k_damping_range, "linear_damping", body.linear_damping);
  require_in(k_damping_range, "angular_damping", body.angular_damping);
  check_kind(body);
}

std::vector<std::string> body_labels(const Scene& scene) {
  std::set<std::string> taken;
  for (const Body& body : scene.bodies) taken.insert(body.name);
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    std::string label = scene.bodies[i].name;
    if (label.empty()) label = tumble::format("body{}", i);
    while (scene.bodies[i].name.empty() && taken.contains(label)) label += '_';
    labels.push_back(std::move(label));
  }
  return labels;
}

void validate(const Scene& scene) {
  check_name("title", scene.title, k_max_title_bytes);
  require_vector_in(k_gravity_range, "gravity", scene.gravity);
  require_in(k_step_size_range, "step_size", scene.step_size);
  require_in(k_duration_range, "duration", scene.duration);
  check_materials(scene);
  check_pairs(scene);
  require_count("bodies", scene.bodies.size(), 0, k_max_bodies);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    try {
      check_body(scene.bodies[i], scene.materials.size());
    } catch (const std::invalid_argument& error) {
      refuse(tumble::format("{}: {}", place_of(scene, i), error.what()));
    }
  }
  check_unique("bodies", scene.bodies.size(),
               [&](std::size_t i) -> const std::string& { return scene.bodies[i].name; });
}

MassProperties mass_properties(const std::vector<Part>& parts, double density) {
  require_in(k_density_range, "density", density);
  require_count("parts", parts.size(), 1, k_max_parts);
  std::vector<AreaMoments> moments;
  MassProperties sum;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    moments.push_back(area_moments(parts[i].shape));
    if (!(moments.back().area > 0.0)) {
      refuse(tumble::format("parts[{}].shape: must have an area to get a mass from a density, got one without", i));
    }
    sum.mass += density * moments.back().area;
  }
  // Relative to the first centroid: exact for one part.
  Vector2 offset;
  for (const AreaMoments& m : moments) {
    offset = offset + density * m.area / sum.mass * (m.centroid - moments.front().centroid);
  }
  sum.centre_of_mass = moments.front().centroid + offset;
  for (const AreaMoments& m : moments) {
    const Vector2 arm = m.centroid - sum.centre_of_mass;
    sum.moment_of_inertia += density * (m.polar_moment + m.area * dot(arm, arm));
  }
  return sum;
}

void move_origin(Body& body, Vector2 origin) {
  if (origin == Vector2{}) return;
  for (Part& part : body.parts) part.shape = moved(part.shape, {-origin, 0.0});
  const Vector2 arm = direction_to_world(frame_of(body.pose), origin);
  body.pose.position = body.pose.position + arm;
  body.velocity[0] -= body.velocity[2] * arm.y;
  body.velocity[1] += body.velocity[2] * arm.x;
  for (Knot& knot : body.motion) knot.pose.position = point_to_world(frame_of(knot.pose), origin);
}

void set_density(Body& body, double density) {
  const MassProperties filled = mass_properties(body.parts, density);
  body.mass = filled.mass;
  body.moment_of_inertia = filled.moment_of_inertia;
  // The radius of gyration stands for the size of the body; its sums round some ten times.
  constexpr double rounding = 1e-15;
  const double size = std::sqrt(filled.moment_of_inertia / filled.mass);
  if (length(filled.centre_of_mass) > rounding * size) move_origin(body, filled.centre_of_mass);
}

void set_mass(Body& body, double mass) {
  require_in(k_mass_range, "mass", mass);
  set_density(body, 1.0);
  body.moment_of_inertia *= mass / body.mass;
  body.mass = mass;
}

}  // namespace tumble
