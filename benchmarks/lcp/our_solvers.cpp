#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string_view>

#include "solver.hpp"

#include "tumble/lcp/methods.hpp"
#include "tumble/lcp/one_contact.hpp"

namespace tumble::bench {
namespace {

constexpr std::size_t k_any_size = std::numeric_limits<std::size_t>::max();

// The largest n that a method gets; one that is not named gets any. Above these a method takes seconds per problem, or
// fails most.
struct SizeLimit {
  std::string_view method;
  std::size_t n;
};
constexpr SizeLimit k_size_limits[] = {{"lemke", 200}, {"newton", 160}, {"dantzig", 160},
                                       {"murty", 48},  {"pgs", 48},     {"enumerate", 8}};

std::size_t size_limit(std::string_view method) {
  for (const SizeLimit& limit : k_size_limits) {
    if (limit.method == method) return limit.n;
  }
  return k_any_size;
}

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
  std::vector<Solver> solvers;
  for (const LcpMethod& m : lcp_methods()) {
    solvers.push_back(method(std::string(m.name), m.defaults, size_limit(m.name)));
  }
  solvers.push_back(warm<RobustSettings>("robust, warm"));
  solvers.push_back({"one_contact", prepare_closed_form});
  return solvers;
}

}  // namespace tumble::bench
