// What one step did.
#pragma once

#include <vector>

#include "tumble/geometry/contact_point.hpp"
#include "tumble/lcp/one_contact.hpp"
#include "tumble/lcp/result.hpp"
#include "tumble/scene/scene.hpp"

namespace tumble {

// Energies [J] after a step, and where what is missing went during it. Up to round-off,
//   kinetic + potential = the same before + external_work - friction_loss - impact_loss - damping_loss +
//                         stabilisation_work.
struct EnergyLedger {
  double kinetic = 0.0;             // of the dynamic bodies, 1/2 v . M v
  double potential = 0.0;           // -m g . x, 0 at the origin
  double external_work = 0.0;       // of the wrenches, and of kinematic bodies and conveyors through contacts
  double friction_loss = 0.0;       // -sum of P_t (u_t + u_t') / 2 [Thomson & Tait]
  double impact_loss = 0.0;         // -sum of P_n (u_n + u_n') / 2
  double damping_loss = 0.0;        // of linear and angular damping
  double stabilisation_work = 0.0;  // of the forces, along what positions move otherwise than by (v + v') / 2
  double created = 0.0;             // stabilisation_work - friction_loss - impact_loss where that is above round-off:
                                    // energy from nothing, island by island; else 0
};

// A contact in one step. Velocities are those of b seen from a. Impulses act on b at place_b, their opposites on a at
// place_a: normal_impulse along contact.normal, friction_impulse along the tangent.
struct ContactRecord {
  Contact contact;           // bodies, features, points, gap, normal, before the step
  Vector2 tangent;           // the normal turned right; of two contacts on one side, that of the nearer one for both
  Vector2 place_a, place_b;  // [m] one place, unless the bodies were apart before the step
  ContactLaw law;
  double bend = 0.0;             // [m] what turning and curved surfaces add to the gap in the step: it is closed where
                                 // u_n' = -(gap + bend) / step size
  double normal_velocity = 0.0;  // before [m/s]
  double tangential_velocity = 0.0;
  double normal_velocity_after = 0.0;  // [m/s]
  double tangential_velocity_after = 0.0;
  double normal_impulse = 0.0;  // [N s] >= 0
  double friction_impulse = 0.0;
  double restitution = 0.0;  // what of the law's restitution was at work: 0 where nothing bounced
  ContactMode mode = ContactMode::open;
};

struct StepReport {
  LcpStatus status = LcpStatus::solved;  // the worst of the islands
  double residual = 0.0;                 // the largest of the islands; see BodyModes
  int num_islands = 0;                   // with contacts at work
  int factorisations = 0;
  EnergyLedger energy;
  std::vector<ContactRecord> contacts;  // all in reach, in the order of their ids
};

}  // namespace tumble
