// Random contacts of single planar bodies.
#pragma once

#include "random.hpp"

#include "tumble/lcp/one_contact.hpp"

namespace tumble::test {

using problems::Random;

// A body with its contact point at r from the centre of mass, moving with v, ground below: A and b of its LCP.
// Masses 1e-3 to 1e3 kg, sizes 1 cm to 10 m, steps 1e-6 to 0.1 s; friction 0 in one of eight.
inline OneContact random_contact(Random& random, double max_friction) {
  const double mass = random.log_uniform(-10.0, 10.0);
  const double size = random.log_uniform(-6.6, 3.3);
  const double radius_of_gyration = size * random.uniform(0.3, 1.0);
  const double r_x = size * random.uniform(-1.0, 1.0);
  const double r_y = -size * random.uniform(0.0, 1.0);
  const double step = random.log_uniform(-20.0, -3.3);
  const double inverse_inertia = 1.0 / (mass * radius_of_gyration * radius_of_gyration);
  const double speed = random.log_uniform(-20.0, 6.0);
  const double u_n = speed * random.uniform(-1.0, 0.4);
  const double u_t = speed * random.uniform(-1.0, 1.0);
  const double friction = random.uniform(0.0, 8.0) < 1.0 ? 0.0 : random.uniform(0.0, max_friction);
  return {step * (1.0 / mass + r_x * r_x * inverse_inertia),
          -step * r_x * r_y * inverse_inertia,
          step * (1.0 / mass + r_y * r_y * inverse_inertia),
          u_n,
          u_t,
          friction};
}

}  // namespace tumble::test
