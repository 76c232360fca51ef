// Newton's method on the modes of contacts. Not a public header.
#pragma once

#include <vector>

#include "tumble/lcp/contact_structure.hpp"
#include "tumble/lcp/one_contact.hpp"

namespace tumble {

// Each contact is open, sticks, or slips to one side. With all modes chosen, the impulses follow from linear equations;
// where they contradict a mode, the mode changes. All changes are made at once, as in a semismooth Newton method, so a
// few rounds suffice where a pivoting method makes hundreds of pivots. It may cycle: then another method must help.
class ContactModes {
 public:
  std::vector<ContactMode> modes;

  // First guess: two sweeps of Gauss-Seidel over the contacts, each solved exactly.
  void guess(const ContactStructure& structure);

  // From the modes of a basis of the LCP.
  void read_basis(const ContactStructure& structure, const std::vector<std::uint8_t>& basis);

  // Solves and changes modes until none is contradicted. `speed` [m/s] is the size of what is to be solved. False if
  // that did not come to an end.
  bool run(const ContactStructure& structure, double speed, int max_rounds);
  int rounds() const { return rounds_; }

  // z of the LCP, and its basis.
  void write(const ContactStructure& structure, std::vector<double>& z, std::vector<std::uint8_t>& basis) const;

 private:
  void list_unknowns(const ContactStructure& structure);
  void fill_equations(const ContactStructure& structure);
  void factor();
  void solve(const ContactStructure& structure);
  void find_velocities(const ContactStructure& structure);
  int change_modes(const ContactStructure& structure, double speed);

  int rounds_ = 0;
  std::vector<double> f_, u_;           // per contact (n, t)
  std::vector<int> unknown_;            // which row of A each equation is, 2 i or 2 i + 1
  std::vector<int> equation_;           // per row of A: its equation, or -1
  std::vector<double> matrix_, right_;  // dense, with the profile below
  std::vector<int> first_, last_;       // per equation: the columns that may be other than 0
  std::vector<double> pivot_size_;
};

}  // namespace tumble
