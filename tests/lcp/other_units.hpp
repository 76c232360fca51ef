// A contact system in other units of mass, length and time.
#pragma once

#include <cmath>

#include "tumble/lcp/contact_system.hpp"

namespace tumble::test {

// The same system in units 2^mass, 2^length and 2^time as small.
inline ContactSystem in_other_units(const ContactSystem& system, int mass, int length, int time) {
  ContactSystem other = system;
  for (Vector3& m : other.inverse_mass) {
    m = {std::ldexp(m[0], -mass), std::ldexp(m[1], -mass), std::ldexp(m[2], -mass - 2 * length)};
  }
  for (Vector3& v : other.velocity) {
    v = {std::ldexp(v[0], length - time), std::ldexp(v[1], length - time), std::ldexp(v[2], -time)};
  }
  for (BodyContact& contact : other.contacts) {
    contact.offset = std::ldexp(contact.offset, length - time);
    for (Vector3* row : {&contact.normal_a, &contact.normal_b, &contact.tangent_a, &contact.tangent_b}) {
      (*row)[2] = std::ldexp((*row)[2], length);
    }
  }
  return other;
}

}  // namespace tumble::test
