// Runs every solver on every case, whatever the solvers do.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "solver.hpp"

namespace tumble::bench {

enum class Verdict { good, said_no, wrong, crashed, timed_out };

// "good", "said no" and so on.
const char* to_string(Verdict verdict);

// An answer above this that a solver calls solved is wrong.
inline constexpr double k_good_residual = 1e-6;

struct Measurement {
  std::size_t case_index = 0;
  std::size_t solver_index = 0;
  Verdict verdict = Verdict::crashed;
  double residual = 0.0;  // of the answer, by `residual`; also if the solver said no
  double seconds = 0.0;   // of one run: the best of a few
  int pivots = -1;        // -1 if unknown
};

// In the order of cases, then of solvers, without pairs where the solver is not for the case. Solvers run in a child
// process whose output goes nowhere: one that crashes or takes more than `time_limit` seconds loses this case only.
// `progress` is called with the number of cases done. Verdict: a solver that is right to say that a case has no
// solution is good.
std::vector<Measurement> measure(const std::vector<Case>& cases, const std::vector<Solver>& solvers, double time_limit,
                                 const std::function<void(std::size_t)>& progress);

}  // namespace tumble::bench
