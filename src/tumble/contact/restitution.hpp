// Restitution: when a contact bounces, and how fast.
#pragma once

#include <algorithm>
#include <cmath>

namespace tumble {

// What of a contact's motion in a step decides whether it bounces.
struct Approach {
  double gap;            // at the start of the step [m]
  double speed;          // u_n there [m/s], < 0 while the bodies approach
  double free_speed;     // u_n at the end of the step, were there no contacts
  double step_size;      // [s]
  double turning = 0.0;  // [m/s] what turning and curved surfaces add to u_n in the step

  double acceleration() const { return (free_speed - speed) / step_size; }
};

// The speed [m/s] >= 0 with which the gap closes, from gap and speed under constant acceleration:
//   u^2 - 2 a gap at gap = 0.
// So a bounce at the end of a step has the energy of one in its course, whatever the step size; 0 if the gap does not
// close.
inline double approach_speed(const Approach& approach) {
  const double square = approach.speed * approach.speed - 2.0 * approach.acceleration() * approach.gap;
  return std::sqrt(std::max(square, 0.0));
}

// The speed [m/s] of separation, restitution times that of approach; 0 where all the bounces that would follow, each
// smaller than the one before, end within the step:
//   flights of 2 e u / a, 2 e^2 u / a, ...  add up to  2 e u / (a (1 - e)) <= h.
// That is no threshold on speeds of its own: it is what happens.
inline double bounce_speed(const Approach& approach, double restitution) {
  if (restitution == 0.0) return 0.0;
  const double bounce = restitution * approach_speed(approach);
  const double fall = -approach.acceleration() - approach.turning / approach.step_size;
  const bool ends_within = fall > 0.0 && 2.0 * bounce <= approach.step_size * fall * (1.0 - restitution);
  return ends_within ? 0.0 : bounce;
}

}  // namespace tumble
