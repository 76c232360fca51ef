// Contact problems made from a seed: the same seed gives the same bits on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "random.hpp"

#include "tumble/lcp/contact_system.hpp"

namespace tumble::problems {

// All of these are solvable in exact arithmetic: q = J (v + h M^-1 f) and no offsets [Stewart & Trinkle 1996], and have
// exactly `num_contacts` >= 1 contacts, n = 4 num_contacts.

// Bodies and contacts at random, as unpleasant as contact problems get: up to 3 bodies for 4 contacts and up to 8 for
// more; masses 1e-3 to 1e3 kg, sizes 1 cm to 10 m, steps 1e-6 to 0.1 s, velocities 0 or 1e-8 to 100 m/s; friction 0 or
// 1e-6 to 10; contacts with the world and between bodies, doubled exactly or up to 1e-14 .. 1e-6, on one face, or with
// a normal that is almost vertical. The geometry of one contact is that of a body, but contacts need not fit together.
ContactSystem wild(Random& random, std::size_t num_contacts);

struct Tower {
  std::size_t contacts_per_face = 2;  // at least 2: at the corners and evenly between
  double mass_exponent = 0.0;         // the top box has about 2^this times the mass of the lowest
  bool is_graded = false;             // masses rise or fall from box to box; else only the top box differs
  bool is_moving = false;             // each box has its own small velocity; else all rest and feel gravity
  double friction = 0.5;
  double step = 0.01;  // [s]
};

// Boxes of 1 m x 0.5 m on top of each other; the top one may have fewer contacts, one of them in the middle.
ContactSystem tower(const Tower& tower, Random& random, std::size_t num_contacts);

// The same with 2 or 4 contacts per face, mass ratio 1, 1e3 or 1e-6, graded or not, at rest or moving, at random.
ContactSystem tower(Random& random, std::size_t num_contacts);

// Only those at rest: what a simulation solves over and over.
ContactSystem resting_tower(Random& random, std::size_t num_contacts);

// Each box stands on two, with two contacts on each; the top may be missing. At rest or moving.
ContactSystem pyramid(Random& random, std::size_t num_contacts);

// Bodies on one to three earlier ones or on the ground, masses 1 : 1e6.
ContactSystem pile(Random& random, std::size_t num_contacts);

// Bodies jammed between two walls that may lean a little, or between earlier bodies: friction can hold any force.
ContactSystem wedge(Random& random, std::size_t num_contacts);

// Rods that lean on a plate and are pushed along it, with friction around and far above A_nn / |A_nt|, where a contact
// may jam without any approach [Painleve 1895; Stewart 2000].
ContactSystem painleve(Random& random, std::size_t num_contacts);

// What a simulation solves next: the step that follows a resting system's step with the impulses z. The velocity it
// had, h M^-1 f, acts again, changed by up to one part in a million; offsets are what z left of the gaps, over h.
ContactSystem next_step(const ContactSystem& resting, const std::vector<double>& z, Random& random);

// The random numbers of problem `index` of a long list, which may then be made in any order.
Random random_of(std::uint64_t seed, std::uint64_t index);

// The problem `index` of that list, made by `wild` with 1 to `max_contacts` contacts.
ContactSystem wild_of(std::uint64_t seed, std::uint64_t index, int max_contacts);

struct Family {
  std::string_view name;
  ContactSystem (*make)(Random& random, std::size_t num_contacts);
};

std::span<const Family> families();

}  // namespace tumble::problems
