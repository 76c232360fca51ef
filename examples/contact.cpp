// One step in contact by hand (get_contacts, form_lcp, solve_LCP), then by `step`. Twin: contact.py.
#include <cstddef>
#include <cstdio>

#include "tumble/drop/drop.hpp"

int main() {
  using namespace tumble;
  const drop::Parameters p;
  const Vector3 q = {0.0, 0.13, 0.5};
  const Vector3 v = {1.0, -2.0, 0.0};

  const auto [J, phi] = drop::get_contacts(q, p);
  const auto [V, b] = drop::form_lcp(J, v, p);
  const auto [f_n, f_t1, f_t2] = drop::solve_LCP(V, b);
  std::printf("phi = %.6f m, f_n = %.6f N, f_t1 = %.6f N, f_t2 = %.6f N\n", phi, f_n, f_t1, f_t2);

  const Vector3 mass = {p.m, p.m, p.m * p.l * p.l / 6};
  const Vector3 f_e = {0.0, -p.m * p.g, 0.0};
  Vector3 q_next = q;
  Vector3 v_next = v;
  for (std::size_t i = 0; i < 3; ++i) {
    v_next[i] += p.dt / mass[i] * (f_e[i] + J.n[i] * f_n - J.t[i] * f_t1 + J.t[i] * f_t2);
    q_next[i] += p.dt * v_next[i];
  }
  q_next[1] += p.delta;
  std::printf("by hand: q = (%.6f, %.6f, %.6f)\n", q_next[0], q_next[1], q_next[2]);
  const drop::State state = drop::step(q, v, p);
  std::printf("by step: q = (%.6f, %.6f, %.6f)\n", state.q[0], state.q[1], state.q[2]);
}
