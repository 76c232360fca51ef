// Newton's method on the modes of contacts. Not a public header.
#pragma once

#include <array>
#include <cstdint>
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

  // All open, no impulse.
  void start(const ContactStructure& structure);

  // Sweeps of Gauss-Seidel over the contacts, from where the last ones ended; a guess of the modes, and a better one
  // the more sweeps.
  void sweep(const ContactStructure& structure, int num_sweeps);

  // Guesses that contacts slip only in directions in which they slid before: all stick in a stack at rest.
  void hold(const ContactStructure& structure);

  // From the modes of a basis of the LCP.
  void read_basis(const ContactStructure& structure, const std::vector<std::uint8_t>& basis);

  // Solves and changes modes until none is contradicted. False if that did not come to an end.
  enum class Change { all, worst };
  bool run(const ContactStructure& structure, Change change, int max_rounds);
  // Follows the path from the problem that the impulses of the sweeps solve to the one asked for; after each piece of
  // it one contact changes its mode. This is Lemke's method with the modes of contacts for a basis. False if the path
  // leads nowhere: into a ray, or, where contacts depend on each other, in a circle.
  bool follow(const ContactStructure& structure, int max_steps);

  // Of the last run or path.
  int factorisations() const { return factorisations_; }

  // Impulses and velocities of the last run, per contact (n, t).
  const std::vector<double>& impulses() const { return f_; }
  const std::vector<double>& velocities() const { return u_; }

 private:
  struct Objection {
    ContactMode mode;
    double size;
  };

  void list_unknowns(const ContactStructure& structure);
  void fill_equations(const ContactStructure& structure);
  void factor(const ContactStructure& structure);
  void find_impulses(const ContactStructure& structure, const std::vector<double>& b, std::vector<double>& f);
  void find_velocities(const ContactStructure& structure, const std::vector<double>& f, const std::vector<double>& b,
                       std::vector<double>& u) const;
  void find_velocities_and_sizes(const ContactStructure& structure);
  void refine(const ContactStructure& structure);
  Objection objection(const ContactStructure& structure, std::size_t i) const;
  int change_modes(const ContactStructure& structure, Change change);
  bool is_seen();

  void find_drift(const ContactStructure& structure);
  int list_conditions(const ContactStructure& structure, std::size_t i, const std::vector<double>& f,
                      const std::vector<double>& u, std::array<double, 2>& values) const;
  ContactMode next_mode(const ContactStructure& structure, std::size_t i, int condition, double u_t) const;
  static int border_condition(ContactMode from, ContactMode to);

  int factorisations_ = 0;
  double ridge_ = 0.0;                     // [-] of the diagonal, added to it
  std::vector<double> swept_;              // impulses of the sweeps
  std::vector<std::uint64_t> seen_;        // hashes of the modes tried in this run
  std::vector<Objection> objections_;      // per contact; its own mode if there is none
  std::vector<double> f_, u_;              // per contact (n, t)
  std::vector<double> size_;               // of the terms that u is a sum of
  std::vector<double> drift_;              // of b along the path, and what f and u gain with it
  std::vector<double> f_slope_, u_slope_;  //
  std::vector<int> unknown_;               // which row of A each equation is, 2 i or 2 i + 1
  std::vector<int> equation_;              // per row of A: its equation, or -1
  std::vector<double> matrix_, solution_;  // dense, with the profile below
  std::vector<int> first_, last_;          // per equation: the columns that may be other than 0
};

}  // namespace tumble
