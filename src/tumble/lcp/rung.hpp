// What the methods share: a problem made ready, and candidates judged against it. Not a public header.
#pragma once

#include "tumble/lcp/buffers.hpp"
#include "tumble/lcp/dantzig.hpp"
#include "tumble/lcp/lemke.hpp"
#include "tumble/lcp/lemke_lu.hpp"
#include "tumble/lcp/murty.hpp"
#include "tumble/lcp/newton.hpp"
#include "tumble/lcp/nlgs.hpp"
#include "tumble/lcp/pgs.hpp"
#include "tumble/lcp/problem.hpp"
#include "tumble/lcp/robust.hpp"
#include "tumble/lcp/workspace.hpp"

namespace tumble {

// Looks for contacts and finds row sizes, into the buffers; clears `result`. The problem must be valid.
void start(const LcpProblem& problem, LcpWorkspace& workspace);

// The same, and scales the problem into the buffers.
void prepare(const LcpProblem& problem, LcpWorkspace& workspace);

// q >= 0 is solved by z = 0: true, and the result filled, if that is so.
bool solve_trivially(const LcpProblem& problem, LcpWorkspace& workspace);

// Judges buffers.z, and takes it, with its w, as the result if it is better than what the result holds.
void judge_candidate(const LcpProblem& problem, LcpWorkspace& workspace);

// The status of a method whose pivots ended with `status`: solved if the residual is accepted, however they ended;
// numerical if they ended as they should and it is not; else theirs.
void conclude(LcpStatus status, double accepted_residual, LcpResult& result);

// Solves M_BB z_B = -q_B for the basis given, in scaled numbers, into buffers.z_scaled. False if M_BB is singular, up
// to `tolerance` as in `DenseLu::factor`.
bool solve_basis(const std::vector<std::uint8_t>& basis, LcpWorkspace::Buffers& buffers, double tolerance = 0.0);

// The tolerance for methods that go on from z: a pivot below is round-off, and so is the z divided by it.
inline constexpr double k_singular = 1e-14;

// Lemke's method on a prepared problem. Improves workspace.result, adds to its pivots, sets its status.
void run_lemke(const LcpProblem& problem, const LemkeSettings& settings, LcpWorkspace& workspace);

// The same on LU factors of the basis.
void run_lemke_lu(const LcpProblem& problem, const LemkeLuSettings& settings, LcpWorkspace& workspace);

// The methods for comparison, on a prepared problem as well.
void run_murty(const LcpProblem& problem, const MurtySettings& settings, LcpWorkspace& workspace);
void run_dantzig(const LcpProblem& problem, const DantzigSettings& settings, LcpWorkspace& workspace);
void run_newton(const LcpProblem& problem, const NewtonSettings& settings, LcpWorkspace& workspace);

// Sweeps, for which `start` is enough.
void run_pgs(const LcpProblem& problem, const PgsSettings& settings, LcpWorkspace& workspace);
void run_nlgs(const LcpProblem& problem, const NlgsSettings& settings, LcpWorkspace& workspace);

// A method as the only one: prepares, takes z = 0 if that is a solution, else runs it.
template <class Settings>
void solve_prepared(const LcpProblem& problem, const Settings& settings, LcpWorkspace& workspace,
                    void (*run)(const LcpProblem&, const Settings&, LcpWorkspace&)) {
  prepare(problem, workspace);
  if (!solve_trivially(problem, workspace)) run(problem, settings, workspace);
}

// The same for a method that needs no scaled problem: scaling takes longer than many sweeps.
template <class Settings>
void solve_unscaled(const LcpProblem& problem, const Settings& settings, LcpWorkspace& workspace,
                    void (*run)(const LcpProblem&, const Settings&, LcpWorkspace&)) {
  start(problem, workspace);
  if (!solve_trivially(problem, workspace)) run(problem, settings, workspace);
}

// The ladder without fractions and enumeration, of which contacts of a step have no need; on a valid problem with row
// sizes.
void run_numerical(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace);

// The whole ladder, on a valid problem.
void run_robust(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace);

}  // namespace tumble
