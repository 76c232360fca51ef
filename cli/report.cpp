#include "report.hpp"

#include <array>
#include <numbers>

#include "json.hpp"

#include "tumble/math/format.hpp"

namespace tumble::cli {
namespace {

constexpr std::array<const char*, 4> k_corner_names = {"(-,-)", "(+,-)", "(+,+)", "(-,+)"};

// A step during which a contact force acts.
struct Impact {
  int column;
  double normal_impulse;      // [N s]
  double tangential_impulse;  // along +x [N s]
  double energy_lost;         // mechanical energy before the step minus after it [J]; the lift of delta counts as gain
};

double mechanical_energy(const drop::Record& record, int column) {
  return kinetic_energy(record.trajectory.v_at(column), record.parameters) +
         potential_energy(record.trajectory.q_at(column), record.parameters);
}

std::vector<Impact> find_impacts(const drop::Record& record) {
  std::vector<Impact> impacts;
  const double dt = record.parameters.dt;
  for (int k = 0; k + 1 < record.trajectory.columns; ++k) {
    const Vector4& z = record.steps[static_cast<std::size_t>(k)].z;
    if (z[0] <= 0.0) continue;
    impacts.push_back(
        {k, z[0] * dt, (z[2] - z[1]) * dt, mechanical_energy(record, k) - mechanical_energy(record, k + 1)});
  }
  return impacts;
}

std::string state_text(const Vector3& q, const Vector3& v) {
  return tumble::format("x {:.6g} m, y {:.6g} m, angle {:.6g} deg; vx {:.6g} m/s, vy {:.6g} m/s, omega {:.6g} rad/s",
                        q[0], q[1], q[2] * (180.0 / std::numbers::pi), v[0], v[1], v[2]);
}

std::string impact_table(const drop::Record& record) {
  constexpr std::size_t max_rows = 40;
  const std::vector<Impact> impacts = find_impacts(record);
  if (impacts.empty()) return "no impact\n";
  std::string text = "time [s]  corner  mode        impulse n [N s]  impulse t [N s]  energy lost [J]\n";
  for (std::size_t i = 0; i < std::min(impacts.size(), max_rows); ++i) {
    const Impact& impact = impacts[i];
    const drop::StepRecord& step = record.steps[static_cast<std::size_t>(impact.column)];
    text += tumble::format("{:8.3f}  {:6}  {:10}  {:15.5f}  {:15.5f}  {:15.5f}\n", impact.column * record.parameters.dt,
                           k_corner_names[static_cast<std::size_t>(step.corner)], to_string(step.mode),
                           impact.normal_impulse, impact.tangential_impulse, impact.energy_lost);
  }
  if (impacts.size() > max_rows) {
    text += tumble::format("... and {} more; -o FILE.csv has every step\n", impacts.size() - max_rows);
  }
  return text;
}

Json json_of(const Vector3& values) { return Json::array({values[0], values[1], values[2]}); }

}  // namespace

std::string files_text(const std::vector<std::string>& files) {
  return files.empty() ? "" : tumble::format("wrote {}\n", tumble::join(files, ", "));
}

std::string drop_text(const drop::Record& record, const std::vector<std::string>& files) {
  const drop::Parameters& p = record.parameters;
  const drop::Trajectory& trajectory = record.trajectory;
  const int last = trajectory.columns - 1;
  std::string text = tumble::format(
      "square of side {} m, mass {} kg, friction {}, restitution {}; {} step{} of {} s\nstart: {}\n\n", p.l, p.m, p.mu,
      p.eps, p.columns - 1, p.columns == 2 ? "" : "s", p.dt, state_text(trajectory.q_at(0), trajectory.v_at(0)));
  text += impact_table(record);
  if (trajectory.status != LcpStatus::solved) {
    text += tumble::format("\nstep {} of {} left the range of double arithmetic: status {}, residual {:.3g}\n",
                           last + 1, p.columns - 1, to_string(trajectory.status), record.steps.back().residual);
  }
  text +=
      tumble::format("\nafter {:.4g} s: {}\n", last * p.dt, state_text(trajectory.q_at(last), trajectory.v_at(last)));
  return text + files_text(files);
}

std::string drop_json(const drop::Record& record, const std::vector<std::string>& files) {
  const drop::Parameters& p = record.parameters;
  const drop::Trajectory& trajectory = record.trajectory;
  const int last = trajectory.columns - 1;
  Json impacts = Json::array();
  for (const Impact& impact : find_impacts(record)) {
    const drop::StepRecord& step = record.steps[static_cast<std::size_t>(impact.column)];
    impacts.push_back({{"column", impact.column},
                       {"time", impact.column * p.dt},
                       {"corner", step.corner},
                       {"mode", to_string(step.mode)},
                       {"normal_impulse", impact.normal_impulse},
                       {"tangential_impulse", impact.tangential_impulse},
                       {"energy_lost", impact.energy_lost},
                       {"residual", step.residual}});
  }
  const Json report = {{"parameters",
                        {{"l", p.l},
                         {"m", p.m},
                         {"mu", p.mu},
                         {"eps", p.eps},
                         {"dt", p.dt},
                         {"delta", p.delta},
                         {"g", p.g},
                         {"columns", p.columns}}},
                       {"status", to_string(trajectory.status)},
                       {"start", {{"q", json_of(trajectory.q_at(0))}, {"v", json_of(trajectory.v_at(0))}}},
                       {"impacts", impacts},
                       {"final",
                        {{"time", last * p.dt},
                         {"column", last},
                         {"q", json_of(trajectory.q_at(last))},
                         {"v", json_of(trajectory.v_at(last))}}},
                       {"files", files}};
  return to_text(report);
}

}  // namespace tumble::cli
