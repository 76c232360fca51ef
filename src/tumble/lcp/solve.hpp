// One door to the solvers: the type of the settings picks the method.
#pragma once

#include <variant>

#include "tumble/lcp/dantzig.hpp"
#include "tumble/lcp/enumerate.hpp"
#include "tumble/lcp/lemke.hpp"
#include "tumble/lcp/lemke_lu.hpp"
#include "tumble/lcp/murty.hpp"
#include "tumble/lcp/newton.hpp"
#include "tumble/lcp/nlgs.hpp"
#include "tumble/lcp/pgs.hpp"
#include "tumble/lcp/robust.hpp"
#include "tumble/lcp/workspace.hpp"

namespace tumble {

using LcpSettings = std::variant<RobustSettings, LemkeSettings, LemkeLuSettings, EnumerateSettings, MurtySettings,
                                 DantzigSettings, NewtonSettings, PgsSettings, NlgsSettings>;

// Throws std::invalid_argument, naming the field, for a setting outside its range.
void validate(const LcpSettings& settings);

// Solves with the method that the settings belong to. Errors and statuses are those of that method.
LcpResult solve_lcp(const LcpProblem& problem, const LcpSettings& settings = RobustSettings{});

// The same into workspace.result, which is returned, for loops that solve again and again: once the workspace has met a
// problem of this size, no method but `enumerate` allocates memory (but for the rare problems that `robust` solves with
// 113 bits). A problem that `validate` would refuse gets the status bad_input; the settings must be valid.
const LcpResult& solve_lcp(const LcpProblem& problem, const LcpSettings& settings, LcpWorkspace& workspace);

}  // namespace tumble
