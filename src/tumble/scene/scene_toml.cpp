// The reading half of scene_toml.hpp: shapes, then bodies, then the scene.
#include "tumble/scene/scene_toml.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "tumble/math/format.hpp"
#include "tumble/scene/check.hpp"
#include "tumble/scene/toml_reader.hpp"

namespace tumble {
namespace {

using toml_reading::Value;

Pose read_pose(const Value& table, const Pose& otherwise) {
  return {table.vector_or("position", k_coordinate_range, otherwise.position),
          table.angle_or("angle", otherwise.angle)};
}

HalfPlane read_half_plane(const Value& table, const Value& value) {
  const Vector2 normal = value.vector(k_coordinate_range);
  if (length(normal) < k_size_range.low) value.refuse_with("must be a vector other than 0");
  return half_plane(normal, table.number_or("offset", k_coordinate_range, 0.0));
}

// The shape that the key of `table` names, within the frame of the shape.
Shape build_shape(const Value& table, const std::string& key, double rounding) {
  const Value value = table.at(key);
  if (key == "square") return square(value.number(k_size_range), rounding);
  if (key == "disc") return disc(value.number(k_size_range));
  if (key == "polygon") return RoundedPolygon{value.points(1, k_max_vertices), rounding};
  if (key == "segment") return RoundedPolygon{value.points(2, 2), 0.0};
  if (key == "terrain") return Terrain{value.points(2, k_max_terrain_points)};
  if (key == "half_plane") return read_half_plane(table, value);
  if (key == "regular") {
    const std::vector<Value> pair = value.list(2, 2);
    const auto corners = static_cast<int>(pair[0].integer(3, static_cast<std::int64_t>(k_max_vertices)));
    return regular_polygon(corners, pair[1].number(k_size_range), rounding);
  }
  const Vector2 sizes = value.vector(k_size_range);
  if (key == "rectangle") return rectangle(sizes.x, sizes.y, rounding);
  if (key == "ellipse") return ellipse(sizes.x, sizes.y);
  return capsule(sizes.x, sizes.y);
}

Shape read_shape(const Value& table) {
  table.allow_keys({"square", "rectangle", "regular", "disc", "ellipse", "capsule", "polygon", "segment", "half_plane",
                    "terrain", "rounding", "offset"});
  std::string key;
  for (const auto& [word, value] : table.entries()) {
    if (word == "rounding" || word == "offset") continue;
    if (!key.empty()) value.refuse_with(tumble::format("must not stand beside {}: a shape is one thing", key));
    key = word;
  }
  if (key.empty()) table.refuse_with("must say what it is, like { square = 0.2 }");
  const std::optional<Value> rounding = table.find("rounding");
  if (rounding && key != "square" && key != "rectangle" && key != "regular" && key != "polygon") {
    rounding->refuse_with(tumble::format("only square, rectangle, regular and polygon have one, got it for {}", key));
  }
  const std::optional<Value> offset = table.find("offset");
  if (offset && key != "half_plane") offset->refuse_with(tumble::format("only half_plane has one, got it for {}", key));
  const double width = rounding ? rounding->number(k_rounding_range) : 0.0;
  return table.checked([&] {
    Shape shape = build_shape(table, key, width);
    validate(shape);
    return shape;
  });
}

Shape placed(Shape shape, const Pose& pose) {
  // What `to_toml` writes with a position keeps every bit, signs of zeros included.
  if (auto* round = std::get_if<Ellipse>(&shape)) {
    round->pose = pose;
    return shape;
  }
  auto* polygon = std::get_if<RoundedPolygon>(&shape);
  if (polygon != nullptr && polygon->vertices.size() == 1 && polygon->vertices[0] == Vector2{}) {
    polygon->vertices[0] = pose.position;
    return shape;
  }
  return pose.position == Vector2{} && pose.angle == 0.0 ? shape : moved(shape, pose);
}

std::size_t point_count(const Shape& shape) {
  if (const auto* polygon = std::get_if<RoundedPolygon>(&shape)) return polygon->vertices.size();
  if (const auto* terrain = std::get_if<Terrain>(&shape)) return terrain->points.size();
  return 0;
}

BodyKind read_kind(const Value& table) {
  const std::optional<Value> value = table.find("kind");
  if (!value) return BodyKind::dynamic;
  const std::string word = value->text();
  std::vector<std::string_view> words;
  for (const BodyKind kind : {BodyKind::dynamic, BodyKind::kinematic, BodyKind::fixed}) {
    if (word == to_string(kind)) return kind;
    words.push_back(to_string(kind));
  }
  value->refuse_with(tumble::format("must be the kind of a body, got {}{}", shown(word), suggestion(word, words)));
}

void refuse_keys(const Value& table, std::initializer_list<std::string_view> keys, std::string_view owners,
                 BodyKind kind) {
  for (const std::string_view key : keys) {
    const std::optional<Value> value = table.find(key);
    if (value)
      value->refuse_with(tumble::format("only {} bodies have one, got it for a {} one", owners, to_string(kind)));
  }
}

Vector2 centroid(const Value& table, const Body& body) {
  Body filled = body;
  filled.pose = {};
  table.checked([&] { set_density(filled, 1.0); }, ": ");
  return filled.pose.position;
}

// Mass, moment of inertia, and the origin of the frame at the centre of mass.
void read_mass(const Value& table, Body& body) {
  const std::optional<Value> density = table.find("density");
  const std::optional<Value> mass = table.find("mass");
  const std::optional<Value> inertia = table.find("moment_of_inertia");
  const std::optional<Value> centre = table.find("centre_of_mass");
  if (!density && !mass) table.refuse_with("a dynamic body must have the key 'density' or the key 'mass'");
  if (density) {
    for (const auto& other : {mass, inertia, centre}) {
      if (other) other->refuse_with("must not stand beside density, which gives it");
    }
    const double value = density->number(k_density_range);
    table.checked([&] { set_density(body, value); }, ": ");
    return;
  }
  body.mass = mass->number(k_mass_range);
  if (inertia) {
    body.moment_of_inertia = inertia->number(k_inertia_range);
    move_origin(body, centre ? centre->vector(k_coordinate_range) : centroid(table, body));
    return;
  }
  if (centre) centre->refuse_with("must stand beside moment_of_inertia, which is about it");
  table.checked([&] { set_mass(body, body.mass); }, ": ");
}

template <class Entry>
void check_later(const Value& value, const std::vector<Entry>& entries) {
  const std::size_t n = entries.size();
  if (n < 2 || entries[n - 1].time > entries[n - 2].time) return;
  value.refuse_with(tumble::format("time: must be later than {} s, that of the entry before, got {}",
                                   entries[n - 2].time, entries[n - 1].time));
}

void read_motion(const Value& table, Body& body) {
  Pose last = body.pose;
  for (const Value& entry : table.list_or_none("motion", k_max_table_entries)) {
    entry.allow_keys({"time", "position", "angle"});
    last = read_pose(entry, last);
    body.motion.push_back({entry.at("time").number(k_time_range), last});
    check_later(entry, body.motion);
  }
  // A body without a pose of its own starts at its first knot.
  if (body.motion.empty()) return;
  const Pose& first = body.motion.front().pose;
  if (!table.find("position")) body.pose.position = first.position;
  if (!table.find("angle")) body.pose.angle = first.angle;
}

void read_wrenches(const Value& table, Body& body) {
  for (const Value& entry : table.list_or_none("wrenches", k_max_table_entries)) {
    entry.allow_keys({"time", "force", "torque"});
    body.wrenches.push_back({entry.number_or("time", k_time_range, 0.0), entry.vector_or("force", k_force_range, {}),
                             entry.number_or("torque", k_torque_range, 0.0)});
    check_later(entry, body.wrenches);
  }
}

ContactLaw read_law(const Value& table, ContactLaw law) {
  law.friction = table.number_or("friction", k_friction_range, law.friction);
  if (table.find("friction")) law.static_friction = law.friction;
  law.static_friction = table.number_or("static_friction", k_friction_range, law.static_friction);
  law.restitution = table.number_or("restitution", k_restitution_range, law.restitution);
  table.checked([&] { check_law(law); });
  return law;
}

// What copies of a body are apart.
struct Row {
  std::size_t count = 1;
  Vector2 step;
};

std::vector<Row> read_copies(const Value& body) {
  const std::optional<Value> value = body.find("copies");
  if (!value) return {};
  constexpr std::size_t max_rows = 2;
  std::vector<Row> rows;
  for (const Value& table : value->is_list() ? value->list(1, max_rows) : std::vector<Value>{*value}) {
    table.allow_keys({"count", "step"});
    const std::int64_t count = table.at("count").integer(1, static_cast<std::int64_t>(k_max_bodies));
    rows.push_back({static_cast<std::size_t>(count), table.at("step").vector(k_coordinate_range)});
  }
  return rows;
}

void shift(Body& body, Vector2 by) {
  body.pose.position = body.pose.position + by;
  for (Knot& knot : body.motion) knot.pose.position = knot.pose.position + by;
}

// Keeps what is read so far, for names and sums.
class SceneReader {
 public:
  Scene read(const Value& root) {
    root.allow_keys({"tumble", "title", "gravity", "step_size", "duration", "materials", "pairs", "bodies"});
    root.at("tumble").integer(1, 1);
    scene_.title = read_name(root, "title", k_max_title_bytes);
    scene_.gravity = root.vector_or("gravity", k_gravity_range, scene_.gravity);
    scene_.step_size = root.number_or("step_size", k_step_size_range, scene_.step_size);
    scene_.duration = root.number_or("duration", k_duration_range, scene_.duration);
    read_materials(root);
    read_pairs(root);
    for (const Value& body : root.list_or_none("bodies", k_max_bodies)) read_bodies(body);
    root.checked([&] { validate(scene_); });
    return std::move(scene_);
  }

 private:
  static std::string read_name(const Value& table, std::string_view key, std::size_t max_bytes) {
    const std::optional<Value> value = table.find(key);
    if (!value) return "";
    std::string name = value->text();
    value->checked([&] { check_name("", name, max_bytes); }, "");
    return name;
  }

  int add_material(const std::string& name, const ContactLaw& law) {
    const auto index = static_cast<int>(scene_.materials.size());
    scene_.materials.push_back({name, law});
    material_index_[name] = index;
    return index;
  }

  void read_materials(const Value& root) {
    const std::optional<Value> materials = root.find("materials");
    if (!materials) return;
    for (const auto& [name, table] : materials->entries()) {
      if (name.empty()) table.refuse_with("a material must have a name");
      const std::string& key = name;
      table.checked([&] { check_name("", key, k_max_name_bytes); }, "");
      table.allow_keys({"friction", "static_friction", "restitution"});
      if (scene_.materials.size() == k_max_materials) {
        table.refuse_with(tumble::format("at most {} materials are read", k_max_materials));
      }
      add_material(name, read_law(table, {}));
    }
  }

  int find_material(const Value& value) const {
    const std::string name = value.text();
    const auto found = material_index_.find(name);
    if (found != material_index_.end()) return found->second;
    std::vector<std::string_view> names;
    for (const Material& material : scene_.materials) names.push_back(material.name);
    value.refuse_with(tumble::format("must be the name of a material, got {}{}", shown(name), suggestion(name, names)));
  }

  void read_pairs(const Value& root) {
    std::set<std::pair<int, int>> seen;
    std::vector<MaterialPair> pairs;
    for (const Value& table : root.list_or_none("pairs", k_max_pairs)) {
      table.allow_keys({"materials", "friction", "static_friction", "restitution"});
      const std::vector<Value> names = table.at("materials").list(2, 2);
      MaterialPair pair{find_material(names[0]), find_material(names[1]), {}};
      if (pair.a == pair.b) names[1].refuse_with("must be another material than the first");
      if (!seen.insert(std::minmax(pair.a, pair.b)).second) table.refuse_with("these two are a pair already");
      pair.law = read_law(table, contact_law(scene_, pair.a, pair.b));  // mixed: scene_ has no pairs yet
      pairs.push_back(pair);
    }
    scene_.pairs = std::move(pairs);
  }

  Part read_part(const Value& table, const Value& body, const Pose& pose) {
    Part part;
    const Value shape = table.at("shape");
    part.shape = placed(read_shape(shape), pose);
    std::optional<Value> material = table.find("material");
    if (!material) material = body.find("material");
    const auto found = material_index_.find(std::string(k_default_material));
    if (material) {
      part.material = find_material(*material);
    } else {
      part.material =
          found != material_index_.end() ? found->second : add_material(std::string(k_default_material), {});
    }
    part.surface_speed = body.number_or("surface_speed", k_speed_range, 0.0);
    part.surface_speed = table.number_or("surface_speed", k_speed_range, part.surface_speed);
    count_entries(shape, 1 + point_count(part.shape));
    return part;
  }

  void read_parts(const Value& table, Body& body) {
    const std::optional<Value> parts = table.find("parts");
    if (!parts) {
      if (!table.find("shape")) table.refuse_with("a body must have the key 'shape' or the key 'parts'");
      body.parts.push_back(read_part(table, table, {}));
      return;
    }
    if (table.find("shape")) parts->refuse_with("must not stand beside shape");
    for (const Value& entry : parts->list(1, k_max_parts)) {
      entry.allow_keys({"shape", "position", "angle", "material", "surface_speed"});
      body.parts.push_back(read_part(entry, table, read_pose(entry, {})));
    }
  }

  Body read_body(const Value& table) {
    table.allow_keys({"name", "kind", "shape", "parts", "position", "angle", "velocity", "angular_velocity", "material",
                      "surface_speed", "density", "mass", "moment_of_inertia", "centre_of_mass", "linear_damping",
                      "angular_damping", "motion", "wrenches", "copies"});
    Body body;
    body.name = read_name(table, "name", k_max_name_bytes);
    body.kind = read_kind(table);
    body.pose = read_pose(table, {});
    read_parts(table, body);
    if (body.kind == BodyKind::dynamic) {
      read_mass(table, body);
    } else {
      refuse_keys(
          table,
          {"density", "mass", "moment_of_inertia", "centre_of_mass", "wrenches", "linear_damping", "angular_damping"},
          "dynamic", body.kind);
    }
    if (body.kind == BodyKind::fixed) refuse_keys(table, {"velocity", "angular_velocity"}, "moving", body.kind);
    if (body.kind != BodyKind::kinematic) refuse_keys(table, {"motion"}, "kinematic", body.kind);
    // Of the centre of mass, so read once the origin is there.
    const Vector2 velocity = table.vector_or("velocity", k_speed_range, {});
    body.velocity = {velocity.x, velocity.y, table.number_or("angular_velocity", k_angular_velocity_range, 0.0)};
    body.linear_damping = table.number_or("linear_damping", k_damping_range, 0.0);
    body.angular_damping = table.number_or("angular_damping", k_damping_range, 0.0);
    read_motion(table, body);
    read_wrenches(table, body);
    count_entries(table, body.motion.size() + body.wrenches.size());
    table.checked([&] { check_body(body, scene_.materials.size()); });
    return body;
  }

  void read_bodies(const Value& table) {
    const std::size_t entries_before = entries_;
    const Body body = read_body(table);
    const std::vector<Row> rows = read_copies(table);
    const Row inner = rows.empty() ? Row{} : rows[0];
    const Row outer = rows.size() < 2 ? Row{} : rows[1];
    const std::size_t count = inner.count * outer.count;  // below 1e10
    if (count > k_max_bodies - scene_.bodies.size()) {
      table.refuse_with(tumble::format("a scene has at most {} bodies", k_max_bodies));
    }
    count_entries(table, (count - 1) * (entries_ - entries_before));
    for (std::size_t k = 0; k < count; ++k) {
      Body copy = body;
      if (!rows.empty()) {
        const auto times = [](std::size_t i, Vector2 step) { return static_cast<double>(i) * step; };
        shift(copy, times(k % inner.count, inner.step) + times(k / inner.count, outer.step));
        if (!copy.name.empty()) copy.name += std::to_string(k + 1);
      }
      if (!copy.name.empty() && !body_names_.insert(copy.name).second) {
        table.refuse_with(tumble::format("name: must differ from those before, got {}", shown(copy.name)));
      }
      scene_.bodies.push_back(std::move(copy));
    }
  }

  // Vertices, knots and the like of all bodies, which copies multiply.
  void count_entries(const Value& value, std::size_t entries) {
    entries_ += entries;
    if (entries_ <= k_max_entries) return;
    value.refuse_with(
        tumble::format("a scene has at most {} vertices, points, parts, knots and wrenches", k_max_entries));
  }

  Scene scene_;
  std::map<std::string, int> material_index_;
  std::set<std::string> body_names_;
  std::size_t entries_ = 0;
};

}  // namespace

Scene parse_scene(std::string_view text, const std::string& name) {
  const toml::table root = toml_reading::parse_table(text, name);
  return SceneReader().read(Value(root, "", name));
}

}  // namespace tumble
