#include "tumble/lcp/contact_modes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tumble {
namespace {

using Index = std::size_t;

// -1, 1 for the direction of slip, 0 else.
double slip_direction(ContactMode mode) {
  return mode == ContactMode::slip_left ? -1.0 : mode == ContactMode::slip_right ? 1.0 : 0.0;
}

bool has_friction(const ContactPlace& place) { return place.s >= 0 && place.c >= 0 && place.friction > 0.0; }

}  // namespace

void ContactModes::guess(const ContactStructure& structure) {
  const Index m = structure.places.size();
  f_.assign(2 * m, 0.0);
  modes.assign(m, ContactMode::open);
  const auto velocity = [&](Index row) {
    double sum = structure.b[row];
    for (Index e = structure.row_begin[row]; e < structure.row_begin[row + 1]; ++e) {
      sum += structure.entry[e] * f_[static_cast<Index>(structure.column[e])];
    }
    return sum;
  };
  for (int sweep = 0; sweep < 2; ++sweep) {
    for (Index i = 0; i < m; ++i) {
      const ContactPlace& place = structure.places[i];
      if (place.c < 0) continue;
      const double A_nn = structure.diagonal[2 * i];
      const double u_n = velocity(2 * i) - A_nn * f_[2 * i];
      if (u_n >= 0.0) {
        f_[2 * i] = f_[2 * i + 1] = 0.0;
        modes[i] = ContactMode::open;
      } else {
        f_[2 * i] = -u_n / A_nn;
        modes[i] = has_friction(place) ? ContactMode::stick : ContactMode::slip_right;
      }
      if (!has_friction(place) || modes[i] == ContactMode::open) continue;
      const double limit = place.mu() * f_[2 * i];
      const double A_tt = structure.diagonal[2 * i + 1];
      const double f_t = f_[2 * i + 1] - velocity(2 * i + 1) / A_tt;
      f_[2 * i + 1] = std::clamp(f_t, -limit, limit);
      if (f_t < -limit) modes[i] = ContactMode::slip_right;
      if (f_t > limit) modes[i] = ContactMode::slip_left;
    }
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
    if (is_closed && (slips || !has_friction(p))) {
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
void ContactModes::fill_equations(const ContactStructure& structure) {
  const Index k = unknown_.size();
  matrix_.assign(k * k, 0.0);
  right_.resize(k);
  first_.resize(k);
  last_.resize(k);
  pivot_size_.resize(k);
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
    right_[i] = -structure.b[row];
    pivot_size_[i] = std::abs(structure.diagonal[row]);
  }
}

// LU in place, within the profile, without exchanges. An equation that depends on those before it gets the pivot 0; its
// unknown stays 0, and the equation holds by itself if the system is consistent.
void ContactModes::factor() {
  constexpr double dependent = 1e-11;  // of the pivot before elimination
  const Index k = unknown_.size();
  for (Index i = 0; i < k; ++i) {
    double* row = matrix_.data() + i * k;
    for (auto c = static_cast<Index>(first_[i]); c < i; ++c) {
      const double* from = matrix_.data() + c * k;
      if (row[c] == 0.0) continue;
      if (from[c] == 0.0) {
        row[c] = 0.0;
        continue;
      }
      const double factor = row[c] / from[c];
      row[c] = factor;
      const auto end = static_cast<Index>(last_[c]) + 1;
      for (Index j = c + 1; j < end; ++j) row[j] -= factor * from[j];
      last_[i] = std::max(last_[i], last_[c]);
      right_[i] -= factor * right_[c];
    }
    if (std::abs(row[i]) <= dependent * pivot_size_[i]) row[i] = 0.0;
  }
}

void ContactModes::solve(const ContactStructure& structure) {
  list_unknowns(structure);
  fill_equations(structure);
  factor();
  const Index k = unknown_.size();
  std::vector<double>& x = right_;
  for (Index i = k; i-- > 0;) {
    const double* row = matrix_.data() + i * k;
    if (row[i] == 0.0) {
      x[i] = 0.0;
      continue;
    }
    double sum = x[i];
    for (Index j = i + 1; j <= static_cast<Index>(last_[i]); ++j) sum -= row[j] * x[j];
    x[i] = sum / row[i];
  }
  f_.assign(2 * structure.places.size(), 0.0);
  for (Index i = 0; i < k; ++i) f_[static_cast<Index>(unknown_[i])] = x[i];
  for (Index i = 0; i < structure.places.size(); ++i) {
    const double direction = slip_direction(modes[i]);
    if (direction != 0.0 && has_friction(structure.places[i])) {
      f_[2 * i + 1] = -direction * structure.places[i].mu() * f_[2 * i];
    }
  }
}

void ContactModes::find_velocities(const ContactStructure& structure) {
  u_.resize(f_.size());
  for (Index row = 0; row < u_.size(); ++row) {
    double sum = 0.0;
    for (Index e = structure.row_begin[row]; e < structure.row_begin[row + 1]; ++e) {
      sum += structure.entry[e] * f_[static_cast<Index>(structure.column[e])];
    }
    u_[row] = sum + structure.b[row];
  }
}

int ContactModes::change_modes(const ContactStructure& structure, double speed) {
  const double tolerance = 1e-13 * speed;
  int num_changes = 0;
  for (Index i = 0; i < modes.size(); ++i) {
    const ContactPlace& place = structure.places[i];
    if (place.c < 0) continue;
    const double f_n = f_[2 * i], f_t = f_[2 * i + 1], u_n = u_[2 * i], u_t = u_[2 * i + 1];
    ContactMode mode = modes[i];
    if (mode == ContactMode::open) {
      if (u_n < -tolerance) mode = has_friction(place) ? ContactMode::stick : ContactMode::slip_right;
    } else if (f_n * structure.diagonal[2 * i] < -tolerance) {
      mode = ContactMode::open;
    } else if (mode == ContactMode::stick) {
      if ((std::abs(f_t) - place.mu() * f_n) * structure.diagonal[2 * i + 1] > tolerance) {
        mode = f_t > 0.0 ? ContactMode::slip_left : ContactMode::slip_right;
      }
    } else if (has_friction(place) && slip_direction(mode) * u_t < -tolerance) {
      mode = ContactMode::stick;
    }
    num_changes += mode != modes[i];
    modes[i] = mode;
  }
  return num_changes;
}

bool ContactModes::run(const ContactStructure& structure, double speed, int max_rounds) {
  for (rounds_ = 1; rounds_ <= max_rounds; ++rounds_) {
    solve(structure);
    find_velocities(structure);
    if (change_modes(structure, speed) == 0) return true;
  }
  return false;
}

void ContactModes::write(const ContactStructure& structure, std::vector<double>& z,
                         std::vector<std::uint8_t>& basis) const {
  z.assign(structure.owner.size(), 0.0);
  basis.assign(z.size(), 0);
  for (Index i = 0; i < modes.size(); ++i) {
    const ContactPlace& p = structure.places[i];
    const auto set = [&](int j, double value) {
      z[static_cast<Index>(j)] = std::max(value, 0.0);
      basis[static_cast<Index>(j)] = 1;
    };
    if (p.c >= 0 && modes[i] != ContactMode::open) set(p.c, f_[2 * i]);
    if (p.s < 0) continue;
    const double f_t = f_[2 * i + 1], u_t = u_[2 * i + 1];
    if (modes[i] != ContactMode::open && has_friction(p)) set(f_t > 0.0 ? p.plus : p.minus, std::abs(f_t));
    if (modes[i] != ContactMode::stick) set(p.s, std::abs(u_t) / p.slip);
  }
}

}  // namespace tumble
