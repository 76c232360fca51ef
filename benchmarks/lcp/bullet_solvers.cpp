// Bullet's Lemke in the double precision build: libbullet-dev.
#include "solver.hpp"

#ifndef TUMBLE_HAS_BULLET

std::vector<tumble::bench::Solver> tumble::bench::bullet_solvers() { return {}; }

#else

#include <memory>

#include <BulletDynamics/MLCPSolvers/btLemkeAlgorithm.h>

namespace tumble::bench {
namespace {

struct State {
  btMatrixXu M;
  btVectorXu q;
  std::vector<double> z;
  int info = -1;

  void run() {
    btLemkeAlgorithm lemke(M, q);
    const btVectorXu solution = lemke.solve(1000);  // steps; what btLemkeSolver takes
    info = lemke.getInfo();
    // w, then z.
    for (std::size_t i = 0; i < z.size(); ++i) z[i] = solution[static_cast<int>(z.size() + i)];
  }
};

std::optional<Attempt> prepare(const Case& c) {
  const int n = static_cast<int>(c.problem.size());
  auto state = std::make_shared<State>();
  state->M.resize(n, n);
  state->q.resize(n);
  state->z.resize(c.problem.size());
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      state->M.setElem(i, j, c.problem(static_cast<std::size_t>(i), static_cast<std::size_t>(j)));
    }
    state->q[i] = c.problem.q[static_cast<std::size_t>(i)];
  }
  return Attempt{[=] { state->run(); }, [=] { return Answer{state->info == 0, state->z}; }};
}

}  // namespace

std::vector<Solver> bullet_solvers() { return {{"Bullet Lemke", prepare}}; }

}  // namespace tumble::bench

#endif
