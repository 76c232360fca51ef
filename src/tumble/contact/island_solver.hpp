// Solves the contacts of bodies that touch each other.
#pragma once

#include <memory>
#include <vector>

#include "tumble/lcp/contact_system.hpp"
#include "tumble/lcp/result.hpp"

namespace tumble {

enum class ContactSolver {
  exact,  // the LCP to a residual of 1e-10 and mostly to round-off, or a status that says it is not
  fast,   // the same for islands of up to 50 contacts, if it gets there; for larger ones, sweeps of block
          // Gauss-Seidel from the impulses of the last step, up to `num_sweeps`
};

struct IslandSettings {
  ContactSolver solver = ContactSolver::exact;
  int num_sweeps = 24;  // fast
};

struct IslandSolution {
  LcpStatus status =
      LcpStatus::solved;  // solved, infeasible, ray_unproven, no_solution_proved, iteration_limit, numerical
  double residual = 0.0;  // of `BodyModes::residual`, or of the LCP where the general solver solved that
  int factorisations = 0;
};

class IslandSolver {
 public:
  IslandSolver();
  ~IslandSolver();
  IslandSolver(IslandSolver&&) noexcept;
  IslandSolver& operator=(IslandSolver&&) noexcept;

  // In: the contacts, their bodies, all of positive mass, and where to start. Out: modes, impulses, velocity.
  ContactSystem system;
  std::vector<ContactMode> modes;  // per contact
  std::vector<double> impulses;    // per contact (n, t) [N s]
  std::vector<Vector3> velocity;   // per body, after the impulses

  // The impulses of the LCP of `as_lcp(system)`, from the modes and impulses given. Where it has several solutions, the
  // one found from there.
  IslandSolution solve(const IslandSettings& settings);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tumble
