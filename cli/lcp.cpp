#include "commands.hpp"
#include "report.hpp"
#include <fmt/format.h>

#include "tumble/lcp/problem_text.hpp"
#include "tumble/lcp/solve.hpp"
#include "tumble/output/file.hpp"

namespace tumble::cli {

int run_lcp(const LcpOptions& options) {
  const bool is_stdin = options.input == "-";
  constexpr std::size_t max_bytes = 200'000'000;  // the largest problem that is read, at 50 bytes a number
  const std::string text = output::read_file(is_stdin ? "/dev/stdin" : options.input, max_bytes);
  const std::string name = is_stdin ? "standard input" : options.input;
  if (options.exact) return run_lcp_exact(text, name, options);
  const LcpProblem problem = parse_lcp(text, name);
  std::vector<LcpResult> results;
  if (options.all) {
    results = enumerate_solutions(problem);
  }
  if (results.empty()) {  // one solution is asked for, or there is none and its status says why
    const LcpSettings settings =
        options.all || options.method == "enumerate" ? LcpSettings(EnumerateSettings{}) : LemkeSettings{};
    results.push_back(solve_lcp(problem, settings));
  }
  if (!options.report.quiet) {
    fmt::print("{}",
               options.report.json ? lcp_json(problem, results, options.all) : lcp_text(problem, results, options.all));
  }
  const bool is_solved = results.front().status == LcpStatus::solved;
  if (is_solved) return k_done;
  const std::string_view status = to_string(results.front().status);
  return report_failure(fmt::format("no solution found: status {}", status), k_numerical_failure);
}

}  // namespace tumble::cli
