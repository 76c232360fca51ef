#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "solver.hpp"

#include "tumble/lcp/one_contact.hpp"
#include "tumble/lcp/solve.hpp"

namespace tumble::bench {
namespace {

constexpr std::size_t k_any_size = std::numeric_limits<std::size_t>::max();

// A method of `solve_lcp`, for cases up to a size.
Solver method(const std::string& name, const LcpSettings& settings, std::size_t max_size = k_any_size) {
  return {name, [=](const Case& c) -> std::optional<Attempt> {
            if (c.problem.size() > max_size) return std::nullopt;
            auto workspace = std::make_shared<LcpWorkspace>();
            const LcpProblem& problem = c.problem;
            return Attempt{[=, &problem] { solve_lcp(problem, settings, *workspace); },
                           [=] {
                             const LcpResult& result = workspace->result;
                             return Answer{result.status == LcpStatus::solved, result.z, result.pivots};
                           }};
          }};
}

// The same from the basis of a problem like this one.
template <class Settings>
Solver warm(const std::string& name) {
  return {name, [=](const Case& c) -> std::optional<Attempt> {
            if (c.start_basis.empty()) return std::nullopt;
            Settings settings;
            settings.start_basis = c.start_basis;
            return method(name, settings).prepare(c);
          }};
}

std::optional<Attempt> prepare_closed_form(const Case& c) {
  if (!c.contacts || c.problem.size() != 4) return std::nullopt;
  struct State {
    OneContact contact;
    OneContactSolution solution{};
    std::vector<double> z = std::vector<double>(4);
  };
  const LcpProblem& p = c.problem;
  auto state = std::make_shared<State>(State{{p(0, 0), p(0, 1), p(1, 1), p.q[0], p.q[1], p(3, 0)}});
  return Attempt{[=] { state->solution = solve_one_contact(state->contact); },
                 [=] {
                   const OneContactSolution& s = state->solution;
                   state->z = {s.f_n, std::max(s.f_t, 0.0), std::max(-s.f_t, 0.0), s.slip_speed};
                   return Answer{s.status == LcpStatus::solved, state->z};
                 }};
}

}  // namespace

std::vector<Solver> our_solvers() {
  return {
      method("robust", RobustSettings{}),          warm<RobustSettings>("robust, warm"),
      method("lemke", LemkeSettings{}, 200),       method("lemke_lu", LemkeLuSettings{}),
      method("enumerate", EnumerateSettings{}, 8), {"one_contact", prepare_closed_form},
  };
}

}  // namespace tumble::bench
