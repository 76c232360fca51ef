// `tumble lcp --exact`: rational arithmetic from the text to the answer.
#include "commands.hpp"
#include "json.hpp"
#include "lcp_report.hpp"

#include "tumble/lcp/exact.hpp"
#include "tumble/lcp/problem_text.hpp"
#include "tumble/math/format.hpp"

namespace tumble::cli {
namespace {

using Fractions = std::vector<std::string>;

// Fractions, and the nearest doubles on a line of their own where they say more.
std::string lines(std::string_view name, const Fractions& numbers) {
  std::string text = tumble::format("{:<18}{}\n", name, tumble::join(numbers, " "));
  bool has_fraction = false;
  for (const std::string& number : numbers) has_fraction = has_fraction || number.find('/') != std::string::npos;
  if (has_fraction) text += tumble::format("{:<18}{}\n", "", tumble::join(as_doubles(numbers), " "));
  return text;
}

std::string solution_text(const ExactResult& solution) {
  return lines("z", solution.z) + lines("w", solution.w) +
         tumble::format("{:<18}{}\n", "basis", basis_text(solution.basis));
}

std::string certificate_text(LcpStatus status, const Fractions& certificate) {
  if (certificate.empty()) return "";
  return status == LcpStatus::infeasible ? lines("y", certificate) + "                  y >= 0, M'y <= 0, q.y < 0\n"
                                         : lines("ray", certificate);
}

std::string exact_text(const ExactResult& result) {
  std::string text = tumble::format("status            {}\n", to_string(result.status));
  if (!result.z.empty()) text += solution_text(result);
  return text + certificate_text(result.status, result.certificate);
}

std::string exact_text(const ExactLcp& problem, const ExactSolutionSet& set) {
  const auto count = [](std::size_t number, const char* what) {
    return tumble::format("{} {}{}", number, what, number == 1 ? "" : "s");
  };
  std::string text = tumble::format("{}, {}, {} of the LCP with n = {}\nstatus            {}\n",
                                    count(set.vertices.size(), "vertex solution"), count(set.rays.size(), "ray"),
                                    count(set.faces.size(), "face"), problem.size(), to_string(set.status));
  for (std::size_t v = 0; v < set.vertices.size(); ++v) {
    text += tumble::format("\nvertex            {}\n{}", v, solution_text(set.vertices[v]));
  }
  for (std::size_t r = 0; r < set.rays.size(); ++r)
    text += tumble::format("\nray               {}\n{}", r, lines("z", set.rays[r]));
  if (!set.faces.empty()) text += "\n";
  for (std::size_t f = 0; f < set.faces.size(); ++f) {
    text += tumble::format("face              {}: vertices {}", f, tumble::join(set.faces[f].vertices, " "));
    text += set.faces[f].rays.empty() ? "\n" : tumble::format(", rays {}\n", tumble::join(set.faces[f].rays, " "));
  }
  return text + certificate_text(set.status, set.certificate);
}

Json json_of(const ExactResult& result) {
  const std::vector<bool> basis(result.basis.begin(), result.basis.end());
  Json report = {
      {"status", to_string(result.status)}, {"z", result.z}, {"w", result.w}, {"z_decimal", as_doubles(result.z)},
      {"w_decimal", as_doubles(result.w)},  {"basis", basis}};
  if (!result.certificate.empty()) report["certificate"] = result.certificate;
  return report;
}

Json json_of(const ExactLcp& problem, const ExactSolutionSet& set) {
  Json vertices = Json::array(), faces = Json::array();
  for (const ExactResult& vertex : set.vertices) vertices.push_back(json_of(vertex));
  for (const SolutionFace& face : set.faces) faces.push_back({{"vertices", face.vertices}, {"rays", face.rays}});
  Json report = {{"n", problem.size()},
                 {"status", to_string(set.status)},
                 {"solutions", vertices},
                 {"rays", set.rays},
                 {"faces", faces}};
  if (!set.certificate.empty()) report["certificate"] = set.certificate;
  return report;
}

}  // namespace

int run_lcp_exact(const std::string& text, const std::string& name, const LcpOptions& options) {
  const ExactLcp problem = parse_exact_lcp(text, name);
  LcpStatus status = LcpStatus::numerical;
  std::string report;
  if (options.all) {
    const ExactSolutionSet set = exact_solution_set(problem);
    status = set.status;
    report = options.report.json ? to_text(json_of(problem, set)) : exact_text(problem, set);
  } else {
    const ExactResult result = solve_exactly(problem);
    status = result.status;
    report = options.report.json ? to_text(json_of(result)) : exact_text(result);
  }
  if (!options.report.quiet) tumble::print("{}", report);
  if (status == LcpStatus::solved) return k_done;
  return report_failure(tumble::format("no solution found: status {}", to_string(status)), k_numerical_failure);
}

}  // namespace tumble::cli
