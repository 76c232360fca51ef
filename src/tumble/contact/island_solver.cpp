#include "tumble/contact/island_solver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tumble/lcp/body_modes.hpp"
#include "tumble/lcp/solve.hpp"

namespace tumble {
namespace {

using Index = std::size_t;

constexpr double k_accepted_residual = 1e-10;
constexpr int k_sweeps_per_round = 5;
constexpr int k_rounds = 10;                 // of sweeps and a solve
constexpr int k_more_rounds = 60;            // where there is no other way
constexpr double k_rest_residual = 1e-15;    // what is left is round-off: nothing to improve
constexpr int k_max_path_steps = 20;         // and 2 per contact
constexpr int k_max_rounds = 15;             // where Newton gets there, it does so in a few
constexpr Index k_max_dense_contacts = 120;  // above, the dense LCP takes longer than a step is worth

}  // namespace

struct IslandSolver::Parts {
  BodyModes modes;
  LcpWorkspace lcp;
  std::vector<ContactMode> best_modes;
  std::vector<double> best_impulses;
  double best_residual = 0.0;
  std::vector<double> start_impulses;
  std::vector<ContactMode> swept_modes;
  std::vector<double> swept_impulses;

  bool offer_if_solved(double residual) { return residual <= k_accepted_residual && offer(); }

  // Keeps what is better than all before. True if it is good enough.
  bool offer() {
    const double residual = modes.residual();
    if (residual < best_residual) {
      best_residual = residual;
      best_modes = modes.modes;
      best_impulses = modes.impulses;
    }
    return residual <= k_accepted_residual;
  }

  bool run() { return modes.run(k_max_rounds) && offer(); }

  // Sweeps find the modes, one linear solve in these modes what sweeps would take long for, and so on [Silcowitz 2010].
  bool sweep_and_solve(int max_rounds) {
    modes.sweep(k_sweeps_per_round);
    double residual = modes.residual();
    for (int round = 0; round < max_rounds; ++round) {
      swept_modes = modes.modes;
      swept_impulses = modes.impulses;
      if (modes.run(1)) return offer();
      modes.project();
      const double after = modes.residual();
      if (!(after < residual)) {
        modes.modes = swept_modes;
        modes.impulses = swept_impulses;
      }
      modes.sweep(k_sweeps_per_round);
      residual = modes.residual();
      if (offer_if_solved(residual)) return true;
    }
    return false;
  }

  // By the general solver, which finds all that has a solution, but not as fast.
  LcpStatus search_dense(const ContactSystem& system) {
    const LcpResult& result = solve_lcp(as_lcp(system), RobustSettings{}, lcp);
    if (result.status == LcpStatus::bad_input) return LcpStatus::numerical;
    const Index m = system.contacts.size();
    for (Index i = 0; i < m; ++i) {
      modes.impulses[2 * i] = result.z[i];
      modes.impulses[2 * i + 1] = result.z[m + 2 * i] - result.z[m + 2 * i + 1];
      const double f_t = modes.impulses[2 * i + 1];
      modes.modes[i] = contact_mode(result.z[i], result.z[3 * m + i], f_t != 0.0 ? -f_t : 1.0);
    }
    if (offer()) return LcpStatus::solved;
    return result.status == LcpStatus::solved ? LcpStatus::numerical : result.status;
  }
};

IslandSolver::IslandSolver() : parts_(std::make_unique<Parts>()) {}
IslandSolver::~IslandSolver() = default;
IslandSolver::IslandSolver(IslandSolver&&) noexcept = default;
IslandSolver& IslandSolver::operator=(IslandSolver&&) noexcept = default;

IslandSolution IslandSolver::solve(const IslandSettings& settings) {
  BodyModes& search = parts_->modes;
  search.load(system);
  search.modes = modes;
  search.impulses = impulses;
  parts_->best_residual = search.residual();
  parts_->start_impulses = impulses;
  parts_->best_modes = modes;
  parts_->best_impulses = impulses;
  LcpStatus status = LcpStatus::solved;
  if (settings.solver == ContactSolver::fast) {
    search.sweep(settings.num_sweeps);
    parts_->best_modes = search.modes;
    parts_->best_impulses = search.impulses;
    parts_->best_residual = search.residual();
  } else if (parts_->best_residual > k_rest_residual && !parts_->run()) {
    const bool has_dense = system.contacts.size() <= k_max_dense_contacts;
    search.modes = modes;
    search.impulses = parts_->start_impulses;
    if (!parts_->sweep_and_solve(has_dense ? k_rounds : k_more_rounds)) {
      status = LcpStatus::iteration_limit;
      parts_->offer();
      if (has_dense) status = parts_->search_dense(system);
    }
  }
  search.impulses = parts_->best_impulses;
  modes = parts_->best_modes;
  impulses = search.impulses;
  velocity = search.find_velocities();
  return {status, parts_->best_residual, search.factorisations()};
}

}  // namespace tumble
