#include "tumble/contact/island_solver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tumble/lcp/body_modes.hpp"
#include "tumble/lcp/rung.hpp"
#include "tumble/math/numeric.hpp"

namespace tumble {
namespace {

using Index = std::size_t;

constexpr double k_accepted_residual = 1e-10;
constexpr double k_rest_residual = 1e-14;  // what is left is round-off: nothing to improve
constexpr double k_path_ridge = 1e-6;      // [-]
constexpr int k_max_path_pieces = 150;
constexpr int k_first_rounds = 8;   // of Newton's method: where it gets there, it does so in a few
constexpr int k_last_rounds = 2;    // the same, near the solution
constexpr int k_first_sweeps = 20;  // from there on, sweeps no longer choose the modes best
constexpr double k_first_ridge = 1e-3, k_last_ridge = 1e-9;  // [-]
constexpr int k_max_proximal_steps = 30;
constexpr int k_near_rounds = 3, k_max_near_pieces = 50;  // of Newton's method near a point, and of the path to it
constexpr int k_more_sweeps = 10;
constexpr double k_close_residual = 1e-5;   // then the modes may be those of rigid contacts
constexpr Index k_max_exact_contacts = 50;  // of the fast solver: as fast as sweeps, and at rest faster
constexpr double k_fast_change = 2e-3;      // of the speeds in a sweep: the next ones are left to the next step
constexpr Index k_max_dense_contacts = 40;  // above, the dense LCP takes longer than a step is worth

}  // namespace

struct IslandSolver::Parts {
  // Where a method that may lead nowhere starts.
  struct Start {
    std::vector<ContactMode> modes;
    std::vector<double> impulses;
    void keep(const BodyModes& from) {
      modes = from.modes;
      impulses = from.impulses;
    }
    void give_back(BodyModes& to) const {
      to.modes = modes;
      to.impulses = impulses;
    }
  };

  BodyModes modes;
  LcpWorkspace lcp;
  std::vector<ContactMode> best_modes;
  std::vector<double> best_impulses;
  double residual = 0.0, best_residual = 0.0;
  Start start, given;
  bool is_close = false;  // a path led to what is nearly a solution

  // Keeps what is better than all before. True if it is good enough.
  bool offer() {
    residual = modes.residual();
    if (residual < best_residual) {
      best_residual = residual;
      best_modes = modes.modes;
      best_impulses = modes.impulses;
    }
    return residual <= k_accepted_residual;
  }

  bool run(int max_rounds) { return modes.run(max_rounds) && offer(); }

  // Where contacts give way a little, the modes may be those of rigid ones: then these are solved to round-off.
  bool finish() {
    modes.project();
    offer();
    if (residual > k_close_residual) return false;
    start.keep(modes);
    if (run(k_last_rounds)) return true;
    start.give_back(modes);
    return !has_dense() && best_residual <= k_accepted_residual;
  }

  // Small islands are solved to round-off, if need be by the general solver.
  bool has_dense() const { return modes.modes.size() <= k_max_dense_contacts; }

  // From a solution of a problem like this one, that of the last step or with fewer contacts.
  bool follow() {
    if (!modes.follow_near(k_path_ridge, k_max_path_pieces)) return false;
    if (finish()) return true;
    is_close = residual <= k_close_residual;
    return false;
  }

  bool start_from(const std::vector<double>& impulses) {
    is_close = false;
    start.keep(modes);
    const bool is_cold = std::all_of(impulses.begin(), impulses.end(), [](double f) { return f == 0.0; });
    if (run(is_cold ? k_first_rounds : k_last_rounds)) return true;
    if (is_cold) return false;
    start.give_back(modes);
    return follow();
  }

  // The method of proximal points [Rockafellar 1976]: contacts that give way when their impulses change have modes that
  // are easy to find, and with each point they come to the rigid ones closer. They give way less and less, as far as
  // the modes can be found.
  bool approach(double ridge) {
    for (int step = 0; step < k_max_proximal_steps; ++step) {
      start.keep(modes);
      if (!modes.run_near(ridge, k_near_rounds) &&
          (start.give_back(modes), !modes.follow_near(ridge, k_max_near_pieces))) {
        start.give_back(modes);
        modes.sweep(k_more_sweeps);
        if (finish()) return true;
        ridge = std::min(10.0 * ridge, 1.0);
        continue;
      }
      if (finish()) return true;
      ridge = std::max(0.1 * ridge, k_last_ridge);
    }
    return false;
  }

  bool solve_exactly(const std::vector<double>& impulses) {
    given.keep(modes);
    if (start_from(impulses) || (is_close && approach(k_path_ridge))) return true;
    given.give_back(modes);
    modes.sweep(k_first_sweeps);
    return finish() || approach(k_first_ridge);
  }

  // By the general solver, which finds all that has a solution, but not as fast.
  LcpStatus search_dense(const ContactSystem& problem) {
    const LcpProblem dense = as_lcp(problem);
    if (!all_finite(dense.M) || !all_finite(dense.q)) return LcpStatus::numerical;
    run_numerical(dense, RobustSettings{}, lcp);
    const LcpResult& result = lcp.result;
    const Index m = problem.contacts.size();
    for (Index i = 0; i < m; ++i) {
      modes.impulses[2 * i] = result.z[i];
      modes.impulses[2 * i + 1] = result.z[m + 2 * i] - result.z[m + 2 * i + 1];
      const double f_t = modes.impulses[2 * i + 1];
      modes.modes[i] = contact_mode(result.z[i], result.z[3 * m + i], f_t != 0.0 ? -f_t : 1.0);
    }
    start.keep(modes);
    if (offer() || run(k_last_rounds)) return LcpStatus::solved;
    if (result.status != LcpStatus::solved) return result.status;
    start.give_back(modes);
    best_residual = result.residual;
    best_modes = modes.modes;
    best_impulses = modes.impulses;
    return LcpStatus::solved;
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
  parts_->best_modes = modes;
  parts_->best_impulses = impulses;
  LcpStatus status = LcpStatus::solved;
  const bool is_fast = settings.solver == ContactSolver::fast;
  const bool is_rough = is_fast && system.contacts.size() > k_max_exact_contacts;
  if (parts_->best_residual > k_rest_residual && (is_rough || !parts_->solve_exactly(impulses))) {
    if (is_fast) {
      search.modes = modes;
      search.impulses = impulses;
      search.sweep(settings.num_sweeps, k_fast_change);
      parts_->best_modes = search.modes;
      parts_->best_impulses = search.impulses;
      parts_->best_residual = search.residual();
    } else if (parts_->has_dense()) {
      status = parts_->search_dense(system);
    } else if (parts_->best_residual > k_accepted_residual) {
      status = LcpStatus::iteration_limit;
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
