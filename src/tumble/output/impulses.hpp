// The contact impulses of a run: what the arrows of the pictures show.
#pragma once

#include <cstdint>
#include <vector>

#include "tumble/trajectory/trajectory.hpp"

namespace tumble::output {

struct Impulse {
  std::int64_t step = 0;       // 1, 2, ...
  Vector2 place;               // [m], where it acts, before the step
  Vector2 normal;              // towards the body it acts on, which is dynamic
  double along_normal = 0.0;   // [N s]
  double along_tangent = 0.0;  // [N s], the normal turned right
  double size = 0.0;           // of both together [N s]
  double friction = 0.0;       // coefficient
  ContactMode mode = ContactMode::open;
  Contact contact;  // of which it is
};

// That of a contact in a step. Its size is 0 if there is none, or none that is finite.
Impulse impulse_of(const ContactRecord& record, const Scene& scene, std::int64_t step);

// One for each stretch of steps in which the same features touch: the largest; of about equal ones, as of a body at
// rest, the last. In the order of time.
std::vector<Impulse> largest_of_each_touch(const Trajectory& trajectory);

// Those of the last step.
std::vector<Impulse> impulses_at_end(const Trajectory& trajectory);

// Of the impulses of each contact the largest; of these the `count` largest of at least `smallest` [N s].
std::vector<Impulse> largest_of_each_contact(std::vector<Impulse> impulses, std::size_t count, double smallest);

// The `count` largest of at least `smallest` [N s], in the order of time.
std::vector<Impulse> keep_largest(std::vector<Impulse> impulses, std::size_t count, double smallest);

double largest_size(const std::vector<Impulse>& impulses);

// The same features of the same bodies.
bool is_same_contact(const Contact& a, const Contact& b);

}  // namespace tumble::output
