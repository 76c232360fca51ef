#include "tumble/lcp/solve.hpp"

namespace tumble {
namespace {

LcpResult run(const LcpProblem& problem, const LemkeSettings& settings) { return lemke(problem, settings); }
LcpResult run(const LcpProblem& problem, const EnumerateSettings& settings) { return enumerate(problem, settings); }

}  // namespace

LcpResult solve_lcp(const LcpProblem& problem, const LcpSettings& settings) {
  return std::visit([&](const auto& chosen) { return run(problem, chosen); }, settings);
}

}  // namespace tumble
