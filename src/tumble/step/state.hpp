// What changes during a simulation.
#pragma once

#include <cstdint>
#include <vector>

#include "tumble/lcp/one_contact.hpp"
#include "tumble/math/pose.hpp"
#include "tumble/math/vector.hpp"
#include "tumble/scene/scene.hpp"

namespace tumble {

struct BodyState {
  Pose pose;           // of the frame of the body: its centre of mass
  Vector3 velocity{};  // (v_x, v_y, omega) [m/s, rad/s]
};

// What a contact did in the last step: where the next one starts to look, and whether static friction holds it.
struct ContactMemory {
  int body_a = 0, body_b = 0, part_a = 0, part_b = 0;
  std::uint32_t feature = 0;
  ContactMode mode = ContactMode::open;
  bool has_stuck = false;
  bool has_bounced = false;
  double normal_impulse = 0.0, friction_impulse = 0.0;  // [N s]
};

struct State {
  double time = 0.0;                    // [s]
  std::vector<BodyState> bodies;        // in the order of Scene::bodies
  std::vector<ContactMemory> contacts;  // of the last step; may be empty: the same motion up to what the contact laws
                                        // leave open and to round-off
};

// The scene at time 0.
State initial_state(const Scene& scene);

// Where a kinematic or fixed body is at a time, by its knots or its constant velocity.
Pose prescribed_pose(const Body& body, double time);

// Mean over [from, to] of force and torque on a body: (F_x, F_y, torque).
Vector3 mean_wrench(const Body& body, double from, double to);

}  // namespace tumble
