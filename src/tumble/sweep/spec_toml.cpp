#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>

#include "tumble/drop/parameters.hpp"
#include "tumble/math/format.hpp"
#include "tumble/scene/scene_toml.hpp"
#include "tumble/scene/toml_reader.hpp"
#include "tumble/sweep/plan.hpp"
#include "tumble/sweep/spec.hpp"

namespace tumble::sweep {
namespace {

using toml_reading::Value;

// A quantity of the drop, with the document's value.
struct Known {
  std::string_view name;
  Range range;
  double otherwise;
};
constexpr double k_thirty_degrees = 0.52359877559829887;
constexpr drop::Parameters k_usual{};
constexpr std::array<Known, 6> k_start = {{{"x", k_coordinate_range, 0.0},
                                           {"y", k_coordinate_range, 1.5},
                                           {"theta", k_angle_range, k_thirty_degrees},
                                           {"vx", k_speed_range, 0.0},
                                           {"vy", k_speed_range, -0.2},
                                           {"omega", k_angular_velocity_range, 0.0}}};
constexpr std::array<Known, 7> k_parameters = {{{"l", k_size_range, k_usual.l},
                                                {"m", k_mass_range, k_usual.m},
                                                {"mu", k_friction_range, k_usual.mu},
                                                {"eps", k_restitution_range, k_usual.eps},
                                                {"dt", k_step_size_range, k_usual.dt},
                                                {"delta", k_rounding_range, k_usual.delta},
                                                {"g", k_gravity_range, k_usual.g}}};

// A quantity of a scene.
struct KnownTarget {
  std::string_view name;
  Range range;
  SceneTarget target;
};
using Kind = SceneTarget::Kind;
constexpr std::array<KnownTarget, 8> k_body_targets = {
    {{"x", k_coordinate_range, {Kind::pose, 0, 0}},
     {"y", k_coordinate_range, {Kind::pose, 0, 1}},
     {"theta", k_angle_range, {Kind::pose, 0, 2}},
     {"vx", k_speed_range, {Kind::velocity, 0, 0}},
     {"vy", k_speed_range, {Kind::velocity, 0, 1}},
     {"omega", k_angular_velocity_range, {Kind::velocity, 0, 2}},
     {"mass", k_mass_range, {Kind::varied, 0, 0, batch::Quantity::mass}},
     {"moment_of_inertia", k_inertia_range, {Kind::varied, 0, 0, batch::Quantity::moment_of_inertia}}}};
constexpr std::array<KnownTarget, 3> k_material_targets = {
    {{"friction", k_friction_range, {Kind::varied, 0, 0, batch::Quantity::friction}},
     {"static_friction", k_friction_range, {Kind::varied, 0, 0, batch::Quantity::static_friction}},
     {"restitution", k_restitution_range, {Kind::varied, 0, 0, batch::Quantity::restitution}}}};
constexpr std::array<KnownTarget, 2> k_gravity_targets = {
    {{"x", k_gravity_range, {Kind::varied, 0, 0, batch::Quantity::gravity_x}},
     {"y", k_gravity_range, {Kind::varied, 0, 0, batch::Quantity::gravity_y}}}};

double read_number(const Value& value, const Range& range) {
  return range.unit == k_angle_range.unit ? value.angle() : value.number(range);
}

Grid read_range(const Value& value, const Range& range) {
  const std::vector<Value> entries = value.list(3, 3);
  const double first = read_number(entries[0], range);
  const double last = read_number(entries[1], range);
  const auto count = static_cast<std::size_t>(entries[2].integer(2, static_cast<std::int64_t>(k_max_axis)));
  Grid grid;
  for (std::size_t k = 0; k < count; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(count - 1);
    grid.values.push_back(k + 1 == count ? last : first + share * (last - first));
  }
  return grid;
}

Grid read_list(const Value& value, const Range& range) {
  Grid grid;
  for (const Value& entry : value.list(1, k_max_axis)) grid.values.push_back(read_number(entry, range));
  return grid;
}

std::array<double, 2> read_ends(const Value& value, const Range& range) {
  const std::vector<Value> entries = value.list(2, 2);
  const std::array<double, 2> ends = {read_number(entries[0], range), read_number(entries[1], range)};
  if (ends[0] > ends[1]) value.refuse_with(tumble::format("must be [low, high], got [{}, {}]", ends[0], ends[1]));
  return ends;
}

Source read_source(const Value& value, const Range& range) {
  if (!value.is_table()) return Constant{read_number(value, range)};
  value.allow_keys({"range", "list", "uniform", "normal", "log_uniform"});
  const auto entries = value.entries();
  if (entries.size() != 1) {
    value.refuse_with(
        "must be a number or one of range, list, uniform, normal and log_uniform, like "
        "{ uniform = [0, 1] }");
  }
  const auto& [key, entry] = entries[0];
  if (key == "range") return read_range(entry, range);
  if (key == "list") return read_list(entry, range);
  if (key == "normal") {
    const std::vector<Value> pair = entry.list(2, 2);
    const double deviation = read_number(pair[1], range);
    if (deviation < 0.0) pair[1].refuse_with(tumble::format("a standard deviation must be >= 0, got {}", deviation));
    return Normal{read_number(pair[0], range), deviation};
  }
  const auto [low, high] = read_ends(entry, range);
  if (key == "uniform") return Uniform{low, high};
  if (low <= 0.0) entry.refuse_with(tumble::format("must have a low end > 0, got {}", low));
  return LogUniform{low, high};
}

bool is_constant(const Quantity& quantity) { return std::holds_alternative<Constant>(quantity.source); }

bool is_drawn(const Quantity& quantity) {
  return !is_constant(quantity) && !std::holds_alternative<Grid>(quantity.source);
}

// Printed on terminals, which would act on control characters.
std::string title(const Value& root) {
  const std::string text = root.text_or("title", "");
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      root.at("title").refuse_with("must have no control characters");
  }
  return text;
}

class SpecReader {
 public:
  Spec read(const Value& root, const ReadScene& read_scene) {
    const std::optional<Value> file = root.find("scene");
    if (file) {
      root.allow_keys({"sweep", "title", "seed", "samples", "chunk", "keep", "measures", "scene", "bodies", "materials",
                       "gravity"});
    } else {
      root.allow_keys(
          {"sweep", "title", "seed", "samples", "chunk", "keep", "measures", "scene", "start", "parameters"});
    }
    root.at("sweep").integer(1, 1);
    spec_.title = title(root);
    if (file) {
      read_model(*file, read_scene);
      read_scene_quantities(root);
    } else {
      for (const auto& [key, value] : root.entries()) {
        if (key == "start") read_quantities(value, k_start, 0);
        if (key == "parameters") read_quantities(value, k_parameters, k_start.size());
      }
      add_usual(k_start, 0);
      add_usual(k_parameters, k_start.size());
    }
    // Where constants stand in the text makes no difference.
    std::stable_sort(spec_.quantities.begin(), spec_.quantities.end(), [](const Quantity& a, const Quantity& b) {
      return is_constant(a) != is_constant(b) ? is_constant(b) : is_constant(a) && a.draw < b.draw;
    });
    if (const auto measures = root.find("measures")) read_measures(*measures);
    read_keep(root);
    read_counts(root);
    return spec_;
  }

 private:
  void read_quantities(const Value& table, std::span<const Known> known, std::uint64_t first_draw) {
    const bool has_steps = known.size() == k_parameters.size();
    if (has_steps) {
      table.allow_keys({"l", "m", "mu", "eps", "dt", "delta", "g", "steps"});
    } else {
      table.allow_keys({"x", "y", "theta", "vx", "vy", "omega"});
    }
    for (const auto& [key, value] : table.entries()) {
      if (key == "steps") {
        spec_.columns = static_cast<int>(value.integer(1, drop::k_max_columns - 1)) + 1;
        continue;
      }
      const auto found = std::find_if(known.begin(), known.end(), [&](const Known& k) { return k.name == key; });
      add(*found, read_source(value, found->range), first_draw + static_cast<std::uint64_t>(found - known.begin()));
    }
  }

  void add_usual(std::span<const Known> known, std::uint64_t first_draw) {
    for (const Known& one : known) {
      const auto has_name = [&](const Quantity& quantity) { return quantity.name == one.name; };
      if (std::none_of(spec_.quantities.begin(), spec_.quantities.end(), has_name)) {
        add(one, Constant{one.otherwise}, first_draw);
      }
      ++first_draw;
    }
  }

  void add(const Known& known, Source source, std::uint64_t draw) {
    spec_.quantities.push_back({std::string(known.name), std::string(known.range.unit), std::move(source), draw});
  }

  void read_model(const Value& file, const ReadScene& read_scene) {
    if (!read_scene) file.refuse_with("scenes cannot be read here");
    const std::string name = file.text();
    SceneModel model;
    model.text = read_scene(name);
    model.scene = parse_scene(model.text, name);
    bodies_ = batch::movable_bodies(model.scene);
    if (bodies_.empty()) file.refuse_with("must hold a body that moves");
    spec_.measures.rest_speed = batch::RolloutSettings{}.measures.rest_speed;
    spec_.scene = std::move(model);
  }

  // The index into bodies_ of that with this label.
  int body_index(const Value& place, const std::string& label) const {
    const std::vector<std::string> labels = body_labels(spec_.scene->scene);
    std::vector<std::string_view> known;
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      const std::string& name = labels[static_cast<std::size_t>(bodies_[k])];
      if (name == label) return static_cast<int>(k);
      known.push_back(name);
    }
    place.refuse_with(
        tumble::format("must be a body of the scene that moves, got {}{}", shown(label), suggestion(label, known)));
  }

  void read_scene_quantities(const Value& root) {
    for (const auto& [table, value] : root.entries()) {
      if (table == "bodies") {
        for (const auto& [name, body] : value.entries()) read_body(body, name);
      } else if (table == "materials") {
        for (const auto& [name, material] : value.entries()) read_material(material, name);
      } else if (table == "gravity") {
        value.allow_keys({"x", "y"});
        read_targets(value, "gravity", k_gravity_targets, 0, 0);
      }
    }
  }

  void read_body(const Value& table, const std::string& name) {
    table.allow_keys({"x", "y", "theta", "vx", "vy", "omega", "mass", "moment_of_inertia"});
    const int index = body_index(table, name);
    const int body = bodies_[static_cast<std::size_t>(index)];
    for (const std::string_view key : {"mass", "moment_of_inertia"}) {
      const std::optional<Value> value = table.find(key);
      if (value && spec_.scene->scene.bodies[static_cast<std::size_t>(body)].kind != BodyKind::dynamic) {
        value->refuse_with("only dynamic bodies have one");
      }
    }
    read_targets(table, "bodies." + name, k_body_targets, index, body);
  }

  void read_material(const Value& table, const std::string& name) {
    table.allow_keys({"friction", "static_friction", "restitution"});
    std::vector<std::string_view> known;
    const std::vector<Material>& materials = spec_.scene->scene.materials;
    for (std::size_t k = 0; k < materials.size(); ++k) {
      if (materials[k].name == name) {
        read_targets(table, "materials." + name, k_material_targets, 0, static_cast<int>(k));
        return;
      }
      known.push_back(materials[k].name);
    }
    table.refuse_with(
        tumble::format("must be a material of the scene, got {}{}", shown(name), suggestion(name, known)));
  }

  // `movable` is the index of start values, `index` that of what is varied.
  void read_targets(const Value& table, const std::string& prefix, std::span<const KnownTarget> known, int movable,
                    int index) {
    for (const auto& [key, value] : table.entries()) {
      const auto found = std::find_if(known.begin(), known.end(), [&](const KnownTarget& k) { return k.name == key; });
      SceneTarget target = found->target;
      target.index = target.kind == Kind::varied ? index : movable;
      spec_.quantities.push_back({prefix + "." + key, std::string(found->range.unit), read_source(value, found->range),
                                  spec_.quantities.size(), target});
    }
  }

  void read_measures(const Value& table) {
    if (spec_.scene) {
      table.allow_keys({"rest_speed", "region", "body"});
      if (const auto body = table.find("body")) spec_.scene->body = body_index(*body, body->text());
    } else {
      table.allow_keys({"rest_speed", "region"});
    }
    spec_.measures.rest_speed =
        table.number_or("rest_speed", {0.0, k_speed_range.high, k_speed_range.unit}, spec_.measures.rest_speed);
    const std::optional<Value> region = table.find("region");
    if (!region) return;
    const auto [low, high] = read_ends(*region, k_coordinate_range);
    spec_.measures.x_min = low;
    spec_.measures.x_max = high;
  }

  void read_keep(const Value& root) {
    const std::optional<Value> value = root.find("keep");
    if (!value) return;
    const std::string word = value->text();
    if (word != "columns" && word != "statistics") {
      value->refuse_with(tumble::format("must be 'columns' or 'statistics', got {}", shown(word)));
    }
    spec_.keep = word == "columns" ? Keep::columns : Keep::statistics;
  }

  static std::uint64_t count_or(const Value& root, std::string_view key, std::int64_t low, std::uint64_t high,
                                std::uint64_t otherwise) {
    const std::optional<Value> value = root.find(key);
    return value ? static_cast<std::uint64_t>(value->integer(low, static_cast<std::int64_t>(high))) : otherwise;
  }

  void read_counts(const Value& root) {
    spec_.seed = count_or(root, "seed", 0, std::numeric_limits<std::int64_t>::max(), spec_.seed);
    spec_.samples = count_or(root, "samples", 1, k_max_instances, spec_.samples);
    const std::uint64_t piece = spec_.scene ? k_scene_piece : k_piece;
    const std::uint64_t usual_chunk = spec_.keep == Keep::columns || spec_.scene ? piece : 16 * piece;
    spec_.chunk = count_or(root, "chunk", 1, k_max_chunk, usual_chunk);
    if (spec_.samples > 1 && std::none_of(spec_.quantities.begin(), spec_.quantities.end(), is_drawn)) {
      root.at("samples").refuse_with(tumble::format(
          "must be 1 where nothing is drawn (uniform, normal, log_uniform), as all would be the same; got {}",
          spec_.samples));
    }
    require_size(root);
  }

  void require_size(const Value& root) const {
    std::uint64_t cells = 1;
    for (const Axis& axis : axes_of(spec_)) {
      if (cells > k_max_instances / axis.values.size()) {
        root.refuse_with(
            tumble::format("{}: the axes must have at most {} cells, as a sweep has at most so many instances",
                           axis.name, k_max_instances));
      }
      cells *= axis.values.size();
    }
    if (spec_.samples > k_max_instances / cells) {
      root.at("samples").refuse_with(
          tumble::format("must be at most {} for {} cells, as a sweep has at most {} instances; got {}",
                         k_max_instances / cells, cells, k_max_instances, spec_.samples));
    }
    const std::uint64_t instances = spec_.samples * cells;
    const std::uint64_t least = (instances - 1) / k_max_chunks + 1;
    if (spec_.chunk >= least) return;
    const std::string why =
        tumble::format("must be at least {} for {} instances, got {}: a sweep has at most {} chunks", least, instances,
                       spec_.chunk, k_max_chunks);
    if (const auto chunk = root.find("chunk")) chunk->refuse_with(why);
    root.refuse_with("chunk: " + why);
  }

  Spec spec_;
  std::vector<int> bodies_;  // movable ones, indices into the scene
};

}  // namespace

Spec parse_spec(std::string_view text, const std::string& name, const ReadScene& read_scene) {
  const toml::table root = toml_reading::parse_table(text, name);
  Spec spec = SpecReader().read(Value(root, "", name), read_scene);
  spec.text = text;
  return spec;
}

}  // namespace tumble::sweep
