// The contact impulses of a record: what the arrows of the pictures show.
#pragma once

#include <vector>

#include "tumble/drop/drop.hpp"

namespace tumble::output {

struct Impulse {
  int column = 0;        // of the pose in contact
  double normal = 0.0;   // f_n dt [N s]
  double tangent = 0.0;  // (f_t2 - f_t1) dt [N s]
  double size = 0.0;     // of both together [N s]
  ContactMode mode = ContactMode::open;
};

// Those of all steps with a finite normal force above 0, in the order of time.
std::vector<Impulse> contact_impulses(const drop::Record& record);

double largest_size(const std::vector<Impulse>& impulses);

// The `count` largest of at least `smallest` [N s], in the order of time.
std::vector<Impulse> keep_largest(std::vector<Impulse> impulses, std::size_t count, double smallest);

}  // namespace tumble::output
