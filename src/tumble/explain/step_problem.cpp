#include "tumble/explain/step_problem.hpp"

#include <algorithm>
#include <cmath>

#include "tumble/contact/contact_rows.hpp"
#include "tumble/lcp/contact_system.hpp"
#include "tumble/math/format.hpp"

namespace tumble {
namespace {

Vector3 inverse_mass_of(const Body& body) {
  if (body.kind != BodyKind::dynamic) return {};
  return {1.0 / body.mass, 1.0 / body.mass, 1.0 / body.moment_of_inertia};
}

// The rows about the places where the impulses act, along the tangent that was used.
BodyContact rows_of(const ContactRecord& record, std::span<const BodyState> before) {
  const auto centre = [&](int body) { return before[static_cast<std::size_t>(body)].pose.position; };
  const Vector2 centre_a = centre(record.contact.body_a), centre_b = centre(record.contact.body_b), t = record.tangent;
  BodyContact rows = contact_rows(record.contact, {record.place_a, record.place_b}, centre_a, centre_b);
  rows.tangent_a = {-t.x, -t.y, -cross(record.place_a - centre_a, t)};
  rows.tangent_b = {t.x, t.y, cross(record.place_b - centre_b, t)};
  return rows;
}

// [m/s] what the normal velocity after the step must not fall below. Where others bounce, a contact that stays open is
// free: its gap closes in a later step.
double target_of(const ContactRecord& record, double step_size) {
  const double after = record.normal_velocity_after;
  return record.normal_impulse > 0.0 ? after : std::min(after, -(record.contact.gap + record.bend) / step_size);
}

double weighted(const Vector3& a, const Vector3& inverse_mass, const Vector3& b) {
  return a[0] * inverse_mass[0] * b[0] + a[1] * inverse_mass[1] * b[1] + a[2] * inverse_mass[2] * b[2];
}

std::vector<double> w_of(const LcpProblem& problem, const std::vector<double>& z) {
  std::vector<double> w = problem.q;
  for (std::size_t i = 0; i < w.size(); ++i) {
    for (std::size_t j = 0; j < z.size(); ++j) w[i] += problem(i, j) * z[j];
  }
  return w;
}

// The bodies of the contacts, each once, and the velocities they would have without the impulses.
ContactSystem system_of(const Scene& scene, std::span<const BodyState> before, std::span<const BodyState> after,
                        std::span<const ContactRecord> contacts, double step_size) {
  ContactSystem system;
  std::vector<int> place(scene.bodies.size(), -1);
  const auto place_of = [&](int body) {
    int& at = place[static_cast<std::size_t>(body)];
    if (at < 0) {
      at = static_cast<int>(system.velocity.size());
      system.inverse_mass.push_back(inverse_mass_of(scene.bodies[static_cast<std::size_t>(body)]));
      system.velocity.push_back(after[static_cast<std::size_t>(body)].velocity);
    }
    return at;
  };
  for (const ContactRecord& record : contacts) {
    BodyContact rows = rows_of(record, before);
    rows.body_a = place_of(rows.body_a);
    rows.body_b = place_of(rows.body_b);
    rows.friction = record.mode == ContactMode::stick ? record.law.static_friction : record.law.friction;
    system.contacts.push_back(rows);
  }
  // Conveyors, and what the velocities after the step do not tell, are in the offsets.
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto [u_n, u_t] = velocity_at(system.contacts[i], system.velocity);
    system.contacts[i].offset = contacts[i].normal_velocity_after - u_n - target_of(contacts[i], step_size);
    system.contacts[i].tangent_offset = contacts[i].tangential_velocity_after - u_t;
  }
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    for_bodies(system.contacts[i], [&](std::size_t b, const Vector3& normal, const Vector3& tangent) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double impulse = normal[k] * contacts[i].normal_impulse + tangent[k] * contacts[i].friction_impulse;
        system.velocity[b][k] -= system.inverse_mass[b][k] * impulse;
      }
    });
  }
  return system;
}

void name_rows_of_contacts(StepProblem& shown, std::size_t k) {
  const auto add = [&](std::string z, std::string z_unit, std::string w, std::string w_unit) {
    shown.z_names.push_back(std::move(z));
    shown.z_units.push_back(std::move(z_unit));
    shown.w_names.push_back(std::move(w));
    shown.w_units.push_back(std::move(w_unit));
  };
  const auto of = [&](const char* name, std::size_t i) {
    return k == 1 ? std::string(name) : tumble::format("{} {}", name, i + 1);
  };
  for (std::size_t i = 0; i < k; ++i) add(of("P_n", i), "N s", of("u_n - target", i), "m/s");
  for (std::size_t i = 0; i < k; ++i) {
    add(of("P_t+", i), "N s", of("slip + u_t", i), "m/s");
    add(of("P_t-", i), "N s", of("slip - u_t", i), "m/s");
  }
  for (std::size_t i = 0; i < k; ++i) add(of("slip", i), "m/s", of("mu P_n - |P_t|", i), "N s");
}

}  // namespace

StepProblem problem_of_drop(const Vector3& q, const Vector3& v, const drop::Parameters& parameters) {
  const drop::Lcp lcp = form_lcp(drop::get_contacts(q, parameters).J, v, parameters);
  StepProblem shown;
  for (const Vector4& row : lcp.V) shown.problem.M.insert(shown.problem.M.end(), row.begin(), row.end());
  shown.problem.q.assign(lcp.p.begin(), lcp.p.end());
  shown.z_names = {"f_n", "f_t1", "f_t2", "lambda"};
  shown.z_units = {"N", "N", "N", "m/s"};
  shown.w_names = {"u_n' + eps u_n", "lambda - u_t'", "lambda + u_t'", "mu f_n - f_t1 - f_t2"};
  shown.w_units = {"m/s", "m/s", "m/s", "N"};
  const Vector4 z = drop::step_with_record(q, v, parameters).record.z;
  shown.z.assign(z.begin(), z.end());
  shown.w = w_of(shown.problem, shown.z);
  return shown;
}

StepProblem problem_of_contacts(const Scene& scene, std::span<const BodyState> before, std::span<const BodyState> after,
                                std::span<const ContactRecord> contacts, double step_size) {
  StepProblem shown;
  const std::size_t k = contacts.size();
  if (k == 0 || k > k_max_contacts_shown) return shown;
  shown.problem = as_lcp(system_of(scene, before, after, contacts, step_size));
  name_rows_of_contacts(shown, k);
  for (const ContactRecord& record : contacts) shown.z.push_back(record.normal_impulse);
  for (const ContactRecord& record : contacts) {
    shown.z.push_back(std::max(record.friction_impulse, 0.0));
    shown.z.push_back(std::max(-record.friction_impulse, 0.0));
  }
  for (const ContactRecord& record : contacts) shown.z.push_back(std::abs(record.tangential_velocity_after));
  shown.w = w_of(shown.problem, shown.z);
  return shown;
}

ImpulsePlane impulse_plane_of_drop(const Vector3& q, const Vector3& v, const drop::Parameters& parameters) {
  const drop::Parameters& p = parameters;
  const drop::Lcp lcp = form_lcp(drop::get_contacts(q, p).J, v, p);
  const Vector4 z = drop::step_with_record(q, v, p).record.z;
  // p = (J_n . ((1 + eps) v + dt a), -J_t . (v + dt a), ..): its first row is u_n without the force, less the target.
  ImpulsePlane plane{lcp.V[0][0] / p.dt, lcp.V[0][2] / p.dt, lcp.V[1][1] / p.dt};
  plane.u_n_target = -p.eps * dot(drop::get_contacts(q, p).J.n, v);
  plane.u_n = lcp.p[0] + plane.u_n_target;
  plane.u_t = lcp.p[2];
  plane.friction = p.mu;
  plane.P_n = z[0] * p.dt;
  plane.P_t = (z[2] - z[1]) * p.dt;
  return plane;
}

ImpulsePlane impulse_plane(const Scene& scene, std::span<const BodyState> before, const ContactRecord& contact,
                           double step_size) {
  const BodyContact rows = rows_of(contact, before);
  ImpulsePlane plane;
  for_bodies(rows, [&](std::size_t b, const Vector3& normal, const Vector3& tangent) {
    const Vector3 inverse_mass = inverse_mass_of(scene.bodies[b]);
    plane.A_nn += weighted(normal, inverse_mass, normal);
    plane.A_nt += weighted(normal, inverse_mass, tangent);
    plane.A_tt += weighted(tangent, inverse_mass, tangent);
  });
  plane.P_n = contact.normal_impulse;
  plane.P_t = contact.friction_impulse;
  plane.u_n = contact.normal_velocity_after - plane.A_nn * plane.P_n - plane.A_nt * plane.P_t;
  plane.u_t = contact.tangential_velocity_after - plane.A_nt * plane.P_n - plane.A_tt * plane.P_t;
  plane.u_n_target = target_of(contact, step_size);
  plane.friction = contact.mode == ContactMode::stick ? contact.law.static_friction : contact.law.friction;
  return plane;
}

}  // namespace tumble
