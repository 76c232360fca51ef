#include "tumble/drop/drop.hpp"

#include <array>
#include <cmath>

#include "tumble/lcp/enumerate.hpp"
#include "tumble/lcp/lemke.hpp"
#include "tumble/math/format.hpp"
#include "tumble/math/numeric.hpp"
#include "tumble/math/sin_cos.hpp"

namespace tumble::drop {
namespace {

// Parameters, checked once, with what the steps need of them.
struct Model {
  explicit Model(const Parameters& p) : parameters(p) {
    validate(p);
    M_inverse = {1.0 / p.m, 1.0 / p.m, 1.0 / moment_of_inertia(p)};
  }

  Parameters parameters;
  Vector3 M_inverse;  // diagonal of M^-1
};

void require_finite(const Vector3& values, const char* name) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!std::isfinite(values[i])) {
      throw std::invalid_argument(tumble::format("{}[{}]: must be finite, got {}", name, i, values[i]));
    }
  }
}

// a^T M^-1 b
double inner(const Vector3& a, const Vector3& M_inverse, const Vector3& b) {
  return a[0] * (M_inverse[0] * b[0]) + a[1] * (M_inverse[1] * b[1]) + a[2] * (M_inverse[2] * b[2]);
}

// ---- What part 1 is made of ----

// Corner minus centre of mass, world frame [m].
struct Arm {
  double x;
  double y;
};

// r = R(theta) (+-l/2, +-l/2) for the corners (-,-), (+,-), (+,+), (-,+).
std::array<Arm, 4> corner_arms(double theta, double l) {
  const auto [s, c] = sin_cos(theta);
  const double sh = s * (0.5 * l);
  const double ch = c * (0.5 * l);
  return {{{-ch + sh, -sh - ch}, {ch + sh, sh - ch}, {ch - sh, sh + ch}, {-ch - sh, -sh + ch}}};
}

int lowest(const std::array<Arm, 4>& arms) {
  int corner = 0;
  for (int k = 1; k < 4; ++k) {
    if (arms[k].y < arms[corner].y) corner = k;
  }
  return corner;
}

struct LowestCorner {
  Contacts contacts;
  int corner;
};

inline LowestCorner find_contact(const Vector3& q, double l) {
  const std::array<Arm, 4> arms = corner_arms(q[2], l);
  const int corner = lowest(arms);
  const Arm r = arms[corner];
  return {{{{1.0, 0.0, -r.y}, {0.0, 1.0, r.x}}, q[1] + r.y}, corner};
}

// ---- What part 2 is made of ----

Lcp form_lcp(const Jacobian& J, const Vector3& v, const Model& model) {
  const auto& [l, m, mu, eps, dt, delta, g, columns] = model.parameters;
  const double nn = inner(J.n, model.M_inverse, J.n) * dt;
  const double nt = inner(J.n, model.M_inverse, J.t) * dt;
  const double tt = inner(J.t, model.M_inverse, J.t) * dt;
  const Vector3 v_bounced = {(1.0 + eps) * v[0], (1.0 + eps) * v[1] - dt * g, (1.0 + eps) * v[2]};
  const Vector3 v_free = {v[0], v[1] - dt * g, v[2]};  // v + dt M^-1 f_e
  const double p_n = dot(J.n, v_bounced);
  const double p_t = dot(J.t, v_free);
  return {{{{nn, -nt, nt, 0.0}, {-nt, tt, -tt, 1.0}, {nt, -tt, tt, 1.0}, {mu, -1.0, -1.0, 0.0}}},
          {p_n, -p_t, p_t, 0.0}};
}

OneContact as_one_contact(const Lcp& lcp) {
  return {lcp.V[0][0], lcp.V[0][2], lcp.V[1][1], lcp.p[0], lcp.p[2], lcp.V[3][0]};
}

// True if the rows are those of one contact with a positive definite A, entry for entry.
bool has_contact_structure(const Lcp& lcp) {
  const OneContact c = as_one_contact(lcp);
  const LcpProblem problem = as_lcp(c);
  for (std::size_t i = 0; i < 4; ++i) {
    if (lcp.p[i] != problem.q[i]) return false;
    for (std::size_t j = 0; j < 4; ++j) {
      if (lcp.V[i][j] != problem(i, j)) return false;
    }
  }
  return c.A_nn > 0.0 && c.A_tt > 0.0 && c.A_nn * c.A_tt > c.A_nt * c.A_nt && c.friction >= 0.0;
}

// ---- What part 3 is made of ----

// v' = v + dt M^-1 (all forces),  q' = q + dt v' + (0, lift, 0), in place. False if a number left the range of double.
inline bool integrate(State& state, const Vector3& acceleration, double lift, double dt) {
  auto& [q, v] = state;
  for (std::size_t i = 0; i < 3; ++i) v[i] += dt * acceleration[i];
  for (std::size_t i = 0; i < 3; ++i) q[i] += dt * v[i];
  q[1] += lift;
  return all_finite(q) && all_finite(v);
}

// The step of the document, in place; fills `record`. Not in contact it is the same with f_c = 0 and no lift.
// Inlined so that `simulate`, which needs only the status, pays for nothing else.
[[gnu::always_inline]] inline void advance(State& state, StepRecord& record, const Model& model) {
  const Parameters& p = model.parameters;
  const auto [contacts, corner] = find_contact(state.q, p.l);
  const auto& [J, phi] = contacts;
  record = {.gap = phi, .corner = corner};

  Vector3 acceleration = {0.0, -p.g, 0.0};  // M^-1 f_e
  double lift = 0.0;
  if (phi < p.delta) {
    const OneContactSolution solution = solve_one_contact(as_one_contact(form_lcp(J, state.v, model)));
    for (std::size_t i = 0; i < 3; ++i) {
      acceleration[i] += model.M_inverse[i] * (J.n[i] * solution.f_n + J.t[i] * solution.f_t);  // f_t = f_t2 - f_t1
    }
    lift = p.delta;
    record.z = as_z(solution);
    record.mode = solution.mode;
    record.status = solution.status;
    record.residual = solution.residual;
  }
  if (!integrate(state, acceleration, lift, p.dt)) record.status = LcpStatus::numerical;
}

// ---- What part 4 is made of ----

// A record states the energies of each column; speeds above about 1e154 m/s have none in double.
bool has_energy(const State& state, const Parameters& p) {
  return std::isfinite(kinetic_energy(state.v, p) + potential_energy(state.q, p));
}

// Drops the columns from `columns` on.
void keep_columns(std::vector<double>& rows, std::size_t stride, std::size_t columns) {
  for (std::size_t i = 1; i < 3; ++i) {
    for (std::size_t k = 0; k < columns; ++k) rows[i * columns + k] = rows[i * stride + k];
  }
  rows.resize(3 * columns);
}

// Fills the columns one step after the other. `take_step(state)` advances the state and returns the status.
template <class TakeStep>
Trajectory run(const Vector3& q0, const Vector3& v0, const Model& model, TakeStep take_step) {
  require_finite(q0, "q0");
  require_finite(v0, "v0");
  const auto columns = static_cast<std::size_t>(model.parameters.columns);
  Trajectory trajectory{model.parameters.columns, std::vector<double>(3 * columns), std::vector<double>(3 * columns)};
  State state{q0, v0};
  for (std::size_t k = 0; k < columns; ++k) {
    for (std::size_t i = 0; i < 3; ++i) trajectory.q[i * columns + k] = state.q[i];
    for (std::size_t i = 0; i < 3; ++i) trajectory.v[i * columns + k] = state.v[i];
    if (k + 1 == columns) break;
    trajectory.status = take_step(state);
    if (trajectory.status != LcpStatus::solved) {
      keep_columns(trajectory.q, columns, k + 1);
      keep_columns(trajectory.v, columns, k + 1);
      trajectory.columns = static_cast<int>(k + 1);
      break;
    }
  }
  return trajectory;
}

}  // namespace

Contacts get_contacts(const Vector3& q, const Parameters& parameters) {
  validate(parameters);
  require_finite(q, "q");
  return find_contact(q, parameters.l).contacts;
}

int corner_index(const Vector3& q, const Parameters& parameters) {
  validate(parameters);
  require_finite(q, "q");
  return find_contact(q, parameters.l).corner;
}

std::array<std::array<double, 2>, 4> corner_positions(const Vector3& q, const Parameters& parameters) {
  validate(parameters);
  require_finite(q, "q");
  std::array<std::array<double, 2>, 4> positions{};
  const std::array<Arm, 4> arms = corner_arms(q[2], parameters.l);
  for (std::size_t k = 0; k < 4; ++k) positions[k] = {q[0] + arms[k].x, q[1] + arms[k].y};
  return positions;
}

Lcp form_lcp(const Jacobian& J, const Vector3& v, const Parameters& parameters) {
  const Model model(parameters);
  require_finite(J.t, "J_t");
  require_finite(J.n, "J_n");
  require_finite(v, "v");
  return form_lcp(J, v, model);
}

Vector3 solve_LCP(const Matrix4& V, const Vector4& p) {
  LcpProblem problem;
  for (const Vector4& row : V) problem.M.insert(problem.M.end(), row.begin(), row.end());
  problem.q.assign(p.begin(), p.end());
  validate(problem);
  if (has_contact_structure({V, p})) {
    const OneContactSolution solution = solve_one_contact(as_one_contact({V, p}));
    const Vector4 z = as_z(solution);
    if (solution.status == LcpStatus::solved) return {z[0], z[1], z[2]};
  }
  LcpResult result = lemke(problem, {.accepted_residual = 1e-10});
  if (result.status != LcpStatus::solved) result = enumerate(problem);
  if (result.status != LcpStatus::solved) {
    throw NoSolution(tumble::format("the LCP has no solution: status {}, all {} complementary bases were tried",
                                    to_string(result.status), result.pivots),
                     result.status);
  }
  return {result.z[0], result.z[1], result.z[2]};
}

RecordedStep step_with_record(const Vector3& q, const Vector3& v, const Parameters& parameters) {
  const Model model(parameters);
  require_finite(q, "q");
  require_finite(v, "v");
  RecordedStep step{{q, v}, {}};
  advance(step.state, step.record, model);
  return step;
}

State step(const Vector3& q, const Vector3& v, const Parameters& parameters) {
  const auto [state, record] = step_with_record(q, v, parameters);
  if (record.status != LcpStatus::solved) {
    throw NoSolution(tumble::format("the step left the range of double arithmetic: LCP status {}, residual {:.3g}",
                                    to_string(record.status), record.residual),
                     record.status);
  }
  return state;
}

// ---- Part 4 ----

Trajectory simulate(const Vector3& q0, const Vector3& v0, const Parameters& parameters) {
  const Model model(parameters);
  // Above this height no corner is within delta, whatever the angle (0.7072 > sqrt(1/2)): the distance need not be
  // known.
  const double clear_height = parameters.delta + 0.7072 * parameters.l;
  return run(q0, v0, model, [&](State& state) {
    if (state.q[1] > clear_height) {
      const bool is_finite = integrate(state, {0.0, -parameters.g, 0.0}, 0.0, parameters.dt);
      return is_finite ? LcpStatus::solved : LcpStatus::numerical;
    }
    StepRecord record;
    advance(state, record, model);
    return record.status;
  });
}

Record simulate_with_record(const Vector3& q0, const Vector3& v0, const Parameters& parameters) {
  const Model model(parameters);
  require_finite(q0, "q0");
  require_finite(v0, "v0");
  if (!has_energy({q0, v0}, parameters)) {
    throw std::invalid_argument(
        tumble::format("q0, v0: the kinetic and the potential energy must be finite, got {} J and {} J",
                       kinetic_energy(v0, parameters), potential_energy(q0, parameters)));
  }
  Record record;
  record.parameters = parameters;
  record.steps.reserve(static_cast<std::size_t>(parameters.columns));
  record.trajectory = run(q0, v0, model, [&](State& state) {
    StepRecord& step = record.steps.emplace_back();
    advance(state, step, model);
    if (!has_energy(state, parameters)) step.status = LcpStatus::numerical;
    return step.status;
  });

  // The last column is not stepped from, but its contact is part of the record; a failed step has left its own.
  if (record.trajectory.status == LcpStatus::solved) {
    const int last = record.trajectory.columns - 1;
    State state{record.trajectory.q_at(last), record.trajectory.v_at(last)};
    advance(state, record.steps.emplace_back(), model);
  }
  return record;
}

double kinetic_energy(const Vector3& v, const Parameters& p) {
  return 0.5 * (p.m * (v[0] * v[0] + v[1] * v[1]) + moment_of_inertia(p) * (v[2] * v[2]));
}

double potential_energy(const Vector3& q, const Parameters& p) { return p.m * p.g * q[1]; }

}  // namespace tumble::drop
