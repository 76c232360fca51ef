#include "run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "scene_edit.hpp"

#include "tumble/explain/lemke_pages.hpp"
#include "tumble/explain/step_problem.hpp"
#include "tumble/lcp/lemke.hpp"
#include "tumble/lcp/residual.hpp"
#include "tumble/math/format.hpp"
#include "tumble/output/csv.hpp"
#include "tumble/output/drop_trajectory.hpp"
#include "tumble/output/record_fields.hpp"
#include "tumble/output/trajectory_csv.hpp"
#include "tumble/output/trajectory_fields.hpp"

namespace tumble::wasm {
namespace {

using Index = std::size_t;

val variables(const std::vector<int>& numbers, Index n) {
  std::vector<std::string> names;
  for (const int number : numbers) names.push_back(lemke_variable(number, n));
  return to_array(names);
}

val variable(std::optional<int> number, Index n) { return number ? val(lemke_variable(*number, n)) : val::null(); }

val to_object(const LemkePage& page) {
  const Index n = page.n();
  val ratios = val::array();
  for (Index row = 0; row < n; ++row) ratios.set(row, page.ratios[row] ? val(*page.ratios[row]) : val::null());
  val object = val::object();
  set(object, "entered", variable(page.entered, n));
  set(object, "left", variable(page.left, n));
  set(object, "entering", variable(page.entering, n));
  set(object, "leaving", variable(page.leaving, n));
  set(object, "basis", variables(page.basis, n));
  set(object, "columns", variables(page.columns, n));
  set(object, "entries", to_typed_array(page.entries));
  set(object, "ratios", ratios);
  return object;
}

const char* name_of(LemkeEnd end) {
  switch (end) {
    case LemkeEnd::no_pivot: return "no_pivot";
    case LemkeEnd::solved: return "solved";
    case LemkeEnd::stopped: return "stopped";
    case LemkeEnd::ray: return "ray";
  }
  return "";
}

val to_object(const StepProblem& shown) {
  if (shown.z.empty()) return val::null();
  val object = val::object();
  set(object, "V", to_typed_array(shown.problem.M));
  set(object, "p", to_typed_array(shown.problem.q));
  set(object, "z", to_typed_array(shown.z));
  set(object, "w", to_typed_array(shown.w));
  set(object, "z_names", to_array(shown.z_names));
  set(object, "z_units", to_array(shown.z_units));
  set(object, "w_names", to_array(shown.w_names));
  set(object, "w_units", to_array(shown.w_units));
  set(object, "residual", residual(shown.problem, shown.z).largest());
  const LemkeSettings settings;
  const LemkeTrace trace = trace_lemke(shown.problem, settings);
  const auto [pages, end] = lemke_pages(trace, shown.z.size(), settings);
  val array = val::array();
  for (Index k = 0; k < pages.size(); ++k) array.set(k, to_object(pages[k]));
  set(object, "pages", array);
  set(object, "end", std::string(name_of(end)));
  return object;
}

val to_object(const ImpulsePlane& plane) {
  val object = val::object();
  set(object, "A_nn", plane.A_nn);
  set(object, "A_nt", plane.A_nt);
  set(object, "A_tt", plane.A_tt);
  set(object, "u_n", plane.u_n);
  set(object, "u_t", plane.u_t);
  set(object, "u_n_target", plane.u_n_target);
  set(object, "friction", plane.friction);
  set(object, "P_n", plane.P_n);
  set(object, "P_t", plane.P_t);
  return object;
}

// The contacts at work in the step that leaves sample k, if it is the only one between two samples.
std::span<const ContactRecord> contacts_from(const Trajectory& trajectory, Index k) {
  if (k + 1 >= trajectory.time.size()) return {};
  const double steps = (trajectory.time[k + 1] - trajectory.time[k]) / trajectory.step_size;
  if (steps > 1.5) return {};
  const auto step = static_cast<std::int64_t>(trajectory.time[k] / trajectory.step_size + 0.5) + 1;
  const auto found = std::lower_bound(trajectory.contacts.begin(), trajectory.contacts.end(), step,
                                      [](const StepContacts& c, std::int64_t number) { return c.step < number; });
  if (found == trajectory.contacts.end() || found->step != step) return {};
  return found->contacts;
}

}  // namespace

std::shared_ptr<Run> Run::of_record(drop::Record record) {
  auto run = std::make_shared<Run>();
  run->trajectory_ = output::trajectory_of(record);
  run->record_ = std::move(record);
  return run;
}

std::shared_ptr<Run> Run::of_trajectory(Trajectory trajectory) {
  auto run = std::make_shared<Run>();
  run->trajectory_ = std::move(trajectory);
  return run;
}

val Run::trajectory() const {
  val object = wasm::to_object(output::to_fields(trajectory_));
  std::vector<double> mechanical, friction_loss, impact_loss;
  double friction = 0.0, impact = 0.0;
  for (const EnergyLedger& energy : trajectory_.energy) {
    mechanical.push_back(energy.kinetic + energy.potential);
    friction_loss.push_back(friction += energy.friction_loss);
    impact_loss.push_back(impact += energy.impact_loss);
  }
  set(object, "mechanical", to_typed_array(mechanical));
  set(object, "total_friction_loss", to_typed_array(friction_loss));
  set(object, "total_impact_loss", to_typed_array(impact_loss));
  return object;
}

val Run::scene() const { return describe(trajectory_.scene); }

val Run::body_series(int body) const {
  const Index T = trajectory_.time.size();
  const double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> normal(T, none), friction(T, none), gap(T, none);
  for (Index k = 0; k < T; ++k) {
    for (const ContactRecord& record : contacts_from(trajectory_, k)) {
      if (record.contact.body_a != body && record.contact.body_b != body) continue;
      const bool is_first = std::isnan(gap[k]);
      normal[k] = (is_first ? 0.0 : normal[k]) + record.normal_impulse;
      friction[k] = (is_first ? 0.0 : friction[k]) + std::abs(record.friction_impulse);
      gap[k] = is_first ? record.contact.gap : std::min(gap[k], record.contact.gap);
    }
  }
  val object = val::object();
  set(object, "normal_impulse", to_typed_array(normal));
  set(object, "friction_impulse", to_typed_array(friction));
  set(object, "gap", to_typed_array(gap));
  return object;
}

val Run::record() const { return record_ ? wasm::to_object(output::to_fields(*record_)) : val::null(); }

val Run::problem(int k) const {
  const auto at = static_cast<Index>(k);
  if (at >= trajectory_.time.size()) return val::null();
  if (record_) {
    if (record_->steps[at].gap >= record_->parameters.delta) return val::null();
    return to_object(problem_of_drop(record_->trajectory.q_at(k), record_->trajectory.v_at(k), record_->parameters));
  }
  const auto contacts = contacts_from(trajectory_, at);
  if (contacts.empty()) return val::null();
  return to_object(problem_of_contacts(trajectory_.scene, trajectory_.bodies(at), trajectory_.bodies(at + 1), contacts,
                                       trajectory_.step_size));
}

val Run::impulse_planes(int k) const {
  const auto at = static_cast<Index>(k);
  val array = val::array();
  if (at >= trajectory_.time.size()) return array;
  if (record_) {
    if (record_->steps[at].gap >= record_->parameters.delta) return array;
    const auto plane =
        impulse_plane_of_drop(record_->trajectory.q_at(k), record_->trajectory.v_at(k), record_->parameters);
    array.set(0, to_object(plane));
    return array;
  }
  Index count = 0;
  for (const ContactRecord& contact : contacts_from(trajectory_, at)) {
    array.set(count++,
              to_object(impulse_plane(trajectory_.scene, trajectory_.bodies(at), contact, trajectory_.step_size)));
  }
  return array;
}

std::string Run::csv(const std::string& table) const {
  if (table == "record" && record_) return output::to_csv(*record_);
  if (table == "samples" && !record_)
    return output::samples_csv_header(trajectory_) + output::samples_csv_rows(trajectory_, 0, trajectory_.time.size());
  if (table == "contacts" && !record_)
    return output::contacts_csv_header(trajectory_) +
           output::contacts_csv_rows(trajectory_, 0, trajectory_.contacts.size());
  throw std::invalid_argument(tumble::format("table: this run has no '{}'", table));
}

double SceneRun::advance(int num_steps) {
  for (int i = 0; i < num_steps && !simulation_.is_done(); ++i) simulation_.advance();
  if (simulation_.is_done()) return 1.0;
  return static_cast<double>(simulation_.step()) / static_cast<double>(simulation_.num_steps());
}

}  // namespace tumble::wasm
