// DART's Lemke: libdart-dev.
#include "solver.hpp"

#ifndef TUMBLE_HAS_DART

std::vector<tumble::bench::Solver> tumble::bench::dart_solvers() { return {}; }

#else

#include <memory>

#include <dart/lcpsolver/Lemke.hpp>

namespace tumble::bench {
namespace {

struct State {
  Eigen::MatrixXd M;
  Eigen::VectorXd q;
  Eigen::VectorXd z;
  int error = -1;
};

std::optional<Attempt> prepare(const Case& c) {
  const auto n = static_cast<Eigen::Index>(c.problem.size());
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  auto state = std::make_shared<State>();
  state->M = Eigen::Map<const RowMajor>(c.problem.M.data(), n, n);
  state->q = Eigen::Map<const Eigen::VectorXd>(c.problem.q.data(), n);
  state->z = Eigen::VectorXd::Zero(n);
  return Attempt{[=] {
                   state->z.setZero();
                   state->error = dart::lcpsolver::Lemke(state->M, state->q, &state->z);
                 },
                 [=] {
                   return Answer{state->error == 0, {state->z.data(), static_cast<std::size_t>(state->z.size())}};
                 }};
}

}  // namespace

std::vector<Solver> dart_solvers() { return {{"DART Lemke", prepare}}; }

}  // namespace tumble::bench

#endif
