#include "tumble/lcp/contact_structure.hpp"

#include <algorithm>
#include <cmath>

#include "tumble/math/target_clones.hpp"

namespace tumble {
namespace {

// The contact of which row s is the cone: one entry > 0 or none, and two equal ones < 0.
bool read_cone(const LcpProblem& problem, int s, ContactPlace& place) {
  place = {};
  place.s = s;
  const int n = static_cast<int>(problem.size());
  const double* row = problem.M.data() + static_cast<std::size_t>(s) * problem.size();
  if (problem.q[static_cast<std::size_t>(s)] != 0.0) return false;
  for (int j = 0; j < n; ++j) {
    if (row[j] == 0.0) continue;
    if (row[j] > 0.0) {
      if (place.c >= 0) return false;
      place.c = j;
      place.friction = row[j];
    } else if (place.plus < 0) {
      place.plus = j;
      place.cone = -row[j];
    } else if (place.minus < 0 && -row[j] == place.cone) {
      place.minus = j;
    } else {
      return false;
    }
  }
  return place.minus >= 0;
}

// x and y, entries of row i and column j, differ by no more than the round-off of the products they were formed from,
// which is proportional to the diagonal of A where A is semidefinite. Where there is no diagonal they must be equal.
bool is_near(const LcpProblem& problem, std::size_t i, std::size_t j, double x, double y) {
  constexpr double round_off = 3e-14;
  return x == y || (x - y) * (x - y) <= round_off * round_off * problem(i, i) * problem(j, j);
}

// How many entries of two rows are not each other's negatives. Written so that it becomes vector code.
TUMBLE_INSTRUCTION_SETS
int count_unlike(const double* a, const double* b, int n) {
  int count = 0;
  for (int j = 0; j < n; ++j) count += a[j] + b[j] != 0.0;
  return count;
}

// Rows of plus and minus are each other's negatives, but for the slip, of which both hold the same share > 0.
bool has_friction_rows(const LcpProblem& problem, const std::vector<ContactPlace>& places) {
  const std::size_t n = problem.size();
  double speed = 0.0;
  for (const double q_i : problem.q) speed = std::max(speed, std::abs(q_i));
  for (const ContactPlace& p : places) {
    const auto plus = static_cast<std::size_t>(p.plus), minus = static_cast<std::size_t>(p.minus);
    if (!(std::abs(problem.q[plus] + problem.q[minus]) <= 1e-15 * speed)) return false;
    const double* row_plus = problem.M.data() + plus * n;
    const double* row_minus = problem.M.data() + minus * n;
    if (!(row_plus[p.s] > 0.0)) return false;
    const bool is_exact =
        row_plus[p.s] == row_minus[p.s] && count_unlike(row_plus, row_minus, static_cast<int>(n)) == 1;
    for (std::size_t j = 0; j < n && !is_exact; ++j) {
      const bool is_slip = static_cast<int>(j) == p.s;
      if (!is_near(problem, plus, j, row_plus[j], is_slip ? row_minus[j] : -row_minus[j])) return false;
    }
  }
  return true;
}

// Rows of A are velocities in one unit, impulses too: A is symmetric.
bool is_symmetric(const LcpProblem& problem, const ContactStructure& structure) {
  const auto index = [&](std::size_t row) {
    const ContactPlace& place = structure.places[row / 2];
    return static_cast<std::size_t>(row % 2 == 0 ? place.c : place.plus);
  };
  for (std::size_t row = 0; row + 1 < structure.row_begin.size(); ++row) {
    for (std::size_t e = structure.row_begin[row]; e < structure.row_begin[row + 1]; ++e) {
      const std::size_t i = index(row), j = index(static_cast<std::size_t>(structure.column[e]));
      if (!is_near(problem, i, j, structure.entry[e], problem(j, i))) return false;
    }
  }
  return true;
}

}  // namespace

bool read_responses(const LcpProblem& problem, ContactStructure& structure) {
  const std::size_t n = problem.size();
  structure.row_begin.assign(1, 0);
  structure.column.clear();
  structure.entry.clear();
  structure.diagonal.clear();
  structure.b.clear();
  for (const ContactPlace& p : structure.places) {
    for (const int i : {p.c, p.plus}) {
      const auto own = static_cast<int>(structure.b.size());
      double diagonal = 0.0;
      if (i >= 0) {
        const double* row = problem.M.data() + static_cast<std::size_t>(i) * n;
        int column = 0;
        for (const ContactPlace& other : structure.places) {
          for (const int j : {other.c, other.plus}) {
            if (j >= 0 && row[j] != 0.0) {
              structure.column.push_back(column);
              structure.entry.push_back(row[j]);
              if (column == own) diagonal = row[j];
            }
            ++column;
          }
          if (other.s < 0) continue;
          if (row[other.s] != 0.0 && i != other.plus) return false;
          const auto plus = static_cast<std::size_t>(other.plus);
          if (!is_near(problem, static_cast<std::size_t>(i), plus, row[other.plus], -row[other.minus])) return false;
        }
        if (!(diagonal > 0.0)) return false;
      }
      structure.b.push_back(i >= 0 ? problem.q[static_cast<std::size_t>(i)] : 0.0);
      structure.diagonal.push_back(diagonal);
      structure.row_begin.push_back(structure.column.size());
    }
  }
  return true;
}

bool find_contacts(const LcpProblem& problem, ContactStructure& structure) {
  const int n = static_cast<int>(problem.size());
  std::vector<ContactPlace>& places = structure.places;
  std::vector<int>& owner = structure.owner;
  places.clear();
  owner.assign(problem.size(), -1);
  const auto claim = [&](int j, int contact) {
    if (j < 0) return true;
    const bool is_free = owner[static_cast<std::size_t>(j)] < 0;
    owner[static_cast<std::size_t>(j)] = contact;
    return is_free;
  };
  // Cone rows have no diagonal; a velocity row without one would be a contact between immovable things.
  for (int i = 0; i < n; ++i) {
    if (problem(static_cast<std::size_t>(i), static_cast<std::size_t>(i)) != 0.0) continue;
    ContactPlace p;
    if (!read_cone(problem, i, p)) return false;
    const int contact = static_cast<int>(places.size());
    if (!claim(p.c, contact) || !claim(p.plus, contact) || !claim(p.minus, contact) || !claim(p.s, contact)) {
      return false;
    }
    places.push_back(p);
  }
  if (places.empty() || !has_friction_rows(problem, places)) return false;
  for (ContactPlace& p : places) p.slip = problem(static_cast<std::size_t>(p.plus), static_cast<std::size_t>(p.s));
  for (int j = 0; j < n; ++j) {  // what no cone names is a normal of its own
    if (owner[static_cast<std::size_t>(j)] >= 0) continue;
    places.emplace_back().c = j;
  }
  return read_responses(problem, structure) && is_symmetric(problem, structure);
}

void write_contacts(const ContactStructure& structure, const std::vector<ContactMode>& modes,
                    const std::vector<double>& f, const std::vector<double>& u, std::vector<double>& z,
                    std::vector<std::uint8_t>& basis) {
  z.assign(structure.owner.size(), 0.0);
  basis.assign(z.size(), 0);
  const auto set = [&](int j, double value) {
    z[static_cast<std::size_t>(j)] = std::max(value, 0.0);
    basis[static_cast<std::size_t>(j)] = 1;
  };
  for (std::size_t i = 0; i < structure.places.size(); ++i) {
    const ContactPlace& p = structure.places[i];
    const double f_t = f[2 * i + 1], u_t = u[2 * i + 1];
    const bool is_closed = p.c >= 0 && modes[i] != ContactMode::open;
    if (is_closed) set(p.c, f[2 * i]);
    if (p.s < 0) continue;
    const bool is_plus = is_closed && f_t != 0.0 ? f_t > 0.0 : u_t < 0.0;
    set(is_plus ? p.plus : p.minus, std::abs(f_t));
    if (modes[i] != ContactMode::stick) set(p.s, std::abs(u_t) / p.slip);
  }
}

void contact_row_sizes(const LcpProblem& problem, const std::vector<ContactPlace>& places, std::vector<double>& sizes) {
  double speed = 0.0;
  for (const double q_i : problem.q) speed = std::max(speed, std::abs(q_i));
  sizes.assign(problem.size(), speed);
  for (const ContactPlace& p : places) {
    if (p.s < 0) continue;
    const auto of = static_cast<std::size_t>(p.c >= 0 ? p.c : p.plus);
    sizes[static_cast<std::size_t>(p.s)] = p.cone * speed / problem(of, of);
  }
}

}  // namespace tumble
