#include "lcp_report.hpp"

#include <algorithm>

#include "json.hpp"

#include "tumble/math/format.hpp"

namespace tumble::cli {
namespace {

std::size_t num_solutions(const LcpReport& report) {
  return status_of(report) == LcpStatus::solved ? report.results.size() : 0;
}

std::string certificate_text(const LcpResult& result) {
  if (result.certificate.empty()) return "";
  const char* meaning =
      result.status == LcpStatus::infeasible ? "y: M'y <= 0, y >= 0, q'y < 0" : "direction of the ray";
  return tumble::format("certificate       {}  ({})\n", tumble::join(result.certificate, " "), meaning);
}

std::string result_text(const LcpResult& result) {
  const auto& [negative_w, negative_z, complementarity] = result.parts;
  std::string text = tumble::format("status            {}\n", to_string(result.status));
  text += tumble::format("z                 {}\n", tumble::join(result.z, " "));
  text += tumble::format("w                 {}\n", tumble::join(result.w, " "));
  text += tumble::format("residual          {:.3g}  (w >= 0: {:.3g}, z >= 0: {:.3g}, w.z = 0: {:.3g})\n",
                         result.residual, negative_w, negative_z, complementarity);
  text += tumble::format("pivots            {}\n", result.pivots);
  text += tumble::format("refactorisations  {}\n", result.refactorisations);
  text += tumble::format("rung              {}\n", to_string(result.rung));
  text += tumble::format("basis             {}\n", basis_text(result.basis));
  return text + certificate_text(result);
}

Json json_of(const LcpResult& result) {
  const auto& [negative_w, negative_z, complementarity] = result.parts;
  const Json parts = {{"negative_w", negative_w}, {"negative_z", negative_z}, {"complementarity", complementarity}};
  return {{"status", to_string(result.status)},
          {"z", result.z},
          {"w", result.w},
          {"residual", result.residual},
          {"parts", parts},
          {"pivots", result.pivots},
          {"refactorisations", result.refactorisations},
          {"rung", to_string(result.rung)},
          {"basis", std::vector<bool>(result.basis.begin(), result.basis.end())},
          {"certificate", result.certificate.empty() ? Json() : Json(result.certificate)}};
}

Json json_of(const LcpReport& report) {
  if (!report.error.empty()) return {{"status", to_string(status_of(report))}, {"error", report.error}};
  if (!report.all) return json_of(report.results.front());
  Json solutions = Json::array();
  for (std::size_t i = 0; i < num_solutions(report); ++i) solutions.push_back(json_of(report.results[i]));
  return {{"n", report.n}, {"status", to_string(status_of(report))}, {"solutions", solutions}};
}

}  // namespace

LcpStatus status_of(const LcpReport& report) {
  return report.error.empty() ? report.results.front().status : LcpStatus::bad_input;
}

std::string basis_text(const std::vector<std::uint8_t>& basis) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < basis.size(); ++i) names.push_back(tumble::format("{}{}", basis[i] ? 'z' : 'w', i + 1));
  return tumble::join(names, " ");
}

std::string lcp_text(const LcpReport& report) {
  if (!report.all) return result_text(report.results.front());
  const std::size_t count = num_solutions(report);
  std::string text =
      tumble::format("{} vertex solution{} of the LCP with n = {}\n", count, count == 1 ? "" : "s", report.n);
  for (const LcpResult& result : report.results) text += tumble::format("\n{}", result_text(result));
  return text;
}

std::string lcp_json(const LcpReport& report) { return to_text(json_of(report)); }

std::string lcp_text(const std::vector<LcpReport>& reports) {
  std::size_t width = 4;
  for (const LcpReport& report : reports) width = std::max(width, report.name.size());
  const bool all = reports.front().all;
  std::string text = tumble::format("{:<{}}  {:>4}  {:<18}  {:>8}  {:>7}  {}rung\n", "file", width, "n", "status",
                                    "residual", "pivots", all ? "solutions  " : "");
  std::size_t num_solved = 0;
  for (const LcpReport& report : reports) {
    if (status_of(report) == LcpStatus::solved) ++num_solved;
    text += tumble::format("{:<{}}  ", report.name, width);
    if (report.results.empty()) {
      text += tumble::format("{:>4}  {}\n", "-", to_string(status_of(report)));
      continue;
    }
    const LcpResult& result = report.results.front();
    text += tumble::format("{:>4}  {:<18}  {:>8.1e}  {:>7}  {}{}\n", report.n, to_string(result.status),
                           result.residual, result.pivots, all ? tumble::format("{:>9}  ", num_solutions(report)) : "",
                           to_string(result.rung));
  }
  return text + tumble::format("{} of {} solved\n", num_solved, reports.size());
}

std::string lcp_json(const std::vector<LcpReport>& reports) {
  Json list = Json::array();
  for (const LcpReport& report : reports) {
    Json entry = {{"file", report.name}};
    entry.update(json_of(report));
    list.push_back(std::move(entry));
  }
  return to_text(list);
}

}  // namespace tumble::cli
