#include <algorithm>
#include <exception>
#include <stdexcept>

#include "commands.hpp"
#include "input.hpp"
#include "lcp_report.hpp"
#include "lcp_trace.hpp"

#include "tumble/lcp/methods.hpp"
#include "tumble/lcp/problem_text.hpp"
#include "tumble/math/format.hpp"

namespace tumble::cli {
namespace {

// --all and --trace are about one method each.
LcpSettings chosen_settings(const LcpOptions& options) {
  const char* needed = options.all ? "enumerate" : options.trace ? "lemke" : "";
  const std::string& method = options.method;
  if (*needed != '\0' && !method.empty() && method != needed) {
    throw std::invalid_argument(tumble::format("--{}: belongs to the method {}, got --method {}",
                                               options.all ? "all" : "trace", needed, method));
  }
  LcpSettings settings = lcp_method(!method.empty() ? method : *needed != '\0' ? needed : "robust").defaults;
  for (const std::string& word : options.settings) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw std::invalid_argument(tumble::format("--set: must be NAME=VALUE, got '{}'", word));
    }
    set_by_name(settings, word.substr(0, equals), word.substr(equals + 1));
  }
  validate(settings);
  return settings;
}

constexpr std::size_t k_max_bytes = 200'000'000;  // the largest problem that is read, at 50 bytes a number

LcpProblem read_problem(const std::string& file) { return parse_lcp(read_input(file, k_max_bytes), input_name(file)); }

const std::string& only_file(const LcpOptions& options, const char* option) {
  if (options.files.size() == 1) return options.files.front();
  throw std::invalid_argument(tumble::format("{}: takes one file, got {}", option, options.files.size()));
}

LcpReport solve(const std::string& file, const LcpSettings& settings, bool all) {
  const LcpProblem problem = read_problem(file);
  LcpReport report{input_name(file), problem.size(), all, {}, {}};
  if (all) report.results = enumerate_solutions(problem, std::get<EnumerateSettings>(settings));
  // One solution is asked for, or there is none and its status says why.
  if (report.results.empty()) report.results.push_back(solve_lcp(problem, settings));
  return report;
}

int exit_code(const LcpReport& report) {
  const LcpStatus status = status_of(report);
  return status == LcpStatus::solved ? k_done : status == LcpStatus::bad_input ? k_bad_input : k_numerical_failure;
}

int end_of_one(const LcpReport& report) {
  if (status_of(report) == LcpStatus::solved) return k_done;
  return report_failure(tumble::format("no solution found: status {}", to_string(status_of(report))),
                        exit_code(report));
}

int run_one(const LcpOptions& options, const LcpSettings& settings) {
  const LcpReport report = solve(options.files.front(), settings, options.all);
  if (!options.report.quiet) tumble::print("{}", options.report.json ? lcp_json(report) : lcp_text(report));
  return end_of_one(report);
}

int run_trace(const LcpOptions& options, const LemkeSettings& settings) {
  const std::string& file = only_file(options, "--trace");
  const LcpProblem problem = read_problem(file);
  const std::size_t n = problem.size();
  if (n > k_max_trace_size) {
    throw std::invalid_argument(
        tumble::format("--trace: takes problems of at most {} unknowns, got {}", k_max_trace_size, n));
  }
  const LemkeTrace trace = trace_lemke(problem, settings);
  const LcpReport report{input_name(file), n, false, {trace.result}, {}};
  if (!options.report.quiet) tumble::print("{}\n{}", trace_text(trace, n, settings), lcp_text(report));
  return end_of_one(report);
}

int run_exact(const LcpOptions& options) {
  const std::string& file = only_file(options, "--exact");
  return run_lcp_exact(read_input(file, k_max_bytes), input_name(file), options);
}

// A file that cannot be solved does not keep the others from it.
int run_many(const LcpOptions& options, const LcpSettings& settings) {
  std::vector<LcpReport> reports;
  int worst = k_done;
  for (const std::string& file : options.files) {
    try {
      reports.push_back(solve(file, settings, options.all));
    } catch (const std::exception& error) {
      report_failure(error.what(), k_bad_input);
      reports.push_back({input_name(file), 0, options.all, {}, error.what()});
    }
    worst = std::max(worst, exit_code(reports.back()));
  }
  if (!options.report.quiet) tumble::print("{}", options.report.json ? lcp_json(reports) : lcp_text(reports));
  if (worst == k_done) return k_done;
  const auto num_failed = std::count_if(reports.begin(), reports.end(),
                                        [](const LcpReport& report) { return exit_code(report) != k_done; });
  return report_failure(tumble::format("{} of {} files not solved", num_failed, reports.size()), worst);
}

}  // namespace

int run_lcp(const LcpOptions& options) {
  if (std::count(options.files.begin(), options.files.end(), "-") > 1) {
    throw std::invalid_argument("standard input can be read once only, got '-' several times");
  }
  if (options.exact) return run_exact(options);
  const LcpSettings settings = chosen_settings(options);
  if (options.trace) return run_trace(options, std::get<LemkeSettings>(settings));
  return options.files.size() == 1 ? run_one(options, settings) : run_many(options, settings);
}

}  // namespace tumble::cli
