// One door to the solvers: the type of the settings picks the method.
#pragma once

#include <variant>

#include "tumble/lcp/enumerate.hpp"
#include "tumble/lcp/lemke.hpp"

namespace tumble {

using LcpSettings = std::variant<LemkeSettings, EnumerateSettings>;

// Solves with the method that the settings belong to. Errors and statuses are those of that method.
LcpResult solve_lcp(const LcpProblem& problem, const LcpSettings& settings = LemkeSettings{});

}  // namespace tumble
