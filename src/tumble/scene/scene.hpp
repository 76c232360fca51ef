// A scene: bodies, the fixed world, materials, gravity. What a simulation starts from; it does not change in one.
// SI units, radians, y up, counter-clockwise positive.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tumble/math/vector.hpp"
#include "tumble/scene/shape.hpp"

namespace tumble {

// How two surfaces touch.
struct ContactLaw {
  double friction = 0.5;         // [-] >= 0, while they slide
  double static_friction = 0.5;  // [-] >= friction, while they stick
  double restitution = 0.0;      // [-] in [0, 1]: speed of separation over speed of approach

  friend bool operator==(const ContactLaw&, const ContactLaw&) = default;
};

// Bodies that name no material have the one of this name.
inline constexpr std::string_view k_default_material = "default";

struct Material {
  std::string name;
  ContactLaw law;  // of two surfaces of this material

  friend bool operator==(const Material&, const Material&) = default;
};

// A law for two materials in place of the mixing rule.
struct MaterialPair {
  int a = 0, b = 0;  // indices into Scene::materials, a != b
  ContactLaw law;

  friend bool operator==(const MaterialPair&, const MaterialPair&) = default;
};

// One shape of a body.
struct Part {
  Shape shape;                 // in the frame of the body
  int material = 0;            // index into Scene::materials
  double surface_speed = 0.0;  // [m/s] of a conveyor: the surface runs along its tangent, the outward normal turned
                               // right (+x on top)

  friend bool operator==(const Part&, const Part&) = default;
};

enum class BodyKind { dynamic, kinematic, fixed };

// "dynamic", "kinematic", "fixed".
std::string_view to_string(BodyKind kind);

// Where a kinematic body is at a time. Between two knots its velocity is constant.
struct Knot {
  double time = 0.0;  // [s], increasing
  Pose pose;

  friend bool operator==(const Knot&, const Knot&) = default;
};

// Force and torque on a body from a time on, until that of the next entry.
struct Wrench {
  double time = 0.0;    // [s], increasing
  Vector2 force;        // [N], at the centre of mass, in the world frame
  double torque = 0.0;  // [N m]

  friend bool operator==(const Wrench&, const Wrench&) = default;
};

struct Body {
  std::string name;
  BodyKind kind = BodyKind::dynamic;
  std::vector<Part> parts;
  // The origin of the frame of the body is its centre of mass; of a kinematic or fixed body, the point it turns about.
  double mass = 0.0;               // [kg] > 0; dynamic bodies
  double moment_of_inertia = 0.0;  // [kg m^2] > 0, about the centre of mass; dynamic bodies
  Pose pose;                       // at the start
  Vector3 velocity{};              // (v_x, v_y, omega) at the start; a kinematic body without knots keeps it
  std::vector<Knot> motion;        // kinematic bodies: before the first knot and after the last one they stand still
  std::vector<Wrench> wrenches;    // dynamic bodies
  double linear_damping = 0.0;     // [1/s] >= 0: the force -linear_damping m v
  double angular_damping = 0.0;    // [1/s] >= 0: the torque -angular_damping I omega

  friend bool operator==(const Body&, const Body&) = default;
};

struct Scene {
  std::string title;
  std::vector<Material> materials;
  std::vector<MaterialPair> pairs;
  std::vector<Body> bodies;
  Vector2 gravity = {0.0, -9.81};  // [m/s^2]
  double step_size = 1e-3;         // [s] > 0
  double duration = 1.0;           // [s] > 0

  friend bool operator==(const Scene&, const Scene&) = default;
};

// The law between two materials (indices): that of their pair if there is one; else the geometric mean of each
// coefficient, which is exactly the material's own law for two of a kind.
ContactLaw contact_law(const Scene& scene, int material_a, int material_b);

// A word for each body, no two the same: its name; "body3" for bodies[3] if it has none.
std::vector<std::string> body_labels(const Scene& scene);

// Throws std::invalid_argument naming body, part, field, value and what is allowed: NaN, infinity, an index that names
// nothing, a mass that is not positive, a half-plane or terrain on a dynamic body, times that do not increase, ...
void validate(const Scene& scene);

struct MassProperties {
  double mass = 0.0;               // [kg]
  Vector2 centre_of_mass;          // [m]
  double moment_of_inertia = 0.0;  // [kg m^2], about the centre of mass
};

// Of parts filled with `density` [kg/m^2]; parts that overlap count twice where they do. Throws std::invalid_argument
// for parts without area or a density that is not positive.
MassProperties mass_properties(const std::vector<Part>& parts, double density);

// Moves the frame of the body to `origin` (in its present frame): the parts move in the frame, the pose such that
// nothing moves in the world, velocity and knots to those of the new origin. Between knots that turn the body it runs
// straight from one place of the new origin to the next, which is another motion than before.
void move_origin(Body& body, Vector2 origin);

// Gives a body the mass and moment of inertia of its parts filled with `density` [kg/m^2], and moves its origin to
// their centre of mass. A centre of mass nearer to the origin than the rounding of its own sum leaves it there.
void set_density(Body& body, double density);

// Gives a body this mass [kg], spread evenly over the area of its parts, and moves its origin to their centre of mass.
void set_mass(Body& body, double mass);

}  // namespace tumble
