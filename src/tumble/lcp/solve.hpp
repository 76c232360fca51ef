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
// problem of this size, memory is allocated only by `enumerate`, by `lemke_lu` where its factors are sparse (large
// problems), and by what `robust` tries last: those two, 113 bits, exact arithmetic and the search for a proof. A
// problem that `validate` would refuse, that does not fit the start of the settings, or that is too large for
// `enumerate` gets the status bad_input. Throws std::invalid_argument for a setting outside its range.
const LcpResult& solve_lcp(const LcpProblem& problem, const LcpSettings& settings, LcpWorkspace& workspace);

}  // namespace tumble
