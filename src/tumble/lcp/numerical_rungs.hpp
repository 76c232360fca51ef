// The rungs of the ladder that work in doubles or in 113 bits. Not a public header.
#pragma once

#include <span>

#include "tumble/lcp/rung.hpp"

namespace tumble {

// One step of the ladder: improves workspace.result, or leaves it.
using Rung = void (*)(const LcpProblem&, const RobustSettings&, LcpWorkspace&);

// Judges buffers.z.
void offer(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace);

// True once a rung has solved the problem, or proved that nothing can.
bool climb(std::span<const Rung> ladder, const LcpProblem& problem, const RobustSettings& settings,
           LcpWorkspace& workspace);

// For problems made of contacts: one in closed form; Newton on their modes. They need no scaling, as units of contacts
// cannot mislead them.
bool climb_contacts(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace);

void try_warm_start(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace);
void try_lemke(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace);
void try_lemke_lu(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace);
void try_infeasible(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace);
void try_lemke_quad(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace);
void try_ridge(const LcpProblem& problem, const RobustSettings& settings, LcpWorkspace& workspace);

}  // namespace tumble
