// Recognises the LCP of planar contacts in a matrix. Not a public header.
#pragma once

#include <cstdint>
#include <vector>

#include "tumble/lcp/one_contact.hpp"
#include "tumble/lcp/problem.hpp"

namespace tumble {

// Where one contact lies in z, whatever the order of the unknowns: c normal impulse, plus and minus the two friction
// impulses, s the slip speed. Rows may be in units of their own:
//   w_c     = (A z)_c + q_c
//   w_plus  = (A z)_t + slip s + q_t,      w_minus = -(A z)_t + slip s - q_t
//   w_s     = friction c - cone (plus + minus)
struct ContactPlace {
  int c = -1;     // -1: without friction no row tells which normal it belongs to; friction is 0 then
  int plus = -1;  // -1: a normal alone, without friction unknowns
  int minus = -1;
  int s = -1;
  double friction = 0.0;  // of the cone row, >= 0
  double cone = 1.0;      // > 0
  double slip = 1.0;      // > 0

  double mu() const { return friction / cone; }
  bool has_friction() const { return c >= 0 && s >= 0; }
};

// The same problem with two unknowns per contact, the impulse (f_n, f_t), f_t = plus - minus:  u = A f + b.
// A is kept by its entries other than 0, row after row; row 2 i is u_n of contact i, row 2 i + 1 its u_t.
struct ContactStructure {
  std::vector<ContactPlace> places;  // in the order of their first unknown
  std::vector<int> owner;            // scratch

  std::vector<std::size_t> row_begin;  // 2 m + 1
  std::vector<int> column;
  std::vector<double> entry;
  std::vector<double> diagonal;  // 2 m; 0 for a row that does not exist
  std::vector<double> b;         // 2 m
};

// True if every unknown belongs to a contact as above, one of them at least with friction, and A is symmetric with a
// positive diagonal; the structure is then filled. Entries that should be equal may differ by the round-off of forming
// them.
bool find_contacts(const LcpProblem& problem, ContactStructure& structure);

// Fills A and b for the places. False unless, in the rows of c and plus of every contact, the diagonal is positive,
// columns of plus and minus are each other's negatives and column s acts on its own contact alone.
bool read_responses(const LcpProblem& problem, ContactStructure& structure);

// z of the LCP and a regular basis of it, from the impulse f and velocity u (2 m each: normal, tangential) and the mode
// of each contact. Where a contact slips, or is open, the friction unknown of the side of the slip is basic, even if it
// is 0: its row, w = 0, is what determines s.
void write_contacts(const ContactStructure& structure, const std::vector<ContactMode>& modes,
                    const std::vector<double>& f, const std::vector<double>& u, std::vector<double>& z,
                    std::vector<std::uint8_t>& basis);

// Row sizes of contacts, as a contact model gives them: the largest |q| among velocity rows, and what it is worth in
// each cone row. n values.
void contact_row_sizes(const LcpProblem& problem, const std::vector<ContactPlace>& places, std::vector<double>& sizes);

}  // namespace tumble
