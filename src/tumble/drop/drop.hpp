// The document's model: a square falls on the line y = 0 and touches it with its lowest corner.
// Names, argument order and meaning are the document's. SI units, radians, y up, counter-clockwise positive.
//   q = (x, y, theta): centre of mass and angle.   v = (vx, vy, omega).   Normal +y, tangent +x.
// Every function throws std::invalid_argument for parameters that `validate` refuses and for states that are NaN or
// infinite. Theory: docs/theory/drop.md.
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "tumble/drop/parameters.hpp"
#include "tumble/lcp/one_contact.hpp"
#include "tumble/math/vector.hpp"

namespace tumble::drop {

// ---- Part 1: contact distance and Jacobian ----

// The two columns of the document's 3 x 2 matrix J = [J_t J_n]. With r = corner - centre of mass in the world frame,
// J_t = (1, 0, -r_y) and J_n = (0, 1, r_x); J_t . v and J_n . v are the velocity of the corner along +x and +y [m/s].
struct Jacobian {
  Vector3 t;
  Vector3 n;
};

struct Contacts {
  Jacobian J;
  double phi;  // distance of the lowest corner from the ground [m], < 0 is penetration
};

// Of corners at the same height, the first in the order of `corner_index` counts.
Contacts get_contacts(const Vector3& q, const Parameters& parameters = {});

// Which corner is the lowest: 0 (-,-), 1 (+,-), 2 (+,+), 3 (-,+), signs of its coordinates in the body frame.
int corner_index(const Vector3& q, const Parameters& parameters = {});

// The four corners in the world frame [m], (x, y) each, in the order of `corner_index`.
std::array<std::array<double, 2>, 4> corner_positions(const Vector3& q, const Parameters& parameters = {});

// ---- Part 2: the LCP ----

// w = V z + p >= 0,  z >= 0,  w . z = 0  for z = (f_n, f_t1, f_t2, lambda): forces in N, sliding speed in m/s.
struct Lcp {
  Matrix4 V;
  Vector4 p;
};

// V and p of the document's display. Restitution multiplies only v, only in the first row of p; V carries one dt.
Lcp form_lcp(const Jacobian& J, const Vector3& v, const Parameters& parameters = {});

// Thrown where the document's signatures leave no room for a status.
class NoSolution : public std::runtime_error {
 public:
  NoSolution(const std::string& what, LcpStatus lcp_status) : std::runtime_error(what), status(lcp_status) {}
  LcpStatus status;
};

// f_c = (f_n, f_t1, f_t2) [N] of a solution of any 4 x 4 LCP, not only those of form_lcp: by closed form if V and p
// have the contact structure, else by Lemke, else by trying all bases. Of several solutions, one. Throws NoSolution if
// there is none, std::invalid_argument if an entry is NaN or infinite.
Vector3 solve_LCP(const Matrix4& V, const Vector4& p);

// ---- Part 3: one step ----

struct State {
  Vector3 q;
  Vector3 v;
};

// The state one time step later. Throws NoSolution if the numbers leave the range of double on the way.
State step(const Vector3& q, const Vector3& v, const Parameters& parameters = {});

// What one step did, beside the state it led to.
struct StepRecord {
  double gap = 0.0;                      // phi before the step [m]
  int corner = 0;                        // lowest corner before the step, see corner_index
  Vector4 z{};                           // f_n, f_t1, f_t2 [N], lambda [m/s]; zero if phi >= delta
  ContactMode mode = ContactMode::open;  // what the corner does during the step
  LcpStatus status = LcpStatus::solved;  // solved, or numerical: the state after the step means nothing then
  double residual = 0.0;                 // of the LCP [-]
};

struct RecordedStep {
  State state;  // after the step
  StepRecord record;
};

// As `step`, but reports trouble as a status and never throws for it.
RecordedStep step_with_record(const Vector3& q, const Vector3& v, const Parameters& parameters = {});

// ---- Part 4: the trajectory ----

struct Trajectory {
  int columns = 0;                       // those computed: parameters.columns unless a step failed
  std::vector<double> q;                 // 3 x columns, row after row: all x, all y, all theta
  std::vector<double> v;                 // 3 x columns
  LcpStatus status = LcpStatus::solved;  // of the last step taken; if not `solved`, the columns before it are good

  Vector3 q_at(int column) const { return at(q, column); }
  Vector3 v_at(int column) const { return at(v, column); }

 private:
  Vector3 at(const std::vector<double>& rows, int column) const {
    const auto k = static_cast<std::size_t>(column);
    const auto stride = static_cast<std::size_t>(columns);
    return {rows[k], rows[stride + k], rows[2 * stride + k]};
  }
};

// Column 0 is (q0, v0), each further column one step later.
Trajectory simulate(const Vector3& q0, const Vector3& v0, const Parameters& parameters = {});

// A trajectory with everything that happened on the way.
struct Record {
  Parameters parameters;
  Trajectory trajectory;
  std::vector<StepRecord> steps;  // one per column: the step from that column on; of the last column, what it would do
};

// As `simulate`, but states whose energy leaves the range of double are out of range too: refused at the start, and the
// end of the run with status numerical later.
Record simulate_with_record(const Vector3& q0, const Vector3& v0, const Parameters& parameters = {});

// 1/2 v^T M v [J].
double kinetic_energy(const Vector3& v, const Parameters& parameters = {});

// m g y [J], 0 at y = 0.
double potential_energy(const Vector3& q, const Parameters& parameters = {});

}  // namespace tumble::drop
