#include "tumble/lcp/nlgs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tumble/lcp/one_contact.hpp"
#include "tumble/lcp/require.hpp"
#include "tumble/lcp/rung.hpp"
#include "tumble/lcp/solve.hpp"

namespace tumble {
namespace {

using Index = std::size_t;

constexpr int k_sweeps_per_check = 10;

// Impulses f and modes of the contacts, and how a sweep changes them.
struct Sweeper {
  const ContactStructure& structure;
  const std::vector<double>& row_sizes;
  std::vector<double>& f;  // per contact (n, t)
  std::vector<ContactMode>& modes;

  struct Velocity {
    double value;  // of row r of A f + b
    double terms;  // the size of what it is a sum of
  };

  Velocity velocity(Index r) const {
    Velocity u{structure.b[r], std::abs(structure.b[r])};
    for (Index e = structure.row_begin[r]; e < structure.row_begin[r + 1]; ++e) {
      const double term = structure.entry[e] * f[static_cast<Index>(structure.column[e])];
      u.value += term;
      u.terms += std::abs(term);
    }
    return u;
  }

  double entry(Index row, Index column) const {
    for (Index e = structure.row_begin[row]; e < structure.row_begin[row + 1]; ++e) {
      if (structure.column[e] == static_cast<int>(column)) return structure.entry[e];
    }
    return 0.0;
  }

  double size_of(int row, double terms) const { return row_sizes[static_cast<Index>(row)] + terms; }

  // Solves the block of one contact. Returns by how much its velocities change, relative to their terms.
  double solve(Index i) {
    const ContactPlace& place = structure.places[i];
    if (place.c < 0) return 0.0;
    const Index n = 2 * i, t = n + 1;
    const Velocity u_n = velocity(n);
    const double A_nn = structure.diagonal[n];
    const double old_n = f[n];
    if (!place.has_friction()) {
      f[n] = std::max(old_n - u_n.value / A_nn, 0.0);
      modes[i] = f[n] > 0.0 ? ContactMode::slip_right : ContactMode::open;
      return relative(A_nn * (f[n] - old_n), size_of(place.c, u_n.terms));
    }
    const Velocity u_t = velocity(t);
    const double A_tt = structure.diagonal[t], A_nt = entry(n, t);
    const double old_t = f[t];
    solve_with_friction({A_nn, A_nt, A_tt, u_n.value - A_nn * old_n - A_nt * old_t,
                         u_t.value - A_nt * old_n - A_tt * old_t, place.mu()},
                        i);
    const double change_n = f[n] - old_n, change_t = f[t] - old_t;
    return std::max(relative(A_nn * change_n + A_nt * change_t, size_of(place.c, u_n.terms)),
                    relative(A_nt * change_n + A_tt * change_t, size_of(place.plus, u_t.terms)));
  }

  static double relative(double change, double size) { return size > 0.0 ? std::abs(change) / size : 0.0; }

  void solve_with_friction(const OneContact& contact, Index i) {
    const OneContactSolution solution = solve_one_contact(contact);
    double& f_n = f[2 * i];
    double& f_t = f[2 * i + 1];
    if (solution.status == LcpStatus::solved) {
      f_n = solution.f_n;
      f_t = solution.f_t;
      modes[i] = solution.mode;
      return;
    }
    // A block that is singular up to round-off: one unknown after the other.
    f_n = std::max(-(contact.b_n + contact.A_nt * f_t) / contact.A_nn, 0.0);
    const double limit = contact.friction * f_n;
    const double sticking = -(contact.b_t + contact.A_nt * f_n) / contact.A_tt;
    f_t = std::clamp(sticking, -limit, limit);
    modes[i] = !(f_n > 0.0)        ? ContactMode::open
               : sticking < -limit ? ContactMode::slip_right
               : sticking > limit  ? ContactMode::slip_left
                                   : ContactMode::stick;
  }

  double sweep() {
    double change = 0.0;
    for (Index i = 0; i < structure.places.size(); ++i) change = std::max(change, solve(i));
    return change;
  }

  void read(const std::vector<double>& z) {
    const Index m = structure.places.size();
    f.assign(2 * m, 0.0);
    modes.assign(m, ContactMode::open);
    if (z.empty()) return;
    const auto value = [&](int j) { return z[static_cast<Index>(j)]; };
    for (Index i = 0; i < m; ++i) {
      const ContactPlace& place = structure.places[i];
      if (place.c < 0) continue;
      f[2 * i] = value(place.c);
      if (place.has_friction()) f[2 * i + 1] = value(place.plus) - value(place.minus);
    }
  }

  void write(std::vector<double>& u, std::vector<double>& z, std::vector<std::uint8_t>& basis) const {
    u.resize(f.size());
    for (Index r = 0; r < u.size(); ++r) u[r] = velocity(r).value;
    write_contacts(structure, modes, f, u, z, basis);
  }
};

// Each row a block of its own. False if some row does not respond to its own unknown.
bool take_rows_as_blocks(const LcpProblem& problem, ContactStructure& structure) {
  structure.places.clear();
  for (Index i = 0; i < problem.size(); ++i) {
    if (!(problem(i, i) > 0.0)) return false;
    structure.places.emplace_back().c = static_cast<int>(i);
  }
  return read_responses(problem, structure);
}

}  // namespace

void validate(const NlgsSettings& settings) {
  require(settings.max_sweeps >= 1, "max_sweeps", ">= 1", settings.max_sweeps);
  require_accepted_residual(settings.accepted_residual);
  require_nonnegative(settings.start_z, "start_z");
}

void run_nlgs(const LcpProblem& problem, const NlgsSettings& settings, LcpWorkspace& workspace) {
  LcpWorkspace::Buffers& buffers = workspace.buffers();
  LcpResult& result = workspace.result;
  result.rung = LcpRung::nlgs;
  buffers.z.assign(problem.size(), 0.0);
  std::copy(settings.start_z.begin(), settings.start_z.end(), buffers.z.begin());
  judge_candidate(problem, workspace);
  for (Index i = 0; i < problem.size(); ++i) result.basis[i] = result.z[i] > 0.0;
  result.status = result.residual <= settings.accepted_residual ? LcpStatus::solved : LcpStatus::numerical;
  if (result.status == LcpStatus::solved) return;
  if (!buffers.has_contacts && !take_rows_as_blocks(problem, buffers.contacts)) return;
  Sweeper sweeper{buffers.contacts, buffers.row_sizes.round_off, buffers.impulses, buffers.impulse_modes};
  sweeper.read(settings.start_z);
  for (int until_check = k_sweeps_per_check; result.pivots < settings.max_sweeps;) {
    const double change = sweeper.sweep();
    ++result.pivots;
    --until_check;
    // What a sweep still changes is about the residual; to compute that itself takes all of M.
    const bool is_last = result.pivots == settings.max_sweeps;
    if (!is_last && (until_check > 0 || change > settings.accepted_residual)) continue;
    until_check = k_sweeps_per_check;
    const double before = result.residual;
    sweeper.write(buffers.values, buffers.z, buffers.basis);
    judge_candidate(problem, workspace);
    if (result.residual < before) std::swap(result.basis, buffers.basis);
    if (result.residual <= settings.accepted_residual) break;
  }
  result.status = result.residual <= settings.accepted_residual ? LcpStatus::solved : LcpStatus::iteration_limit;
}

LcpResult nlgs(const LcpProblem& problem, const NlgsSettings& settings) { return solve_lcp(problem, settings); }

}  // namespace tumble
