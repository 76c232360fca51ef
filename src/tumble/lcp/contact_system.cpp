#include "tumble/lcp/contact_system.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "tumble/math/format.hpp"

namespace tumble {
namespace {

using Index = std::size_t;

[[noreturn]] void refuse(const std::string& field, const std::string& range, double value) {
  throw std::invalid_argument(tumble::format("{}: must be {}, got {}", field, range, value));
}

void require_finite(const Vector3& values, const std::string& field) {
  for (Index i = 0; i < 3; ++i) {
    if (!std::isfinite(values[i])) refuse(tumble::format("{}[{}]", field, i), "finite", values[i]);
  }
}

// Row of J of one contact: what it takes from each of its two bodies.
struct Row {
  std::array<int, 2> body;
  std::array<const Vector3*, 2> part;
};

Row normal_row(const BodyContact& c) { return {{c.body_a, c.body_b}, {&c.normal_a, &c.normal_b}}; }
Row tangent_row(const BodyContact& c) { return {{c.body_a, c.body_b}, {&c.tangent_a, &c.tangent_b}}; }

// J_1 M^-1 J_2^T; the same bits for (1, 2) and (2, 1).
double response(const ContactSystem& system, const Row& row_1, const Row& row_2) {
  double sum = 0.0;
  for (Index k = 0; k < 2; ++k) {
    for (Index l = 0; l < 2; ++l) {
      if (row_1.body[k] < 0 || row_1.body[k] != row_2.body[l]) continue;
      const Vector3& inverse_mass = system.inverse_mass[static_cast<Index>(row_1.body[k])];
      double of_body = 0.0;
      for (Index i = 0; i < 3; ++i) of_body += (*row_1.part[k])[i] * (*row_2.part[l])[i] * inverse_mass[i];
      sum += of_body;
    }
  }
  return sum;
}

bool share_a_body(const BodyContact& c, const BodyContact& d) {
  return (c.body_a >= 0 && (c.body_a == d.body_a || c.body_a == d.body_b)) ||
         (c.body_b >= 0 && (c.body_b == d.body_a || c.body_b == d.body_b));
}

}  // namespace

void validate(const ContactSystem& system) {
  if (system.contacts.empty()) throw std::invalid_argument("contacts: must have at least 1 entry, got 0");
  if (system.velocity.size() != system.inverse_mass.size()) {
    throw std::invalid_argument(tumble::format("velocity: must have one entry per body ({}), got {}",
                                               system.inverse_mass.size(), system.velocity.size()));
  }
  const int num_bodies = static_cast<int>(system.inverse_mass.size());
  for (Index k = 0; k < system.inverse_mass.size(); ++k) {
    require_finite(system.inverse_mass[k], tumble::format("inverse_mass[{}]", k));
    require_finite(system.velocity[k], tumble::format("velocity[{}]", k));
    for (const double x : system.inverse_mass[k]) {
      if (x < 0.0) refuse(tumble::format("inverse_mass[{}]", k), ">= 0", x);
    }
  }
  for (Index k = 0; k < system.contacts.size(); ++k) {
    const BodyContact& c = system.contacts[k];
    const std::string name = tumble::format("contacts[{}]", k);
    const std::string bodies = tumble::format("in -1 .. {}", num_bodies - 1);
    if (c.body_a < -1 || c.body_a >= num_bodies) refuse(name + ".body_a", bodies, c.body_a);
    if (c.body_b < -1 || c.body_b >= num_bodies) refuse(name + ".body_b", bodies, c.body_b);
    if (c.body_a == c.body_b) refuse(name + ".body_b", "another body than body_a", c.body_b);
    require_finite(c.normal_a, name + ".normal_a");
    require_finite(c.normal_b, name + ".normal_b");
    require_finite(c.tangent_a, name + ".tangent_a");
    require_finite(c.tangent_b, name + ".tangent_b");
    if (!(std::isfinite(c.friction) && c.friction >= 0.0)) refuse(name + ".friction", "finite and >= 0", c.friction);
    if (!std::isfinite(c.offset)) refuse(name + ".offset", "finite", c.offset);
    if (!std::isfinite(c.tangent_offset)) refuse(name + ".tangent_offset", "finite", c.tangent_offset);
  }
}

LcpProblem as_lcp(const ContactSystem& system) {
  validate(system);
  const Index num_contacts = system.contacts.size();
  const Index n = 4 * num_contacts;
  LcpProblem problem{std::vector<double>(n * n, 0.0), std::vector<double>(n, 0.0), std::vector<double>(n, 0.0)};
  const auto entry = [&](Index i, Index j) -> double& { return problem.M[i * n + j]; };
  double speed = 0.0;
  for (Index i = 0; i < num_contacts; ++i) {
    const BodyContact& c = system.contacts[i];
    const Index c_i = i, plus_i = num_contacts + 2 * i, minus_i = plus_i + 1, s_i = 3 * num_contacts + i;
    for (Index j = 0; j < num_contacts; ++j) {
      const BodyContact& d = system.contacts[j];
      if (!share_a_body(c, d)) continue;
      const Index c_j = j, plus_j = num_contacts + 2 * j, minus_j = plus_j + 1;
      const double nn = response(system, normal_row(c), normal_row(d));
      const double nt = response(system, normal_row(c), tangent_row(d));
      const double tn = response(system, tangent_row(c), normal_row(d));
      const double tt = response(system, tangent_row(c), tangent_row(d));
      entry(c_i, c_j) = nn;
      entry(c_i, plus_j) = nt;
      entry(c_i, minus_j) = -nt;
      entry(plus_i, c_j) = tn;
      entry(minus_i, c_j) = -tn;
      entry(plus_i, plus_j) = entry(minus_i, minus_j) = tt;
      entry(plus_i, minus_j) = entry(minus_i, plus_j) = -tt;
    }
    entry(plus_i, s_i) = entry(minus_i, s_i) = 1.0;
    entry(s_i, c_i) = c.friction;
    entry(s_i, plus_i) = entry(s_i, minus_i) = -1.0;

    const auto [u_n, u_t] = velocity_at(c, system.velocity);
    problem.q[c_i] = u_n;
    problem.q[plus_i] = u_t;
    problem.q[minus_i] = -u_t;
    speed = std::max({speed, std::abs(u_n), std::abs(u_t)});
  }
  for (Index i = 0; i < num_contacts; ++i) {
    const double nn = problem.M[i * n + i];
    problem.row_sizes[i] = problem.row_sizes[num_contacts + 2 * i] = problem.row_sizes[num_contacts + 2 * i + 1] =
        speed;
    problem.row_sizes[3 * num_contacts + i] = nn > 0.0 ? speed / nn : 0.0;
  }
  return problem;
}

ContactMode contact_mode(double normal_impulse, double slip_speed, double u_t) {
  if (normal_impulse == 0.0) return ContactMode::open;
  if (slip_speed == 0.0) return ContactMode::stick;
  return u_t < 0.0 ? ContactMode::slip_left : ContactMode::slip_right;
}

std::vector<Vector3> velocities_after(const ContactSystem& system, const std::vector<double>& z) {
  validate(system);
  const Index num_contacts = system.contacts.size();
  if (z.size() != 4 * num_contacts) {
    throw std::invalid_argument(tumble::format("z: must have {} entries, got {}", 4 * num_contacts, z.size()));
  }
  std::vector<Vector3> v = system.velocity;
  for (Index i = 0; i < num_contacts; ++i) {
    const BodyContact& c = system.contacts[i];
    const double f_n = z[i];
    const double f_t = z[num_contacts + 2 * i] - z[num_contacts + 2 * i + 1];
    const Row normal = normal_row(c), tangent = tangent_row(c);
    for (Index k = 0; k < 2; ++k) {
      if (normal.body[k] < 0) continue;
      const auto body = static_cast<Index>(normal.body[k]);
      for (Index j = 0; j < 3; ++j) {
        v[body][j] += system.inverse_mass[body][j] * ((*normal.part[k])[j] * f_n + (*tangent.part[k])[j] * f_t);
      }
    }
  }
  return v;
}

}  // namespace tumble
