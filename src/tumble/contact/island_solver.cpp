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
constexpr double k_rest_rounding = 2e-16;  // [-] what is left is round-off: nothing to improve
constexpr int k_max_path_steps = 20;       // and 2 per contact
constexpr int k_num_sweeps = 10;
constexpr int k_num_batches = 10;
constexpr int k_sweeps_per_batch = 20;
constexpr int k_max_soft_rounds = 8;
constexpr double k_hard_ridge = 1e-4;        // [-] as hard as rigid for most
constexpr int k_max_rounds = 8;              // where Newton gets there, it does so in a few
constexpr Index k_max_dense_contacts = 120;  // above, the dense LCP takes longer than a step is worth

}  // namespace

struct IslandSolver::Parts {
  BodyModes modes;
  LcpWorkspace lcp;
  std::vector<ContactMode> best_modes;
  std::vector<double> best_impulses;
  double best_residual = 0.0;
  std::vector<double> start_impulses;

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

  // Contacts that give way a little have modes that are easy to find: Newton's method finds them, or else the path.
  // Then they are made harder, each problem a good start for the next one, until the modes are those of rigid contacts.
  bool harden() {
    modes.sweep(k_num_sweeps);
    for (const double ridge : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {
      if (!solve_soft(ridge)) return false;
      if (ridge > k_hard_ridge) continue;
      const std::vector<ContactMode> soft_modes = modes.modes;
      const std::vector<double> soft_impulses = modes.impulses;
      modes.project();
      if (run()) return true;
      modes.modes = soft_modes;
      modes.impulses = soft_impulses;
    }
    return false;
  }

  // Sweeps get close, from anywhere, but are slow to arrive: Newton's method from where they are, again and again.
  bool sweep_and_run() {
    for (int batch = 0; batch < k_num_batches; ++batch) {
      modes.sweep(k_sweeps_per_batch);
      offer();
      const std::vector<ContactMode> swept_modes = modes.modes;
      const std::vector<double> swept_impulses = modes.impulses;
      if (run()) return true;
      modes.modes = swept_modes;
      modes.impulses = swept_impulses;
    }
    return false;
  }

  bool solve_soft(double ridge) {
    const std::vector<ContactMode> old_modes = modes.modes;
    const std::vector<double> old_impulses = modes.impulses;
    std::fill(modes.impulses.begin(), modes.impulses.end(), 0.0);
    if (modes.run_near(ridge, k_max_soft_rounds)) return true;
    modes.modes = old_modes;
    modes.impulses = old_impulses;
    return modes.follow(k_max_path_steps + 2 * static_cast<int>(old_modes.size()), ridge);
  }

  // By the general solver, which finds all that has a solution, but not as fast.
  LcpStatus search_dense(const ContactSystem& problem) {
    const LcpResult& result = solve_lcp(as_lcp(problem), RobustSettings{}, lcp);
    if (result.status == LcpStatus::bad_input) return LcpStatus::numerical;
    const Index m = problem.contacts.size();
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
  } else if (search.rounding() > k_rest_rounding && !parts_->run()) {
    search.modes = modes;
    search.impulses = parts_->start_impulses;
    if (!parts_->sweep_and_run() && !parts_->harden() && !parts_->offer() &&
        parts_->best_residual > k_accepted_residual) {
      status = LcpStatus::iteration_limit;
      if (system.contacts.size() <= k_max_dense_contacts) status = parts_->search_dense(system);
    }
  }
  search.impulses = parts_->best_impulses;
  search.project();
  modes = parts_->best_modes;
  impulses = search.impulses;
  velocity = search.find_velocities();
  return {status, parts_->best_residual, search.factorisations()};
}

}  // namespace tumble
