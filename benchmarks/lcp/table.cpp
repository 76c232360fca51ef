#include "table.hpp"

#include <algorithm>
#include <map>

#include "median.hpp"

#include "tumble/math/format.hpp"
#include "tumble/math/numeric.hpp"

namespace tumble::bench {
namespace {

std::string time_text(double seconds) {
  if (seconds < 1e-6) return tumble::format("{:.0f} ns", 1e9 * seconds);
  if (seconds < 1e-3) return tumble::format("{:.3g} us", 1e6 * seconds);
  return tumble::format("{:.3g} ms", 1e3 * seconds);
}

// Whether the solver came to an end: else `seconds` is no time of a run.
bool has_ended(const Measurement& m) { return m.verdict != Verdict::crashed && m.verdict != Verdict::timed_out; }

// All measurements of one solver in one group.
std::string row(const std::string& solver, const std::vector<Case>& cases, const std::vector<Measurement>& measurements,
                const std::map<std::size_t, double>& reference_seconds) {
  std::map<Verdict, int> count;
  double worst = 0.0;
  std::vector<double> seconds, ratios, pivots;
  for (const Measurement& m : measurements) {
    ++count[m.verdict];
    if (!has_ended(m)) continue;
    if (m.verdict == Verdict::good && !cases[m.case_index].has_no_solution) worst = std::max(worst, m.residual);
    seconds.push_back(m.seconds);
    if (m.pivots >= 0) pivots.push_back(m.pivots);
    const auto reference = reference_seconds.find(m.case_index);
    if (reference != reference_seconds.end()) ratios.push_back(m.seconds / reference->second);
  }
  return tumble::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", solver, measurements.size(),
                        count[Verdict::said_no], count[Verdict::wrong],
                        count[Verdict::crashed] + count[Verdict::timed_out],
                        count[Verdict::good] > 0 ? tumble::format("{:.0e}", worst) : "-",
                        seconds.empty() ? "-" : time_text(median(seconds)),
                        ratios.empty() ? "-" : tumble::format("{:.3g}", median(ratios)),
                        pivots.empty() ? "-" : tumble::format("{:.0f}", median(pivots)));
}

}  // namespace

std::string tables(const std::vector<Case>& cases, const std::vector<Solver>& solvers,
                   const std::vector<Measurement>& measurements) {
  std::vector<std::string> groups;  // in the order of the cases
  for (const Case& c : cases) {
    if (std::find(groups.begin(), groups.end(), c.group) == groups.end()) groups.push_back(c.group);
  }
  std::map<std::size_t, double> reference_seconds;
  for (const Measurement& m : measurements) {
    if (solvers[m.solver_index].name == k_reference && has_ended(m)) reference_seconds[m.case_index] = m.seconds;
  }
  std::string text;
  for (const std::string& group : groups) {
    text += tumble::format(
        "## {}\n\n| solver | problems | said no | wrong | crashed or too slow | worst residual of the good | median "
        "time | times {} | median pivots |\n|---|---|---|---|---|---|---|---|---|\n",
        group, k_reference);
    for (std::size_t i = 0; i < solvers.size(); ++i) {
      std::vector<Measurement> of_solver;
      std::copy_if(measurements.begin(), measurements.end(), std::back_inserter(of_solver),
                   [&](const Measurement& m) { return m.solver_index == i && cases[m.case_index].group == group; });
      if (!of_solver.empty()) text += row(solvers[i].name, cases, of_solver, reference_seconds);
    }
    text += '\n';
  }
  return text;
}

std::string csv(const std::vector<Case>& cases, const std::vector<Solver>& solvers,
                const std::vector<Measurement>& measurements) {
  std::string text = "group,case,n,solver,verdict,residual,seconds,pivots\n";
  for (const Measurement& m : measurements) {
    const Case& c = cases[m.case_index];
    text += tumble::format("\"{}\",\"{}\",{},\"{}\",{},{},{},{}\n", c.group, c.name, c.problem.size(),
                           solvers[m.solver_index].name, to_string(m.verdict), to_text(m.residual), to_text(m.seconds),
                           m.pivots);
  }
  return text;
}

}  // namespace tumble::bench
