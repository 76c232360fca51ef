#include "run_report.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "json.hpp"
#include "report.hpp"

#include "tumble/math/format.hpp"

namespace tumble::cli {
namespace {

// A body at rest under gravity keeps the round-off of what gravity gives it in one step, g h. One that moves less than
// this share of it is at rest.
constexpr double k_rest_share = 1e-6;

// v . M v / m: the square of a speed in which rotation counts, too [m^2/s^2].
double square_speed(const Body& body, const Vector3& v) {
  return v[0] * v[0] + v[1] * v[1] + body.moment_of_inertia / body.mass * v[2] * v[2];
}

std::span<const BodyState> last_states(const Trajectory& trajectory) {
  return trajectory.bodies(trajectory.time.size() - 1);
}

// The fastest dynamic body; -1 if there is none.
int find_fastest(const Scene& scene, std::span<const BodyState> states) {
  int fastest = -1;
  double most = -1.0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (scene.bodies[i].kind != BodyKind::dynamic) continue;
    const double square = square_speed(scene.bodies[i], states[i].velocity);
    if (square > most) {
      most = square;
      fastest = static_cast<int>(i);
    }
  }
  return fastest;
}

bool is_at_rest(const Trajectory& trajectory, std::span<const BodyState> states) {
  const Scene& scene = trajectory.scene;
  const int fastest = find_fastest(scene, states);
  if (fastest < 0) return true;
  const auto i = static_cast<std::size_t>(fastest);
  const double slow = k_rest_share * length(scene.gravity) * trajectory.step_size;
  return square_speed(scene.bodies[i], states[i].velocity) <= slow * slow;
}

EnergyLedger total(const Trajectory& trajectory) {
  EnergyLedger sum;
  for (const EnergyLedger& energy : trajectory.energy) add_step(sum, energy);
  return sum;
}

std::string energy_lines(const Trajectory& trajectory) {
  const EnergyLedger start = trajectory.energy.front();
  const EnergyLedger sum = total(trajectory);
  const double before = start.kinetic + start.potential, after = sum.kinetic + sum.potential;
  std::string text = tumble::format(
      "energy   {:.6g} J at the start, {:.6g} J at the end, {:.6g} J of it kinetic\n"
      "         lost: {:.6g} J to friction, {:.6g} J to impacts",
      before, after, sum.kinetic, sum.friction_loss, sum.impact_loss);
  // The others only where they are more than the round-off of the sums.
  constexpr double k_rounding = 1e-12;
  const double size = std::max({std::abs(before), std::abs(after), sum.friction_loss, sum.impact_loss});
  const auto add = [&](const char* words, double value) {
    if (std::abs(value) > k_rounding * size) text += tumble::format("{}{:.6g} J", words, value);
  };
  add(", to damping ", sum.damping_loss);
  add("; work from outside ", sum.external_work);
  add("; work of position correction ", sum.stabilisation_work);
  text += '\n';
  if (trajectory.num_creating_steps > 0) {
    text += tumble::format("         CREATED from nothing: {:.6g} J in {} step{}, first at {:.6g} s\n",
                           trajectory.created_energy, trajectory.num_creating_steps,
                           trajectory.num_creating_steps == 1 ? "" : "s", trajectory.first_creation);
  }
  return text;
}

std::string inexact_line(const Trajectory& trajectory) {
  if (trajectory.num_inexact_steps == 0) return "";
  return tumble::format("INEXACT  {} step{}, the first at {:.6g} s: contact laws off by up to {:.1e} of the speeds\n",
                        trajectory.num_inexact_steps, trajectory.num_inexact_steps == 1 ? "" : "s",
                        trajectory.first_inexact, trajectory.residual);
}

std::string end_line(const Trajectory& trajectory, const RunNotes& notes, const std::vector<std::string>& labels) {
  const std::span<const BodyState> states = last_states(trajectory);
  const int fastest = find_fastest(trajectory.scene, states);
  if (fastest < 0) return "end      nothing can move\n";
  if (is_at_rest(trajectory, states)) {
    return notes.moving_until > 0.0 ? tumble::format("end      at rest since {:.6g} s\n", notes.moving_until)
                                    : "end      at rest all the time\n";
  }
  const auto i = static_cast<std::size_t>(fastest);
  const Vector3& v = states[i].velocity;
  return tumble::format("end      moving; fastest is {} with {:.4g} m/s and {:.4g} rad/s\n", labels[i],
                        std::hypot(v[0], v[1]), v[2]);
}

Json json_of(const BodyState& state) {
  const auto& [position, angle] = state.pose;
  const Vector3& v = state.velocity;
  return {
      {"position", {position.x, position.y}}, {"angle", angle}, {"velocity", {v[0], v[1]}}, {"angular_velocity", v[2]}};
}

}  // namespace

void RunNotes::take(const Simulation& simulation) {
  const Trajectory& trajectory = simulation.trajectory();
  for (const ContactRecord& record : simulation.report().contacts) {
    if (record.contact.gap >= deepest_gap) continue;
    deepest_gap = record.contact.gap;
    body_a = record.contact.body_a;
    body_b = record.contact.body_b;
    time = simulation.time() - trajectory.step_size;
  }
  if (!is_at_rest(trajectory, simulation.state().bodies)) moving_until = simulation.time();
}

std::string run_text(const Trajectory& trajectory, const RunNotes& notes, const std::vector<std::string>& files) {
  const Scene& scene = trajectory.scene;
  const std::vector<std::string> labels = body_labels(scene);
  const auto num_moving = std::count_if(scene.bodies.begin(), scene.bodies.end(),
                                        [](const Body& body) { return body.kind == BodyKind::dynamic; });
  std::string text = scene.title.empty() ? "" : scene.title + "\n";
  text += tumble::format("{} bod{}, {} of them moved by forces; {} step{} of {} s\n\n", scene.bodies.size(),
                         scene.bodies.size() == 1 ? "y" : "ies", num_moving, trajectory.num_steps,
                         trajectory.num_steps == 1 ? "" : "s", trajectory.step_size);
  text += tumble::format("status   {}, largest residual {:.3g}\n", to_string(trajectory.status), trajectory.residual);
  text += energy_lines(trajectory);
  text += notes.body_a < 0 ? "overlap  none\n"
                           : tumble::format("overlap  at most {:.3g} m, {} and {} at {:.6g} s\n", -notes.deepest_gap,
                                            labels[static_cast<std::size_t>(notes.body_a)],
                                            labels[static_cast<std::size_t>(notes.body_b)], notes.time);
  return text + inexact_line(trajectory) + end_line(trajectory, notes, labels) + files_text(files);
}

std::string run_json(const Trajectory& trajectory, const RunNotes& notes, const std::vector<std::string>& files) {
  const Scene& scene = trajectory.scene;
  const std::vector<std::string> labels = body_labels(scene);
  const EnergyLedger& start = trajectory.energy.front();
  const EnergyLedger sum = total(trajectory);
  Json bodies = Json::array();
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (scene.bodies[i].kind == BodyKind::fixed) continue;
    Json body = {{"name", labels[i]}};
    body.update(json_of(last_states(trajectory)[i]));
    bodies.push_back(std::move(body));
  }
  Json overlap = nullptr;
  if (notes.body_a >= 0) {
    overlap = {
        {"depth", -notes.deepest_gap},
        {"bodies", {labels[static_cast<std::size_t>(notes.body_a)], labels[static_cast<std::size_t>(notes.body_b)]}},
        {"time", notes.time}};
  }
  const bool rests = is_at_rest(trajectory, last_states(trajectory));
  const Json report = {
      {"title", scene.title},
      {"step_size", trajectory.step_size},
      {"steps", trajectory.num_steps},
      {"time", trajectory.time.back()},
      {"complete", trajectory.is_complete},
      {"interrupted", notes.is_interrupted},
      {"status", to_string(trajectory.status)},
      {"residual", trajectory.residual},
      {"inexact_steps", trajectory.num_inexact_steps},
      {"first_inexact", trajectory.num_inexact_steps > 0 ? Json(trajectory.first_inexact) : Json(nullptr)},
      {"energy",
       {{"start", {{"kinetic", start.kinetic}, {"potential", start.potential}}},
        {"end", {{"kinetic", sum.kinetic}, {"potential", sum.potential}}},
        {"external_work", sum.external_work},
        {"friction_loss", sum.friction_loss},
        {"impact_loss", sum.impact_loss},
        {"damping_loss", sum.damping_loss},
        {"stabilisation_work", sum.stabilisation_work},
        {"created", trajectory.created_energy},
        {"creating_steps", trajectory.num_creating_steps},
        {"first_creation", trajectory.num_creating_steps > 0 ? Json(trajectory.first_creation) : Json(nullptr)}}},
      {"overlap", overlap},
      {"at_rest", rests},
      {"at_rest_since", rests ? Json(notes.moving_until) : Json(nullptr)},
      {"bodies", bodies},
      {"files", files}};
  return to_text(report);
}

}  // namespace tumble::cli
