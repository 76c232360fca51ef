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
  const LcpProblem problem = parse_lcp(text, is_stdin ? "standard input" : options.input);
  std::vector<LcpResult> results;
  if (options.all) {
    results = enumerate_solutions(problem);
  } else {
    const LcpSettings settings = options.method == "enumerate" ? LcpSettings(EnumerateSettings{}) : LemkeSettings{};
    results.push_back(solve_lcp(problem, settings));
  }
  if (!options.report.quiet) {
    fmt::print("{}",
               options.report.json ? lcp_json(problem, results, options.all) : lcp_text(problem, results, options.all));
  }
  const bool is_solved = !results.empty() && results.front().status == LcpStatus::solved;
  return is_solved ? k_done : k_numerical_failure;
}

}  // namespace tumble::cli
