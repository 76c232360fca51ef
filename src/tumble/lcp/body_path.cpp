// The path of `BodyModes::follow_near`. See body_modes.hpp and docs/theory/step.md.
#include <algorithm>
#include <cmath>

#include "tumble/lcp/body_modes.hpp"

namespace tumble {
namespace {

using Index = std::size_t;

constexpr double k_largest_lambda = 1000.0;  // far back is the way to a ray

// The condition in which a mode just taken is at its border: the one that must grow from there on.
int border_condition(ContactMode from, ContactMode to) {
  if (to == ContactMode::stick) return from == ContactMode::slip_left ? 0 : 1;
  return from == ContactMode::stick ? 1 : 0;
}

}  // namespace

// For u + ridge diag(A) f, u the velocities at the contacts from rest, with these offsets: impulses as the modes call
// for, and what the velocities are with them.
void BodyModes::respond(const std::vector<Pair>& offsets, Response& response) {
  const auto lean = [&](Index i) { return -slip_direction(modes[i]) * system_->contacts[i].friction; };
  step_.assign(mass_.size(), Vector3{});
  for (Index i = 0; i < modes.size(); ++i) {
    if (modes[i] == ContactMode::open) continue;
    const double pull_n = -offsets[i][0] / (ridge_ * response_[i].nn);
    const double pull_t =
        modes[i] == ContactMode::stick ? -offsets[i][1] / (ridge_ * response_[i].tt) : lean(i) * pull_n;
    if (pull_n == 0.0 && pull_t == 0.0) continue;
    for_bodies(system_->contacts[i], [&](Index b, const Vector3& normal, const Vector3& tangent) {
      for (Index j = 0; j < 3; ++j) step_[b][j] += normal[j] * pull_n + tangent[j] * pull_t;
    });
  }
  equations_.solve(step_);
  response.f.assign(2 * modes.size(), 0.0);
  response.u.resize(modes.size());
  for (Index i = 0; i < modes.size(); ++i) {
    double u_n = offsets[i][0], u_t = offsets[i][1];
    for_bodies(system_->contacts[i], [&](Index b, const Vector3& normal, const Vector3& tangent) {
      u_n += dot(normal, step_[b]);
      u_t += dot(tangent, step_[b]);
    });
    double f_n = 0.0, f_t = 0.0;
    if (modes[i] != ContactMode::open) {
      f_n = -u_n / (ridge_ * response_[i].nn);
      u_n = 0.0;
      f_t = lean(i) * f_n;
      if (modes[i] == ContactMode::stick) f_t = -u_t / (ridge_ * response_[i].tt);
      u_t = modes[i] == ContactMode::stick ? 0.0 : u_t + ridge_ * response_[i].tt * f_t;
    }
    response.f[2 * i] = f_n;
    response.f[2 * i + 1] = f_t;
    response.u[i] = {u_n, u_t};
  }
}

// With lambda drift added to the offsets, the present impulses are a solution for lambda = 1; asked for is 0.
void BodyModes::start_path() {
  start_impulses_ = impulses;
  impose_modes();
  find_velocities();
  find_contact_velocities();
  here_.f = impulses;
  here_.u.resize(modes.size());
  drift_.resize(modes.size());
  for (Index i = 0; i < modes.size(); ++i) {
    const double u_n = u_[i][0],
                 u_t = u_[i][1] + ridge_ * response_[i].tt * (impulses[2 * i + 1] - start_impulses_[2 * i + 1]);
    here_.u[i] =
        modes[i] == ContactMode::open ? Pair{std::abs(u_n), u_t} : Pair{0.0, slip_direction(modes[i]) * std::abs(u_t)};
    drift_[i] = {here_.u[i][0] - u_n, here_.u[i][1] - u_t};
  }
}

// Takes away what rounding has gathered.
void BodyModes::correct_path(double lambda) {
  impulses = here_.f;
  find_velocities();
  find_contact_velocities();
  for (Index i = 0; i < modes.size(); ++i) {
    u_[i][0] += ridge_ * response_[i].nn * (here_.f[2 * i] - start_impulses_[2 * i]) + lambda * drift_[i][0];
    u_[i][1] += ridge_ * response_[i].tt * (here_.f[2 * i + 1] - start_impulses_[2 * i + 1]) + lambda * drift_[i][1];
  }
  respond(u_, slope_);
  for (Index k = 0; k < here_.f.size(); ++k) here_.f[k] += slope_.f[k];
  here_.u = slope_.u;
}

// Conditions of contact i in its mode: value >= 0. At most two.
int BodyModes::list_conditions(Index i, const Response& response, Pair& values) const {
  const double mu = system_->contacts[i].friction;
  const double limit = mu * response.f[2 * i];
  switch (modes[i]) {
    case ContactMode::open: values[0] = response.u[i][0]; return 1;
    case ContactMode::stick: values = {limit - response.f[2 * i + 1], limit + response.f[2 * i + 1]}; return 2;
    default: values = {response.f[2 * i], slip_direction(modes[i]) * response.u[i][1]}; return mu > 0.0 ? 2 : 1;
  }
}

// The mode that follows where a condition reaches 0.
ContactMode BodyModes::next_mode(Index i, int condition, double u_t) const {
  switch (modes[i]) {
    case ContactMode::open:
      return system_->contacts[i].friction > 0.0 && u_t < 0.0 ? ContactMode::slip_left : ContactMode::slip_right;
    case ContactMode::stick: return condition == 0 ? ContactMode::slip_left : ContactMode::slip_right;
    default: return condition == 0 ? ContactMode::open : ContactMode::stick;
  }
}

// The equations with another mode of one contact, which changes them by one product. Between open and slip, that is
// (n + lean t) n'; between slip and stick, t (lean n - t)'.
bool BodyModes::change_mode_on_path(Index i, ContactMode mode) {
  const BodyContact& c = system_->contacts[i];
  const ContactMode from = modes[i];
  modes[i] = mode;
  const double weight_n = 1.0 / (ridge_ * response_[i].nn), weight_t = 1.0 / (ridge_ * response_[i].tt);
  const bool is_normal = from == ContactMode::open || mode == ContactMode::open;
  const bool starts_slip = slip_direction(mode) != 0.0;
  const double lean = -slip_direction(starts_slip ? mode : from) * c.friction;
  const double sign = starts_slip ? 1.0 : -1.0;
  BlockLu::SparseVector column, row;
  Index k = 0;
  for_bodies(c, [&](Index b, const Vector3& normal, const Vector3& tangent) {
    column.row[k] = row.row[k] = static_cast<int>(b);
    for (Index j = 0; j < 3; ++j) {
      column.value[k][j] = is_normal ? normal[j] + lean * tangent[j] : tangent[j];
      row.value[k][j] = sign * (is_normal ? weight_n * normal[j] : weight_n * lean * normal[j] - weight_t * tangent[j]);
    }
    ++k;
  });
  if (equations_.update(column, row)) return true;
  fill_equations();
  ++factorisations_;
  return equations_.factor();
}

// Where the path, going on in direction `sign` of lambda, first meets the border of a mode: within `step`, or nowhere.
// The condition that the change before has just met is none.
BodyModes::Border BodyModes::next_border(double sign, double step, const Border& last) const {
  Border next{modes.size(), 0, step};
  Pair value{}, slope{};
  for (Index i = 0; i < modes.size(); ++i) {
    const int count = list_conditions(i, here_, value);
    list_conditions(i, slope_, slope);
    for (int k = 0; k < count; ++k) {
      if (i == last.contact && k == last.condition) continue;
      const double rate = -sign * slope[static_cast<Index>(k)];
      const double rest = std::max(value[static_cast<Index>(k)], 0.0);
      if (rate > 0.0 && rest < next.step * rate) next = {i, k, rest / rate};
    }
  }
  return next;
}

bool BodyModes::follow_near(double ridge, int max_pieces) {
  ridge_ = ridge;
  is_near_ = true;
  start_path();
  fill_equations();
  ++factorisations_;
  if (!equations_.factor()) return false;
  double lambda = 1.0, sign = -1.0;
  Border last{modes.size(), 0, 0.0};
  seen_.clear();
  for (int piece = 0; piece < max_pieces; ++piece) {
    respond(drift_, slope_);
    if (last.contact < modes.size()) {
      Pair slope{};
      list_conditions(last.contact, slope_, slope);
      sign = slope[static_cast<Index>(last.condition)] > 0.0 ? 1.0 : -1.0;
    }
    const Border next = next_border(sign, sign < 0.0 ? lambda : HUGE_VAL, last);
    const bool is_end = next.contact == modes.size();
    if (is_end && sign > 0.0) return false;  // a ray
    lambda += sign * next.step;
    for (Index i = 0; i < modes.size(); ++i) {
      for (Index j = 0; j < 2; ++j) {
        here_.f[2 * i + j] += sign * next.step * slope_.f[2 * i + j];
        here_.u[i][j] += sign * next.step * slope_.u[i][j];
      }
    }
    if (is_end) {
      impulses = here_.f;
      impose_modes();
      return true;
    }
    const ContactMode from = modes[next.contact];
    const ContactMode to = next_mode(next.contact, next.condition, here_.u[next.contact][1]);
    const int before = factorisations_;
    if (!change_mode_on_path(next.contact, to)) return false;
    if (factorisations_ > before) correct_path(lambda);
    last = {next.contact, border_condition(from, to), 0.0};
    if (is_seen() || !(lambda <= k_largest_lambda)) return false;
  }
  return false;
}

}  // namespace tumble
