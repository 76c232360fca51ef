// Planar frictional contacts between rigid bodies, and their LCP.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tumble/lcp/one_contact.hpp"
#include "tumble/lcp/problem.hpp"
#include "tumble/math/vector.hpp"

namespace tumble {

// A contact between two bodies, or a body and the world (index -1). The velocity at the contact, of b seen from a, is
//   u_n = normal_a . v_a + normal_b . v_b + offset,
//   u_t = tangent_a . v_a + tangent_b . v_b + tangent_offset      [m/s],
// u_n > 0 while the bodies separate. Rows of the world are ignored.
struct BodyContact {
  int body_a = -1;
  int body_b = -1;
  Vector3 normal_a{};
  Vector3 normal_b{};
  Vector3 tangent_a{};
  Vector3 tangent_b{};
  double friction = 0.0;        // mu >= 0 [-]
  double offset = 0.0;          // [m/s]: gap / step size, restitution times the approach speed, ...
  double tangent_offset = 0.0;  // [m/s]: what moves without being a body of the system, a conveyor for one
};

// f(body, normal row, tangent row) for each body of the contact that is not the world.
template <typename F>
void for_bodies(const BodyContact& contact, F&& f) {
  if (contact.body_a >= 0) f(static_cast<std::size_t>(contact.body_a), contact.normal_a, contact.tangent_a);
  if (contact.body_b >= 0) f(static_cast<std::size_t>(contact.body_b), contact.normal_b, contact.tangent_b);
}

struct ContactSystem {
  std::vector<Vector3> inverse_mass;  // per body: (1/m, 1/m, 1/I), each >= 0
  std::vector<Vector3> velocity;      // per body, before the impulses of the contacts
  std::vector<BodyContact> contacts;
};

// Throws std::invalid_argument naming the field: lists of different lengths, a body that does not exist, NaN, infinity,
// a negative mass or friction, no contact, or a contact between a body and itself.
void validate(const ContactSystem& system);

// The LCP of k contacts, n = 4 k [Stewart & Trinkle 1996; Anitescu & Potra 1997], for the impulses [N s]
//   z = (c_1 .. c_k,  b+_1, b-_1, .. b+_k, b-_k,  s_1 .. s_k)
// with c the normal impulse, b+ - b- the friction impulse along +t, and s the slip speed:
//   u_n >= 0                 complementary to  c >= 0
//   u_t + s >= 0             complementary to  b+ >= 0
//   -u_t + s >= 0            complementary to  b- >= 0
//   mu c - b+ - b- >= 0      complementary to  s >= 0
// Row sizes: the largest |u_n|, |u_t| before the impulses; that over the contact's own normal response for the cones.
LcpProblem as_lcp(const ContactSystem& system);

// (u_n, u_t) [m/s] of a contact, offset included, where the bodies have the given velocities (v_x, v_y, omega), one for
// each body of the system.
std::array<double, 2> velocity_at(const BodyContact& contact, const std::vector<Vector3>& velocity);

// What a contact does, from its entries of z and the tangential velocity after the impulses.
ContactMode contact_mode(double normal_impulse, double slip_speed, double u_t);

// Velocities of all bodies after the impulses in z: v + M^-1 J^T f.
std::vector<Vector3> velocities_after(const ContactSystem& system, const std::vector<double>& z);

}  // namespace tumble
