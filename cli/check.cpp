// `tumble check`: a scene read and looked through, without a simulation.
#include <algorithm>
#include <array>
#include <cmath>

#include "commands.hpp"
#include "input.hpp"
#include "json.hpp"

#include "tumble/math/format.hpp"
#include "tumble/trajectory/scene_warnings.hpp"

namespace tumble::cli {
namespace {

constexpr std::size_t k_most_rows = 40;    // of the table of bodies
constexpr std::size_t k_most_of_kind = 5;  // warnings that are printed

std::size_t count(const Scene& scene, BodyKind kind) {
  return static_cast<std::size_t>(
      std::count_if(scene.bodies.begin(), scene.bodies.end(), [&](const Body& body) { return body.kind == kind; }));
}

std::string body_row(const Body& body, const std::string& label, std::size_t width) {
  const auto& [position, angle] = body.pose;
  const bool is_dynamic = body.kind == BodyKind::dynamic;
  return tumble::format("{:<{}}  {:<9}  {:>5}  {:>9}  {:>17}  {:>10.5g} {:>10.5g} {:>11.5g}\n", label, width,
                        to_string(body.kind), body.parts.size(), is_dynamic ? tumble::format("{:.5g}", body.mass) : "",
                        is_dynamic ? tumble::format("{:.5g}", body.moment_of_inertia) : "", position.x, position.y,
                        angle);
}

std::string body_table(const Scene& scene, const std::vector<std::string>& labels) {
  const std::size_t rows = std::min(labels.size(), k_most_rows);
  std::size_t width = 4;
  for (std::size_t i = 0; i < rows; ++i) width = std::max(width, labels[i].size());
  std::string text = tumble::format("{:<{}}  {:<9}  {:>5}  {:>9}  {:>17}  {:>10} {:>10} {:>11}\n", "body", width,
                                    "kind", "parts", "mass [kg]", "inertia [kg m^2]", "x [m]", "y [m]", "angle [rad]");
  for (std::size_t i = 0; i < rows; ++i) text += body_row(scene.bodies[i], labels[i], width);
  if (rows < labels.size()) text += tumble::format("... and {} more; --json has all\n", labels.size() - rows);
  return text;
}

std::string warning_lines(const Scene& scene, const std::vector<std::string>& labels,
                          const std::vector<SceneWarning>& warnings) {
  if (warnings.empty()) return "no warnings\n";
  std::string text;
  for (auto first = warnings.begin(); first != warnings.end();) {
    const auto end = std::find_if(first, warnings.end(), [&](const SceneWarning& w) { return w.kind != first->kind; });
    const auto shown = std::min(end - first, static_cast<std::ptrdiff_t>(k_most_of_kind));
    for (auto warning = first; warning != first + shown; ++warning) {
      text += tumble::format("warning: {}\n", to_text(*warning, scene, labels));
    }
    if (end - first > shown) text += tumble::format("         and {} more of this kind\n", end - first - shown);
    first = end;
  }
  return text;
}

std::string check_text(const Scene& scene, const std::vector<SceneWarning>& warnings) {
  const std::vector<std::string> labels = body_labels(scene);
  std::string text = scene.title.empty() ? "" : scene.title + "\n";
  text +=
      tumble::format("{} dynamic, {} kinematic, {} fixed; gravity {}, {} m/s^2; {} s in steps of {} s\n\n",
                     count(scene, BodyKind::dynamic), count(scene, BodyKind::kinematic), count(scene, BodyKind::fixed),
                     scene.gravity.x, scene.gravity.y, scene.duration, scene.step_size);
  return text + body_table(scene, labels) + "\n" + warning_lines(scene, labels, warnings);
}

std::string check_json(const Scene& scene, const std::vector<SceneWarning>& warnings) {
  const std::vector<std::string> labels = body_labels(scene);
  Json bodies = Json::array();
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const Body& body = scene.bodies[i];
    Json entry = {{"name", labels[i]}, {"kind", to_string(body.kind)}, {"parts", body.parts.size()}};
    if (body.kind == BodyKind::dynamic) {
      entry["mass"] = body.mass;
      entry["moment_of_inertia"] = body.moment_of_inertia;
    }
    entry["position"] = {body.pose.position.x, body.pose.position.y};
    entry["angle"] = body.pose.angle;
    bodies.push_back(std::move(entry));
  }
  Json list = Json::array();
  for (const SceneWarning& warning : warnings) {
    Json names = Json::array();
    for (const int body : {warning.body, warning.other}) {
      if (body >= 0) names.push_back(labels[static_cast<std::size_t>(body)]);
    }
    Json entry = {
        {"kind", to_string(warning.kind)}, {"bodies", std::move(names)}, {"text", to_text(warning, scene, labels)}};
    if (warning.kind == SceneWarning::Kind::overlap) entry["depth"] = warning.value;
    if (warning.kind == SceneWarning::Kind::fast) entry["step_size"] = warning.step_size;
    list.push_back(std::move(entry));
  }
  return to_text(Json{{"title", scene.title},
                      {"gravity", {scene.gravity.x, scene.gravity.y}},
                      {"step_size", scene.step_size},
                      {"duration", scene.duration},
                      {"bodies", bodies},
                      {"warnings", list}});
}

}  // namespace

int check_scene(const CheckOptions& options) {
  const Scene scene = read_scene(options.input);
  const std::vector<SceneWarning> warnings = scene_warnings(scene);
  if (!options.report.quiet) {
    tumble::print("{}", options.report.json ? check_json(scene, warnings) : check_text(scene, warnings));
  }
  return warnings.empty() ? k_done : k_warnings;
}

}  // namespace tumble::cli
