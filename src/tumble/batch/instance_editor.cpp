#include "tumble/batch/instance_editor.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "tumble/math/format.hpp"
#include "tumble/scene/limits.hpp"

namespace tumble::batch {
namespace {

using Index = std::size_t;

enum class Owner { body, law, scene };

struct QuantityInfo {
  const char* name;
  Owner owner;
};

QuantityInfo info_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::mass: return {"mass", Owner::body};
    case Quantity::moment_of_inertia: return {"moment_of_inertia", Owner::body};
    case Quantity::friction: return {"friction", Owner::law};
    case Quantity::static_friction: return {"static_friction", Owner::law};
    case Quantity::restitution: return {"restitution", Owner::law};
    case Quantity::gravity_x: return {"gravity.x", Owner::scene};
    case Quantity::gravity_y: return {"gravity.y", Owner::scene};
  }
  throw std::invalid_argument("varied: must name a quantity");
}

bool is_in(const Range& range, double value) { return value >= range.low && value <= range.high; }

bool is_valid_law(const ContactLaw& law) {
  return is_in(k_friction_range, law.friction) && is_in(k_friction_range, law.static_friction) &&
         law.static_friction >= law.friction && is_in(k_restitution_range, law.restitution);
}

bool is_valid_start(const Body& body) {
  return is_in(k_coordinate_range, body.pose.position.x) && is_in(k_coordinate_range, body.pose.position.y) &&
         is_in(k_angle_range, body.pose.angle) && is_in(k_speed_range, body.velocity[0]) &&
         is_in(k_speed_range, body.velocity[1]) && is_in(k_angular_velocity_range, body.velocity[2]);
}

auto& law_at(auto& scene, int index) {
  const auto i = static_cast<Index>(index), num_materials = scene.materials.size();
  return i < num_materials ? scene.materials[i].law : scene.pairs[i - num_materials].law;
}

bool is_common(const Varied& varied) { return varied.values.size() == 1; }

void require_length(const std::string& name, Index length, Index count, Index width) {
  if (length == count * width || length == width) return;
  throw std::invalid_argument(tumble::format("{}: must have {} x {} numbers, or {} for all instances, got {}", name,
                                             count, width, width, length));
}

}  // namespace

std::vector<int> movable_bodies(const Scene& scene) {
  std::vector<int> movable;
  for (Index i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    const bool is_free = body.kind == BodyKind::kinematic && body.motion.empty();
    if (body.kind == BodyKind::dynamic || is_free) movable.push_back(static_cast<int>(i));
  }
  return movable;
}

InstanceEditor::InstanceEditor(const Scene& scene, const Instances& instances)
    : scene_(scene),
      instances_(instances),
      bodies_(movable_bodies(scene)),
      width_(bodies_.size() * 3),
      varied_(instances.varied) {
  if (!instances.pose.empty()) require_length("pose", instances.pose.size(), instances.count, width_);
  if (!instances.velocity.empty()) require_length("velocity", instances.velocity.size(), instances.count, width_);
  // Friction before static friction, mass before moment of inertia, which take the place of what the former set.
  const auto key = [](const Varied& v) { return std::pair(v.quantity, v.index); };
  std::sort(varied_.begin(), varied_.end(), [&](auto& a, auto& b) { return key(a) < key(b); });
  for (Index k = 0; k < varied_.size(); ++k) {
    const Varied& varied = varied_[k];
    check_varied(varied);
    if (k > 0 && key(varied_[k - 1]) == key(varied)) {
      throw std::invalid_argument(tumble::format("{}: must be given once, got it twice", name_of(varied)));
    }
    const Owner owner = info_of(varied.quantity).owner;
    if (owner == Owner::law) laws_.push_back(varied.index);
    if (owner == Owner::body) masses_.push_back(varied.index);
    ratios_.push_back(owner == Owner::body ? ratio_of(scene.bodies[static_cast<Index>(varied.index)]) : MassRatio{});
  }
}

void InstanceEditor::check_varied(const Varied& varied) const {
  const auto [name, owner] = info_of(varied.quantity);
  if (owner != Owner::scene) {
    const Index count = owner == Owner::body ? scene_.bodies.size() : scene_.materials.size() + scene_.pairs.size();
    if (varied.index < 0 || static_cast<Index>(varied.index) >= count) {
      throw std::invalid_argument(tumble::format("{}: must be of one of the {} {}, got the index {}", name, count,
                                                 owner == Owner::body ? "bodies" : "materials and pairs",
                                                 varied.index));
    }
  }
  if (owner == Owner::body) {
    const BodyKind kind = scene_.bodies[static_cast<Index>(varied.index)].kind;
    if (kind != BodyKind::dynamic) {
      throw std::invalid_argument(
          tumble::format("{}: only dynamic bodies have one, got it for a {} one", name_of(varied), to_string(kind)));
    }
  }
  require_length(name_of(varied), varied.values.size(), instances_.count, 1);
}

std::string InstanceEditor::name_of(const Varied& varied) const {
  const auto [name, owner] = info_of(varied.quantity);
  const auto index = static_cast<Index>(varied.index), num_materials = scene_.materials.size();
  if (owner == Owner::scene) return name;
  if (owner == Owner::body) return tumble::format("{} of {}", name, body_labels(scene_)[index]);
  if (index < num_materials) return tumble::format("{} of {}", name, scene_.materials[index].name);
  const MaterialPair& pair = scene_.pairs[index - num_materials];
  return tumble::format("{} of {} and {}", name, scene_.materials[static_cast<Index>(pair.a)].name,
                        scene_.materials[static_cast<Index>(pair.b)].name);
}

// That of the even filling if the body has it, as `set_mass` computes it: then to the bit what that gives another mass.
InstanceEditor::MassRatio InstanceEditor::ratio_of(const Body& body) {
  const auto has_area = [](const Part& part) { return area_moments(part.shape).area > 0.0; };
  if (std::all_of(body.parts.begin(), body.parts.end(), has_area)) {
    const MassProperties filled = mass_properties(body.parts, 1.0);
    if (filled.moment_of_inertia * (body.mass / filled.mass) == body.moment_of_inertia) {
      return {filled.mass, filled.moment_of_inertia};
    }
  }
  return {body.mass, body.moment_of_inertia};
}

void InstanceEditor::set_starts(Index pose_row, Index velocity_row, Scene& scene) const {
  const double* pose = instances_.pose.data() + pose_row * width_;
  const double* velocity = instances_.velocity.data() + velocity_row * width_;
  for (Index b = 0; b < bodies_.size(); ++b) {
    Body& body = scene.bodies[static_cast<Index>(bodies_[b])];
    if (!instances_.pose.empty()) body.pose = {{pose[3 * b], pose[3 * b + 1]}, pose[3 * b + 2]};
    if (!instances_.velocity.empty()) body.velocity = {velocity[3 * b], velocity[3 * b + 1], velocity[3 * b + 2]};
  }
}

void InstanceEditor::set(Index k, double value, Scene& scene) const {
  const Varied& varied = varied_[k];
  const auto body = [&]() -> Body& { return scene.bodies[static_cast<Index>(varied.index)]; };
  const auto law = [&]() -> ContactLaw& { return law_at(scene, varied.index); };
  switch (varied.quantity) {
    case Quantity::mass:
      body().mass = value;
      body().moment_of_inertia = ratios_[k].moment_of_inertia * (value / ratios_[k].mass);
      break;
    case Quantity::moment_of_inertia: body().moment_of_inertia = value; break;
    case Quantity::friction: law().friction = law().static_friction = value; break;
    case Quantity::static_friction: law().static_friction = value; break;
    case Quantity::restitution: law().restitution = value; break;
    case Quantity::gravity_x: scene.gravity.x = value; break;
    case Quantity::gravity_y: scene.gravity.y = value; break;
  }
}

void InstanceEditor::edit(Index i, Scene& scene) const {
  set_starts(has_own(instances_.pose) ? i : 0, has_own(instances_.velocity) ? i : 0, scene);
  for (Index k = 0; k < varied_.size(); ++k) set(k, varied_[k].values[is_common(varied_[k]) ? 0 : i], scene);
}

void InstanceEditor::require_common_in_range() const {
  Instances common = instances_;
  if (has_own(common.pose)) common.pose = {};
  if (has_own(common.velocity)) common.velocity = {};
  common.varied.clear();
  Scene scene = scene_;
  // Friction that differs is taken for one that goes with every other.
  for (const Varied& varied : varied_) {
    if (is_common(varied)) {
      common.varied.push_back(varied);
    } else if (varied.quantity == Quantity::friction) {
      law_at(scene, varied.index).friction = k_friction_range.low;
    } else if (varied.quantity == Quantity::static_friction) {
      law_at(scene, varied.index).static_friction = k_friction_range.high;
    }
  }
  InstanceEditor(scene_, common).edit(0, scene);
  validate(scene);
}

bool InstanceEditor::is_valid(const Scene& instance) const {
  const auto body = [&](int i) -> const Body& { return instance.bodies[static_cast<Index>(i)]; };
  return std::all_of(bodies_.begin(), bodies_.end(), [&](int i) { return is_valid_start(body(i)); }) &&
         std::all_of(masses_.begin(), masses_.end(),
                     [&](int i) {
                       return is_in(k_mass_range, body(i).mass) && is_in(k_inertia_range, body(i).moment_of_inertia);
                     }) &&
         std::all_of(laws_.begin(), laws_.end(), [&](int i) { return is_valid_law(law_at(instance, i)); }) &&
         is_in(k_gravity_range, instance.gravity.x) && is_in(k_gravity_range, instance.gravity.y);
}

Scene instance_scene(const Scene& scene, const Instances& instances, Index i) {
  if (i >= instances.count) {
    throw std::invalid_argument(
        tumble::format("i: must be the number of one of {} instances, got {}", instances.count, i));
  }
  Scene instance = scene;
  InstanceEditor(scene, instances).edit(i, instance);
  return instance;
}

std::string what_is_invalid(const Scene& scene, const Instances& instances, Index i) {
  try {
    validate(instance_scene(scene, instances, i));
    return "";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

}  // namespace tumble::batch
