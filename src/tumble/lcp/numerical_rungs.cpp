#include "tumble/lcp/numerical_rungs.hpp"

#include <array>
#include <initializer_list>
#include <utility>

#include "tumble/lcp/infeasibility.hpp"

namespace tumble {
namespace {

// Above these sizes a method takes longer than it is worth: the tableau than LU factors do, 113 bits from the start
// minutes, 113 bits from a basis that is nearly right also.
constexpr std::size_t k_max_tableau_size = 100;
constexpr std::size_t k_max_quad_size = 100;
constexpr std::size_t k_max_quad_correction_size = 600;
constexpr std::size_t k_max_infeasibility_size = 200;  // above, the search takes minutes

bool is_decided(const LcpResult& result) {
  return result.status == LcpStatus::solved || result.status == LcpStatus::infeasible ||
         result.status == LcpStatus::no_solution_proved;
}

void try_closed_form(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace) {
  LcpWorkspace::Buffers& buffers = workspace.buffers();
  const ContactPlace& place = buffers.contacts.places.front();
  if (problem.size() != 4 || place.c < 0) return;
  const auto c = static_cast<std::size_t>(place.c), plus = static_cast<std::size_t>(place.plus);
  const OneContactSolution solution = solve_one_contact(
      {problem(c, c), problem(c, plus), problem(plus, plus), problem.q[c], problem.q[plus], place.mu()});
  LcpResult& result = workspace.result;
  result.rung = LcpRung::closed_form;
  const double slip = solution.mode == ContactMode::slip_left ? -solution.slip_speed : solution.slip_speed;
  const double u_t = solution.mode == ContactMode::open ? problem.q[plus] : slip;
  buffers.modes.modes.assign(1, solution.mode);
  buffers.values.assign({solution.f_n, solution.f_t});
  buffers.step.assign({0.0, u_t});
  write_contacts(buffers.contacts, buffers.modes.modes, buffers.values, buffers.step, buffers.z, result.basis);
  offer(problem, settings, workspace);
}

constexpr int k_max_newton_rounds = 30;  // where it gets there, it does so in a few
constexpr int k_max_single_changes = 30;
constexpr int k_max_path_steps = 20;  // and 2 per contact

enum class ModeSearch { newton, one_by_one, path };

void run_modes(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace, ModeSearch search) {
  LcpWorkspace::Buffers& buffers = workspace.buffers();
  LcpResult& result = workspace.result;
  const auto count = [&](bool is_done) {
    result.pivots += buffers.modes.factorisations() - 1;
    result.refactorisations += buffers.modes.factorisations();
    return is_done;
  };
  const int m = static_cast<int>(buffers.modes.modes.size());
  if (search == ModeSearch::path && !count(buffers.modes.follow(buffers.contacts, k_max_path_steps + 2 * m))) return;
  const bool is_one_by_one = search == ModeSearch::one_by_one;
  const auto change = is_one_by_one ? ContactModes::Change::worst : ContactModes::Change::all;
  const int max_rounds = is_one_by_one ? k_max_single_changes : k_max_newton_rounds;
  if (!count(buffers.modes.run(buffers.contacts, change, max_rounds))) return;
  write_contacts(buffers.contacts, buffers.modes.modes, buffers.modes.impulses(), buffers.modes.velocities(), buffers.z,
                 result.basis);
  offer(problem, settings, workspace);
}

void try_modes(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace) {
  LcpWorkspace::Buffers& buffers = workspace.buffers();
  if (!settings.start_basis.empty()) {
    workspace.result.rung = LcpRung::warm_start;
    buffers.modes.read_basis(buffers.contacts, settings.start_basis);
    run_modes(problem, settings, workspace, ModeSearch::newton);
    if (workspace.result.status == LcpStatus::solved) return;
  }
  workspace.result.rung = LcpRung::contact_modes;
  buffers.modes.start(buffers.contacts);
  // From cheap to dear, each with a better guess: the sweeps add up.
  struct Attempt {
    int num_sweeps;
    ModeSearch search;
  };
  for (const Attempt attempt : {Attempt{2, ModeSearch::newton},
                                {10, ModeSearch::newton},
                                {20, ModeSearch::path},
                                {40, ModeSearch::path},
                                {80, ModeSearch::path},
                                {160, ModeSearch::path},
                                {1, ModeSearch::one_by_one}}) {
    buffers.modes.sweep(buffers.contacts, attempt.num_sweeps);
    if (attempt.search == ModeSearch::newton) buffers.modes.hold(buffers.contacts);
    run_modes(problem, settings, workspace, attempt.search);
    if (workspace.result.status == LcpStatus::solved) return;
  }
}

// Lemke with 113 bits, for M as it is or with a tiny diagonal: contacts that depend on each other to the last bits
// share their load once they have one. It must be above the round-off of M, which leaves rays, and the residual grows
// with it. Large problems start from the last basis met, if it is nearly right.
void run_quad(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace,
              std::initializer_list<double> ridges) {
  constexpr double nearly_right = 1e-3;
  const std::size_t n = problem.size();
  LcpResult& result = workspace.result;
  LemkeLuSettings quad{.pivot_tolerance = 1e-20,
                       .accepted_residual = settings.accepted_residual,
                       .precision = Precision::quad_precision};
  if (n > k_max_quad_size) {
    if (n > k_max_quad_correction_size || !(result.residual <= nearly_right)) return;
    quad.max_pivots = static_cast<int>(n);
    quad.start_basis = result.basis;
  }
  for (const double ridge : ridges) {
    quad.ridge = ridge;
    run_lemke_lu(problem, quad, workspace);
    if (result.status == LcpStatus::solved) return;
  }
}

}  // namespace

void offer(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace) {
  judge_candidate(problem, workspace);
  conclude(workspace.result.status, settings.accepted_residual, workspace.result);
}

bool climb(std::span<const Rung> ladder, const LcpProblem& problem, const RobustSettings& settings,
           LcpWorkspace& workspace) {
  for (const Rung rung : ladder) {
    rung(problem, settings, workspace);
    if (is_decided(workspace.result)) return true;
  }
  return false;
}

bool climb_contacts(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace) {
  constexpr std::array<Rung, 2> ladder = {try_closed_form, try_modes};
  return climb(ladder, problem, settings, workspace);
}

void try_warm_start(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace) {
  if (settings.start_basis.empty()) return;
  LcpResult& result = workspace.result;
  result.rung = LcpRung::warm_start;
  result.basis = settings.start_basis;
  ++result.refactorisations;
  if (!solve_basis(result.basis, workspace.buffers())) return;
  unscale(workspace.buffers().scaled, workspace.buffers().z_scaled, workspace.buffers().z);
  offer(problem, settings, workspace);
}

void try_lemke(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace) {
  const int n = static_cast<int>(problem.size());
  if (problem.size() > k_max_tableau_size) return;
  run_lemke(problem, {.max_pivots = 10 * n + 100, .accepted_residual = settings.accepted_residual}, workspace);
}

void try_lemke_lu(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace) {
  run_lemke_lu(problem, {.accepted_residual = settings.accepted_residual}, workspace);
  for (int cover = 1; cover <= 3 && workspace.result.status == LcpStatus::iteration_limit; ++cover) {  // a circle
    run_lemke_lu(problem, {.accepted_residual = settings.accepted_residual, .cover = cover}, workspace);
  }
}

// Lemke's ray is a proof itself where M is copositive-plus [Cottle 1992, theorem 4.4.11]; else one is looked for.
void try_infeasible(const LcpProblem& problem, const RobustSettings&, LcpWorkspace& workspace) {
  LcpResult& result = workspace.result;
  if (!is_infeasibility_certificate(problem, result.certificate)) {
    if (problem.size() > k_max_infeasibility_size) return;
    std::vector<double> y = find_infeasibility(problem);
    if (y.empty()) return;
    result.certificate = std::move(y);
  }
  result.status = LcpStatus::infeasible;
}

void try_lemke_quad(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace) {
  run_quad(problem, settings, workspace, {0.0, 1e-14, 1e-15, 1e-16, 1e-13});
}

// For large problems.
void try_ridge(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace) {
  if (problem.size() <= k_max_quad_size) return;
  for (const double ridge : {1e-11, 1e-9, 1e-7}) {
    run_lemke_lu(problem, {.accepted_residual = settings.accepted_residual, .cover = 1, .ridge = ridge}, workspace);
    if (workspace.result.status == LcpStatus::solved) return;
    run_quad(problem, settings, workspace, {0.0, 1e-14});
    if (workspace.result.status == LcpStatus::solved) return;
  }
}

void run_numerical(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace) {
  constexpr std::array<Rung, 6> ladder = {try_warm_start, try_lemke,      try_lemke_lu,
                                          try_infeasible, try_lemke_quad, try_ridge};
  start(problem, workspace);
  if (solve_trivially(problem, workspace)) return;
  if (workspace.buffers().has_contacts && climb_contacts(problem, settings, workspace)) return;
  scale(problem, workspace.buffers().scaled);
  climb(ladder, problem, settings, workspace);
}

}  // namespace tumble
