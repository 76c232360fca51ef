#include "tumble/lcp/contact_modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tumble {
namespace {

using Index = std::size_t;

// -1, 1 for the direction of slip, 0 else.
constexpr double k_ridge = 1e-10;      // [-] of the diagonal
constexpr double k_path_ridge = 1e-8;  // the same along a path, where the last digits decide which way it goes
constexpr double k_round_off = 1e-13;  // relative: contradictions below are not real

bool is_normal_change(ContactMode from, ContactMode to) {
  return (from == ContactMode::open) != (to == ContactMode::open);
}

}  // namespace

void ContactModes::start(const ContactStructure& structure) {
  const Index m = structure.places.size();
  swept_.assign(2 * m, 0.0);
  modes.assign(m, ContactMode::open);
}

void ContactModes::sweep(const ContactStructure& structure, int num_sweeps) {
  std::vector<double>& f = swept_;
  const auto velocity = [&](Index row) {
    double sum = structure.b[row];
    for (Index e = structure.row_begin[row]; e < structure.row_begin[row + 1]; ++e) {
      sum += structure.entry[e] * f[static_cast<Index>(structure.column[e])];
    }
    return sum;
  };
  for (int sweep = 0; sweep < num_sweeps; ++sweep) {
    for (Index i = 0; i < structure.places.size(); ++i) {
      const ContactPlace& place = structure.places[i];
      if (place.c < 0) continue;
      const double f_n = f[2 * i] - velocity(2 * i) / structure.diagonal[2 * i];
      f[2 * i] = std::max(f_n, 0.0);
      modes[i] = !(f_n > 0.0) ? ContactMode::open : place.has_friction() ? ContactMode::stick : ContactMode::slip_right;
      if (!place.has_friction()) continue;
      const double limit = place.mu() * f[2 * i];
      const double f_t =
          modes[i] == ContactMode::open ? 0.0 : f[2 * i + 1] - velocity(2 * i + 1) / structure.diagonal[2 * i + 1];
      f[2 * i + 1] = std::clamp(f_t, -limit, limit);
      if (f_t < -limit) modes[i] = ContactMode::slip_right;
      if (f_t > limit) modes[i] = ContactMode::slip_left;
    }
  }
}

void ContactModes::hold(const ContactStructure& structure) {
  for (Index i = 0; i < modes.size(); ++i) {
    const bool slid_before = slip_direction(modes[i]) * structure.b[2 * i + 1] > 0.0;
    if (structure.places[i].has_friction() && modes[i] != ContactMode::open && !slid_before)
      modes[i] = ContactMode::stick;
  }
}

void ContactModes::read_basis(const ContactStructure& structure, const std::vector<std::uint8_t>& basis) {
  const auto is_basic = [&](int j) { return j >= 0 && basis[static_cast<Index>(j)] != 0; };
  modes.clear();
  for (const ContactPlace& p : structure.places) {
    const bool is_closed = is_basic(p.c);
    const bool slips = is_basic(p.s);
    ContactMode mode = ContactMode::open;
    if (is_closed) mode = ContactMode::stick;
    if (is_closed && (slips || !p.has_friction())) {
      mode = is_basic(p.plus) ? ContactMode::slip_left : ContactMode::slip_right;
    }
    modes.push_back(mode);
  }
}

void ContactModes::list_unknowns(const ContactStructure& structure) {
  unknown_.clear();
  equation_.assign(2 * structure.places.size(), -1);
  const auto add = [&](Index row) {
    equation_[row] = static_cast<int>(unknown_.size());
    unknown_.push_back(static_cast<int>(row));
  };
  for (Index i = 0; i < structure.places.size(); ++i) {
    if (modes[i] == ContactMode::open || structure.places[i].c < 0) continue;
    add(2 * i);
    if (modes[i] == ContactMode::stick) add(2 * i + 1);
  }
}

// Rows of A for the unknowns. In a contact that slips, f_t = -direction mu f_n is no unknown of its own.
// Contacts that depend on each other make the equations singular: the ridge lets them share their load.
void ContactModes::fill_equations(const ContactStructure& structure) {
  const Index k = unknown_.size();
  matrix_.assign(k * k, 0.0);
  first_.resize(k);
  last_.resize(k);
  for (Index i = 0; i < k; ++i) {
    const auto row = static_cast<Index>(unknown_[i]);
    double* equation = matrix_.data() + i * k;
    int first = static_cast<int>(i), last = first;
    for (Index e = structure.row_begin[row]; e < structure.row_begin[row + 1]; ++e) {
      const auto j = static_cast<Index>(structure.column[e]);
      const Index contact = j / 2;
      int column = equation_[j];
      double entry = structure.entry[e];
      if (column < 0 && j % 2 == 1) {  // f_t of a contact that slips
        column = equation_[j - 1];
        entry *= -slip_direction(modes[contact]) * structure.places[contact].mu();
      }
      if (column < 0) continue;
      equation[column] += entry;
      first = std::min(first, column);
      last = std::max(last, column);
    }
    first_[i] = first;
    last_[i] = last;
    equation[i] += ridge_ * structure.diagonal[row];
  }
}

// LU in place, within the profile, without exchanges; the pivots are inverted.
void ContactModes::factor(const ContactStructure& structure) {
  ++factorisations_;
  list_unknowns(structure);
  fill_equations(structure);
  const Index k = unknown_.size();
  for (Index i = 0; i < k; ++i) {
    double* row = matrix_.data() + i * k;
    for (auto c = static_cast<Index>(first_[i]); c < i; ++c) {
      if (row[c] == 0.0) continue;
      const double* from = matrix_.data() + c * k;
      const double factor = row[c] * from[c];
      row[c] = factor;
      const auto end = static_cast<Index>(last_[c]) + 1;
      for (Index j = c + 1; j < end; ++j) row[j] -= factor * from[j];
      last_[i] = std::max(last_[i], last_[c]);
    }
    if (row[i] == 0.0) row[i] = ridge_ * std::abs(structure.diagonal[static_cast<Index>(unknown_[i])]);
    row[i] = 1.0 / row[i];
  }
}

// The impulses with which the velocities that the modes hold at 0 are 0, for b in place of the structure's own.
void ContactModes::find_impulses(const ContactStructure& structure, const std::vector<double>& b,
                                 std::vector<double>& f) {
  const Index k = unknown_.size();
  std::vector<double>& x = solution_;
  x.resize(k);
  for (Index i = 0; i < k; ++i) {
    const double* row = matrix_.data() + i * k;
    double sum = -b[static_cast<Index>(unknown_[i])];
    for (auto j = static_cast<Index>(first_[i]); j < i; ++j) sum -= row[j] * x[j];
    x[i] = sum;
  }
  for (Index i = k; i-- > 0;) {
    const double* row = matrix_.data() + i * k;
    double sum = x[i];
    for (Index j = i + 1; j <= static_cast<Index>(last_[i]); ++j) sum -= row[j] * x[j];
    x[i] = sum * row[i];
  }
  f.assign(2 * structure.places.size(), 0.0);
  for (Index i = 0; i < k; ++i) f[static_cast<Index>(unknown_[i])] = x[i];
  for (Index i = 0; i < structure.places.size(); ++i) {
    const double direction = slip_direction(modes[i]);
    if (direction != 0.0 && structure.places[i].has_friction()) {
      f[2 * i + 1] = -direction * structure.places[i].mu() * f[2 * i];
    }
  }
}

// u = A f + b.
void ContactModes::find_velocities(const ContactStructure& structure, const std::vector<double>& f,
                                   const std::vector<double>& b, std::vector<double>& u) const {
  u.resize(f.size());
  for (Index row = 0; row < u.size(); ++row) {
    double sum = 0.0;
    for (Index e = structure.row_begin[row]; e < structure.row_begin[row + 1]; ++e) {
      sum += structure.entry[e] * f[static_cast<Index>(structure.column[e])];
    }
    u[row] = sum + b[row];
  }
}

// u of f, and the sizes of the terms that each u is a sum of, with the largest b among them.
void ContactModes::find_velocities_and_sizes(const ContactStructure& structure) {
  double speed = 0.0;
  for (const double b_i : structure.b) speed = std::max(speed, std::abs(b_i));
  u_.resize(f_.size());
  size_.resize(f_.size());
  for (Index row = 0; row < u_.size(); ++row) {
    double sum = 0.0, size = speed;
    for (Index e = structure.row_begin[row]; e < structure.row_begin[row + 1]; ++e) {
      const double term = structure.entry[e] * f_[static_cast<Index>(structure.column[e])];
      sum += term;
      size += std::abs(term);
    }
    u_[row] = sum + structure.b[row];
    size_[row] = size;
  }
}

// Takes away what the ridge did to f: the velocities that the modes hold at 0 are made 0, up to round-off.
void ContactModes::refine(const ContactStructure& structure) {
  constexpr int max_refinements = 4;
  for (int count = 0;; ++count) {
    find_velocities_and_sizes(structure);
    double largest = 0.0;
    for (const int row : unknown_) {
      const auto i = static_cast<Index>(row);
      largest = std::max(largest, std::abs(u_[i]) / size_[i]);
    }
    if (count == max_refinements || largest <= k_round_off / 100.0) return;
    find_impulses(structure, u_, f_slope_);
    for (Index i = 0; i < f_.size(); ++i) f_[i] += f_slope_[i];
  }
}

// What a contact's impulse and velocity say against its mode: the mode it should have instead, and by how much they
// contradict, relative to the terms that the velocity is a sum of.
ContactModes::Objection ContactModes::objection(const ContactStructure& structure, Index i) const {
  const ContactPlace& place = structure.places[i];
  const double f_n = f_[2 * i], f_t = f_[2 * i + 1], u_n = u_[2 * i], u_t = u_[2 * i + 1];
  const double size_n = size_[2 * i], size_t = size_[2 * i + 1];
  const bool has_cone = place.has_friction();
  if (modes[i] == ContactMode::open) {
    return {has_cone ? ContactMode::stick : ContactMode::slip_right, -u_n / size_n};
  }
  const double pull = -f_n * structure.diagonal[2 * i] / size_n;
  if (pull > k_round_off || !has_cone) return {ContactMode::open, pull};
  if (modes[i] == ContactMode::stick) {
    const double excess = (std::abs(f_t) - place.mu() * f_n) * structure.diagonal[2 * i + 1] / size_t;
    return {f_t > 0.0 ? ContactMode::slip_left : ContactMode::slip_right, excess};
  }
  return {ContactMode::stick, -slip_direction(modes[i]) * u_t / size_t};
}

// The number of modes changed; nothing contradicts them if it is 0. Of all changes, those that open or close contacts
// come first: friction found with a wrong set of closed contacts tells little, and a contact told to slip by mistake is
// not told to stick again where another one holds the same bodies.
int ContactModes::change_modes(const ContactStructure& structure, Change change) {
  objections_.clear();
  bool has_normal = false;
  Index worst = modes.size();
  double worst_size = k_round_off;
  for (Index i = 0; i < modes.size(); ++i) {
    objections_.push_back({modes[i], 0.0});
    if (structure.places[i].c < 0) continue;
    const Objection found = objection(structure, i);
    if (!(found.size > k_round_off)) continue;
    objections_.back() = found;
    has_normal = has_normal || is_normal_change(modes[i], found.mode);
    if (found.size > worst_size) {
      worst = i;
      worst_size = found.size;
    }
  }
  int num_changes = 0;
  for (Index i = 0; i < modes.size(); ++i) {
    const ContactMode mode = objections_[i].mode;
    if (mode == modes[i]) continue;
    if (change == Change::worst ? i != worst : has_normal && !is_normal_change(modes[i], mode)) continue;
    modes[i] = mode;
    ++num_changes;
  }
  return num_changes;
}

bool ContactModes::run(const ContactStructure& structure, Change change, int max_rounds) {
  seen_.clear();
  factorisations_ = 0;
  ridge_ = k_ridge;
  for (int round = 1;; ++round) {
    factor(structure);
    find_impulses(structure, structure.b, f_);
    refine(structure);
    if (change_modes(structure, change) == 0) return true;
    if (round == max_rounds || is_seen()) return false;
  }
}

// b + lambda drift is a problem that the impulses of the sweeps solve for lambda = 1, and the one asked for is at 0.
void ContactModes::find_drift(const ContactStructure& structure) {
  find_velocities(structure, swept_, structure.b, u_);
  drift_.assign(u_.size(), 0.0);
  for (Index i = 0; i < modes.size(); ++i) {
    const Index n = 2 * i, t = n + 1;
    if (modes[i] == ContactMode::open) {
      drift_[n] = std::abs(u_[n]) - u_[n];
      continue;
    }
    drift_[n] = -u_[n];
    drift_[t] = slip_direction(modes[i]) * std::abs(u_[t]) - u_[t];
  }
}

// Conditions of contact i in its mode: value >= 0, the mode that follows where it reaches 0. At most two.
int ContactModes::list_conditions(const ContactStructure& structure, Index i, const std::vector<double>& f,
                                  const std::vector<double>& u, std::array<double, 2>& values) const {
  const Index n = 2 * i, t = n + 1;
  const double limit = structure.places[i].mu() * f[n];
  switch (modes[i]) {
    case ContactMode::open: values[0] = u[n]; return 1;
    case ContactMode::stick: values = {limit - f[t], limit + f[t]}; return 2;
    default: values = {f[n], slip_direction(modes[i]) * u[t]}; return structure.places[i].has_friction() ? 2 : 1;
  }
}

ContactMode ContactModes::next_mode(const ContactStructure& structure, Index i, int condition, double u_t) const {
  switch (modes[i]) {
    case ContactMode::open:
      return structure.places[i].has_friction() && u_t < 0.0 ? ContactMode::slip_left : ContactMode::slip_right;
    case ContactMode::stick: return condition == 0 ? ContactMode::slip_left : ContactMode::slip_right;
    default: return condition == 0 ? ContactMode::open : ContactMode::stick;
  }
}

// The condition in which a mode just taken is at its border: the one that must grow from there on.
int ContactModes::border_condition(ContactMode from, ContactMode to) {
  if (to == ContactMode::stick) return from == ContactMode::slip_left ? 0 : 1;
  return from == ContactMode::stick ? 1 : 0;
}

bool ContactModes::follow(const ContactStructure& structure, int max_steps) {
  constexpr double largest_lambda = 1000.0;  // far back is the way to a ray
  ridge_ = k_path_ridge;
  find_drift(structure);
  double lambda = 1.0, sign = -1.0;
  Index changed = modes.size();
  int border = 0;
  seen_.clear();
  factorisations_ = 0;
  for (int step_count = 0; step_count < max_steps; ++step_count) {
    factor(structure);
    find_impulses(structure, structure.b, f_);
    find_impulses(structure, drift_, f_slope_);
    find_velocities(structure, f_, structure.b, u_);
    find_velocities(structure, f_slope_, drift_, u_slope_);
    std::array<double, 2> value{}, slope{};
    if (changed < modes.size()) {
      list_conditions(structure, changed, f_slope_, u_slope_, slope);
      sign = slope[static_cast<Index>(border)] > 0.0 ? 1.0 : -1.0;
    }
    double step = sign < 0.0 ? lambda : std::numeric_limits<double>::infinity();
    Index next = modes.size();
    int next_condition = 0;
    for (Index i = 0; i < modes.size(); ++i) {
      if (structure.places[i].c < 0) continue;
      const int count = list_conditions(structure, i, f_, u_, value);
      list_conditions(structure, i, f_slope_, u_slope_, slope);
      for (int k = 0; k < count; ++k) {
        if (i == changed && k == border) continue;
        const double rate = -sign * slope[static_cast<Index>(k)];
        const double rest = std::max(value[static_cast<Index>(k)] + lambda * slope[static_cast<Index>(k)], 0.0);
        if (rate > 0.0 && rest < step * rate) {
          step = rest / rate;
          next = i;
          next_condition = k;
        }
      }
    }
    if (next == modes.size()) return sign < 0.0;
    lambda += sign * step;
    const ContactMode from = modes[next];
    modes[next] = next_mode(structure, next, next_condition, u_[2 * next + 1] + lambda * u_slope_[2 * next + 1]);
    border = border_condition(from, modes[next]);
    changed = next;
    if (is_seen() || lambda > largest_lambda) return false;
  }
  return false;
}

// True if these modes were tried before: the rounds would go in a circle.
bool ContactModes::is_seen() {
  std::uint64_t hash = 1469598103934665603u;  // FNV-1a
  for (const ContactMode mode : modes) hash = (hash ^ static_cast<std::uint64_t>(mode)) * 1099511628211u;
  const bool is_seen = std::find(seen_.begin(), seen_.end(), hash) != seen_.end();
  seen_.push_back(hash);
  return is_seen;
}

}  // namespace tumble
