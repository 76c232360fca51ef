#include "tumble/lcp/body_modes.hpp"

#include <algorithm>
#include <cmath>

namespace tumble {
namespace {

using Index = std::size_t;

constexpr double k_ridge = 1e-10;          // [-] of the diagonal of A
constexpr double k_round_off = 1e-14;      // relative: contradictions below are not real
constexpr double k_rounding_share = 1e-5;  // an accepted residual of 1e-10 is then some 5 times the rounding of terms
constexpr int k_max_corrections = 12;      // each gains the digits that ridge over the smallest eigenvalue of A leaves

bool is_normal_change(ContactMode from, ContactMode to) {
  return (from == ContactMode::open) != (to == ContactMode::open);
}

double response(const Vector3& a, const Vector3& b, const Vector3& inverse_mass) {
  return a[0] * b[0] * inverse_mass[0] + a[1] * b[1] * inverse_mass[1] + a[2] * b[2] * inverse_mass[2];
}

void add_impulse(Vector3& v, const Vector3& inverse_mass, const Vector3& normal, const Vector3& tangent, double f_n,
                 double f_t) {
  for (Index j = 0; j < 3; ++j) v[j] += inverse_mass[j] * (normal[j] * f_n + tangent[j] * f_t);
}

// block += column row'
void add_product(Matrix3& block, const Vector3& column, const Vector3& row) {
  for (Index i = 0; i < 3; ++i) {
    for (Index j = 0; j < 3; ++j) block[i][j] += column[i] * row[j];
  }
}

}  // namespace

void BodyModes::load(const ContactSystem& system) {
  system_ = &system;
  factorisations_ = 0;
  const Index num_contacts = system.contacts.size(), num_bodies = system.inverse_mass.size();
  mass_.resize(num_bodies);
  for (Index b = 0; b < num_bodies; ++b) {
    for (Index j = 0; j < 3; ++j) mass_[b][j] = 1.0 / system.inverse_mass[b][j];
  }
  response_.assign(num_contacts, {});
  u_.resize(num_contacts);
  size_.resize(num_contacts);
  speed_ = 0.0;
  has_pairs_ = false;
  for (Index i = 0; i < num_contacts; ++i) {
    const BodyContact& c = system.contacts[i];
    Block& block = response_[i];
    for_bodies(c, [&](Index b, const Vector3& normal, const Vector3& tangent) {
      const Vector3& inverse_mass = system.inverse_mass[b];
      block.nn += response(normal, normal, inverse_mass);
      block.nt += response(normal, tangent, inverse_mass);
      block.tt += response(tangent, tangent, inverse_mass);
    });
    const auto [u_n, u_t] = velocity_at(c, system.velocity);
    speed_ = std::max({speed_, -u_n, std::abs(u_t)});
  }
}

// The pattern of the equations.
void BodyModes::find_pairs() {
  has_pairs_ = true;
  pairs_.clear();
  for (const BodyContact& c : system_->contacts) {
    if (c.body_a >= 0 && c.body_b >= 0) pairs_.push_back({std::min(c.body_a, c.body_b), std::max(c.body_a, c.body_b)});
  }
  std::sort(pairs_.begin(), pairs_.end());
  pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
  pair_of_.assign(system_->contacts.size(), -1);
  for (Index i = 0; i < pair_of_.size(); ++i) {
    const BodyContact& c = system_->contacts[i];
    if (c.body_a < 0 || c.body_b < 0) continue;
    const std::array<int, 2> pair = {std::min(c.body_a, c.body_b), std::max(c.body_a, c.body_b)};
    pair_of_[i] = static_cast<int>(std::lower_bound(pairs_.begin(), pairs_.end(), pair) - pairs_.begin());
  }
}

const std::vector<Vector3>& BodyModes::find_velocities() {
  v_ = system_->velocity;
  terms_.resize(v_.size());
  for (Index b = 0; b < v_.size(); ++b) {
    for (Index j = 0; j < 3; ++j) terms_[b][j] = std::abs(v_[b][j]);
  }
  for (Index i = 0; i < modes.size(); ++i) {
    const double f_n = impulses[2 * i], f_t = impulses[2 * i + 1];
    if (f_n == 0.0 && f_t == 0.0) continue;
    for_bodies(system_->contacts[i], [&](Index b, const Vector3& normal, const Vector3& tangent) {
      for (Index j = 0; j < 3; ++j) {
        const double w = system_->inverse_mass[b][j], term_n = w * normal[j] * f_n, term_t = w * tangent[j] * f_t;
        v_[b][j] += w * (normal[j] * f_n + tangent[j] * f_t);
        terms_[b][j] += std::abs(term_n) + std::abs(term_t);
      }
    });
  }
  return v_;
}

// u of the present velocities, and the sizes of the terms that they are sums of, impulse by impulse.
void BodyModes::find_contact_velocities() {
  for (Index i = 0; i < modes.size(); ++i) {
    const BodyContact& c = system_->contacts[i];
    double n = c.offset, t = c.tangent_offset;
    double size_n = speed_ + std::abs(n), size_t = speed_ + std::abs(t);
    for_bodies(c, [&](Index b, const Vector3& normal, const Vector3& tangent) {
      const Vector3 &v = v_[b], &terms = terms_[b];
      for (Index j = 0; j < 3; ++j) {
        n += normal[j] * v[j];
        t += tangent[j] * v[j];
        size_n += std::abs(normal[j]) * terms[j];
        size_t += std::abs(tangent[j]) * terms[j];
      }
    });
    u_[i] = {n, t};
    size_[i] = {size_n, size_t};
  }
}

double BodyModes::residual() {
  find_velocities();
  find_contact_velocities();
  double largest = 0.0;
  const auto add = [&](double violation, double size) {
    if (!(size > 0.0)) return;
    largest = std::max(largest, violation / (speed_ + k_rounding_share * size));
  };
  for (Index i = 0; i < modes.size(); ++i) {
    const double f_n = impulses[2 * i], f_t = impulses[2 * i + 1];
    const auto [u_n, u_t] = u_[i];
    add(std::abs(std::min(response_[i].nn * f_n, u_n)), size_[i][0]);
    const double limit = system_->contacts[i].friction * std::max(f_n, 0.0);
    const double next = std::clamp(f_t - u_t / response_[i].tt, -limit, limit);
    add(std::abs(f_t - next) * response_[i].tt, size_[i][1]);
  }
  return largest;
}

void BodyModes::sweep(int num_sweeps, double enough) {
  find_velocities();
  for (int sweep = 0; sweep < num_sweeps; ++sweep) {
    double change = 0.0;
    for (Index k = 0; k < modes.size(); ++k) {
      const Index i = sweep % 2 == 0 ? k : modes.size() - 1 - k;  // loads go down a stack one way, and up the other
      const BodyContact& c = system_->contacts[i];
      const Block& A = response_[i];
      double& f_n = impulses[2 * i];
      double& f_t = impulses[2 * i + 1];
      const auto [u_n, u_t] = velocity_at(c, v_);
      const OneContactSolution solution = propose_one_contact(
          {A.nn, A.nt, A.tt, u_n - A.nn * f_n - A.nt * f_t, u_t - A.nt * f_n - A.tt * f_t, c.friction});
      const double change_n = solution.f_n - f_n, change_t = solution.f_t - f_t;
      f_n = solution.f_n;
      f_t = solution.f_t;
      modes[i] = solution.mode;
      if (change_n == 0.0 && change_t == 0.0) continue;
      change = std::max({change, A.nn * std::abs(change_n), A.tt * std::abs(change_t)});
      for_bodies(c, [&](Index b, const Vector3& normal, const Vector3& tangent) {
        add_impulse(v_[b], system_->inverse_mass[b], normal, tangent, change_n, change_t);
      });
    }
    if (change <= enough * speed_) return;
  }
}

// Impulses that the modes allow: none where open, on the edge of the cone where the contact slips.
void BodyModes::impose_modes() {
  for (Index i = 0; i < modes.size(); ++i) {
    double& f_n = impulses[2 * i];
    double& f_t = impulses[2 * i + 1];
    if (modes[i] == ContactMode::open) {
      f_n = f_t = 0.0;
    } else if (modes[i] != ContactMode::stick) {
      f_t = -slip_direction(modes[i]) * system_->contacts[i].friction * f_n;
    }
  }
}

void BodyModes::fill_equations() {
  if (!has_pairs_) find_pairs();
  equations_.set_pattern(static_cast<int>(mass_.size()), pairs_);
  equations_.clear();
  for (Index b = 0; b < mass_.size(); ++b) {
    Matrix3& block = equations_.diagonal(static_cast<int>(b));
    for (Index j = 0; j < 3; ++j) block[j][j] = mass_[b][j];
  }
  for (Index i = 0; i < modes.size(); ++i) {
    if (modes[i] == ContactMode::open) continue;
    const BodyContact& c = system_->contacts[i];
    const auto add = [&](double weight, double lean, const Vector3& row_a, const Vector3& row_b, const Vector3& push_a,
                         const Vector3& push_b) {
      Vector3 column_a, column_b;
      for (Index j = 0; j < 3; ++j) {
        column_a[j] = weight * (row_a[j] + lean * push_a[j]);
        column_b[j] = weight * (row_b[j] + lean * push_b[j]);
      }
      if (c.body_a >= 0) add_product(equations_.diagonal(c.body_a), column_a, row_a);
      if (c.body_b >= 0) add_product(equations_.diagonal(c.body_b), column_b, row_b);
      if (pair_of_[i] < 0) return;
      const auto p = static_cast<Index>(pair_of_[i]);
      const bool is_ordered = c.body_a < c.body_b;
      add_product(is_ordered ? equations_.upper(p) : equations_.lower(p), column_a, row_b);
      add_product(is_ordered ? equations_.lower(p) : equations_.upper(p), column_b, row_a);
    };
    const double lean = -slip_direction(modes[i]) * c.friction;
    add(1.0 / (ridge_ * response_[i].nn), lean, c.normal_a, c.normal_b, c.tangent_a, c.tangent_b);
    if (modes[i] == ContactMode::stick)
      add(1.0 / (ridge_ * response_[i].tt), 0.0, c.tangent_a, c.tangent_b, c.normal_a, c.normal_b);
  }
}

// One step of the method of multipliers. Returns what was off before it: the largest velocity that the modes hold at 0,
// relative to its terms.
double BodyModes::correct() {
  double largest = 0.0;
  step_.assign(v_.size(), Vector3{});
  for (Index i = 0; i < modes.size(); ++i) {
    if (modes[i] == ContactMode::open) continue;
    const BodyContact& c = system_->contacts[i];
    const bool sticks = modes[i] == ContactMode::stick;
    const double pull_n = -u_[i][0] / (ridge_ * response_[i].nn);
    const double pull_t =
        sticks ? -u_[i][1] / (ridge_ * response_[i].tt) : -slip_direction(modes[i]) * c.friction * pull_n;
    if (size_[i][0] > 0.0) largest = std::max(largest, std::abs(u_[i][0]) / size_[i][0]);
    if (sticks && size_[i][1] > 0.0) largest = std::max(largest, std::abs(u_[i][1]) / size_[i][1]);
    for_bodies(c, [&](Index b, const Vector3& normal, const Vector3& tangent) {
      for (Index j = 0; j < 3; ++j) step_[b][j] += normal[j] * pull_n + tangent[j] * pull_t;
    });
  }
  if (largest <= k_round_off / 100.0) return largest;
  equations_.solve(step_);
  for (Index i = 0; i < modes.size(); ++i) {
    if (modes[i] == ContactMode::open) continue;
    BodyContact change = system_->contacts[i];
    change.offset = change.tangent_offset = 0.0;
    const auto [step_n, step_t] = velocity_at(change, step_);
    impulses[2 * i] -= (u_[i][0] + step_n) / (ridge_ * response_[i].nn);
    if (modes[i] == ContactMode::stick) impulses[2 * i + 1] -= (u_[i][1] + step_t) / (ridge_ * response_[i].tt);
  }
  impose_modes();
  return largest;
}

void BodyModes::project() {
  for (Index i = 0; i < modes.size(); ++i) {
    double& f_n = impulses[2 * i];
    double& f_t = impulses[2 * i + 1];
    f_n = std::max(f_n, 0.0);
    const double limit = system_->contacts[i].friction * f_n;
    f_t = std::clamp(f_t, -limit, limit);
  }
}

bool BodyModes::run(int max_rounds) {
  ridge_ = k_ridge;
  is_near_ = false;
  return iterate(max_rounds);
}

bool BodyModes::run_near(double ridge, int max_rounds) {
  ridge_ = ridge;
  is_near_ = true;
  return iterate(max_rounds);
}

bool BodyModes::iterate(int max_rounds) {
  const int max_corrections = is_near_ ? 1 : k_max_corrections;
  start_impulses_ = impulses;
  seen_.clear();
  for (int round = 1;; ++round) {
    fill_equations();
    ++factorisations_;
    if (!equations_.factor()) return false;
    // Modes that contradict each other have huge impulses; none of them may stay.
    impulses = start_impulses_;
    impose_modes();
    double before = HUGE_VAL;
    for (int count = 0; count < max_corrections; ++count) {
      find_velocities();
      find_contact_velocities();
      const double error = correct();
      if (!std::isfinite(error)) return false;
      if (error <= k_round_off / 100.0 || (count >= 2 && error > 0.5 * before)) break;
      before = error;
    }
    find_velocities();
    find_contact_velocities();
    if (change_modes() == 0) return true;
    if (round == max_rounds || is_seen()) return false;
  }
}

// What a contact's impulse and velocity say against its mode: the mode it should have instead, and by how much they
// contradict, relative to the terms that the velocity is a sum of.
BodyModes::Objection BodyModes::objection(Index i) const {
  const double mu = system_->contacts[i].friction;
  const double f_n = impulses[2 * i], f_t = impulses[2 * i + 1];
  auto [u_n, u_t] = u_[i];
  if (is_near_) {
    u_n += ridge_ * response_[i].nn * (f_n - start_impulses_[2 * i]);
    u_t += ridge_ * response_[i].tt * (f_t - start_impulses_[2 * i + 1]);
  }
  const auto [size_n, size_t] = size_[i];
  if (modes[i] == ContactMode::open) {
    return {mu > 0.0 ? ContactMode::stick : ContactMode::slip_right, size_n > 0.0 ? -u_n / size_n : 0.0};
  }
  const double pull = size_n > 0.0 ? -f_n * response_[i].nn / size_n : 0.0;
  if (pull > k_round_off) return {ContactMode::open, pull};
  if (!(size_t > 0.0) || (mu == 0.0 && modes[i] != ContactMode::stick)) return {modes[i], 0.0};
  if (modes[i] == ContactMode::stick) {
    const double excess = (std::abs(f_t) - mu * f_n) * response_[i].tt / size_t;
    return {f_t > 0.0 ? ContactMode::slip_left : ContactMode::slip_right, excess};
  }
  return {ContactMode::stick, -slip_direction(modes[i]) * u_t / size_t};
}

// The number of modes changed. Of all changes, those that open or close contacts come first: friction found with a
// wrong set of closed contacts tells little.
int BodyModes::change_modes() {
  objections_.clear();
  bool has_normal = false;
  for (Index i = 0; i < modes.size(); ++i) {
    objections_.push_back({modes[i], 0.0});
    const Objection found = objection(i);
    if (!(found.size > k_round_off)) continue;
    objections_.back() = found;
    has_normal = has_normal || is_normal_change(modes[i], found.mode);
  }
  int num_changes = 0;
  for (Index i = 0; i < modes.size(); ++i) {
    const ContactMode mode = objections_[i].mode;
    if (mode == modes[i] || (has_normal && !is_normal_change(modes[i], mode))) continue;
    modes[i] = mode;
    ++num_changes;
  }
  return num_changes;
}

// True if these modes were tried before: the rounds would go in a circle.
bool BodyModes::is_seen() {
  std::uint64_t hash = 1469598103934665603u;  // FNV-1a
  for (const ContactMode mode : modes) hash = (hash ^ static_cast<std::uint64_t>(mode)) * 1099511628211u;
  const bool is_seen = std::find(seen_.begin(), seen_.end(), hash) != seen_.end();
  seen_.push_back(hash);
  return is_seen;
}

}  // namespace tumble
