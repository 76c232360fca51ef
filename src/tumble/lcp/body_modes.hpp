// Newton's method on the modes of contacts, in the velocities of the bodies. Not a public header.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tumble/lcp/block_lu.hpp"
#include "tumble/lcp/contact_system.hpp"

namespace tumble {

// As `ContactModes`: each contact is open, sticks, or slips to one side, and where the impulses that follow from linear
// equations contradict a mode, it changes. Here the equations are those of the bodies,
//   (M + C D^-1 J) v = M v0 + C (f - D^-1 (b + J v0)),        D = ridge * diag(A),
// J the rows of contacts that hold (u_n = 0, and u_t = 0 where they stick) and C the directions in which their impulses
// push: three unknowns per body, however many contacts it has, and a matrix as sparse as the contacts are. The ridge D
// shares the load of contacts that depend on each other; repeating the equations from the f found (the method of
// multipliers) takes its error away.
class BodyModes {
 public:
  // Start and result, per contact: the modes, and the impulses (n, t) [N s].
  std::vector<ContactMode> modes;
  std::vector<double> impulses;

  // The system to solve from now on, which must outlive the calls below. Bodies have positive masses.
  void load(const ContactSystem& system);

  // Sweeps of block Gauss-Seidel over the contacts, from the present impulses: a guess of modes and impulses. They end
  // early where a sweep changes no velocity by more than `enough` of the largest speed.
  void sweep(int num_sweeps, double enough = 0.0);

  // Impulses onto the cones: none pulls, none is outside.
  void project();

  // Solves and changes modes until none is contradicted. False if that did not come to an end.
  bool run(int max_rounds);

  // The same for u + ridge diag(A) (f - f_start) in place of u: a step of the proximal point method from the present
  // impulses. The larger the ridge, the easier to solve, and the closer to where it started.
  bool run_near(double ridge, int max_rounds);

  // The same by following the path from the problem that the present impulses solve, those of `sweep`, `project` or of
  // this, to the one asked for; after each piece of it one contact changes its mode [Lemke's method with the modes of
  // contacts for a basis]. Slower, and gets there more often. False if the path leads nowhere, or on for too long.
  bool follow_near(double ridge, int max_pieces);

  // Velocities of the bodies after `impulses`.
  const std::vector<Vector3>& find_velocities();

  // How far impulses and velocities are from the contact laws, free of units: the largest of
  //   |min(A_nn f_n, u_n)| / s,   |A_tt (f_t - the point of the cone |f_t| <= mu f_n next to f_t - u_t / A_tt)| / s,
  // s the largest speed of approach or slip at a contact before the impulses, and 1e-5 of the sizes of the terms that u
  // is a sum of: where large impulses cancel, their rounding is forgiven, but no more.
  double residual();

  int factorisations() const { return factorisations_; }  // since `load`

 private:
  struct Block {
    double nn = 0.0, nt = 0.0, tt = 0.0;
  };
  struct Objection {
    ContactMode mode;
    double size;
  };

  using Pair = std::array<double, 2>;  // (n, t)

  // Where a condition of a contact reaches 0 along a path, `step` of lambda away.
  struct Border {
    std::size_t contact;
    int condition;
    double step;
  };

  // Impulses that the modes call for, and the velocities at the contacts with them.
  struct Response {
    std::vector<double> f;
    std::vector<Pair> u;
  };

  void find_pairs();
  void fill_equations();
  double correct();
  void respond(const std::vector<Pair>& offsets, Response& response);
  void start_path();
  void correct_path(double lambda);
  bool change_mode_on_path(std::size_t i, ContactMode mode);
  Border next_border(double sign, double step, const Border& last) const;
  int list_conditions(std::size_t i, const Response& response, Pair& values) const;
  ContactMode next_mode(std::size_t i, int condition, double u_t) const;
  void find_contact_velocities();
  Objection objection(std::size_t i) const;
  bool iterate(int max_rounds);
  int change_modes();
  bool is_seen();
  void impose_modes();

  const ContactSystem* system_ = nullptr;
  int factorisations_ = 0;
  double ridge_ = 0.0;    // [-] of the diagonal of A
  bool is_near_ = false;  // in `run_near`
  double speed_ = 0.0;    // largest of approach or slip before the impulses [m/s]
  std::vector<Vector3> mass_;
  std::vector<Block> response_;            // A of each contact
  std::vector<Vector3> v_, terms_, step_;  // terms_: the sizes of what v_ is a sum of
  std::vector<Pair> u_, size_;
  bool has_pairs_ = false;  // of the present system
  BlockLu::Pairs pairs_;
  std::vector<int> pair_of_;  // contact -> pair of bodies, or -1
  BlockLu equations_;
  std::vector<double> start_impulses_;  // of a run
  std::vector<Pair> drift_;             // of offsets along a path
  Response here_, slope_;               // on a path
  std::vector<std::uint64_t> seen_;
  std::vector<Objection> objections_;
};

}  // namespace tumble
