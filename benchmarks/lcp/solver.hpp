// What the comparison measures: cases, and solvers that attempt them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tumble/lcp/contact_system.hpp"
#include "tumble/lcp/result.hpp"

namespace tumble::bench {

struct Case {
  std::string group;  // cases of one group share a table
  std::string name;
  LcpProblem problem;
  std::optional<ContactSystem> contacts;  // what the problem was made of, for solvers of contact problems
  bool has_no_solution = false;           // known for sure: the right answer is "no"
  std::vector<std::uint8_t> start_basis;  // of a problem like this one, for warm starts; else empty
};

struct Answer {
  bool is_solved = false;     // what the solver says
  std::span<const double> z;  // n; may be anything if it does not say so
  int pivots = -1;            // if known
};

// One case made ready for one solver: whatever it needs is converted and allocated before the clock runs.
struct Attempt {
  std::function<void()> run;       // timed; called again and again, each time from the start
  std::function<Answer()> answer;  // of the last run
};

struct Solver {
  std::string name;
  std::function<std::optional<Attempt>(const Case&)> prepare;  // nothing: not a solver for this case
};

// Ours: every method of `lcp_methods`, and what is none of them.
std::vector<Solver> our_solvers();

// Of other projects; empty if the package was not found when this was built.
std::vector<Solver> siconos_solvers();
std::vector<Solver> bullet_solvers();
std::vector<Solver> dart_solvers();

}  // namespace tumble::bench
