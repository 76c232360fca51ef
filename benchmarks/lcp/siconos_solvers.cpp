// Siconos numerics: libsiconos-numerics-dev.
#include "solver.hpp"

#ifndef TUMBLE_HAS_SICONOS

std::vector<tumble::bench::Solver> tumble::bench::siconos_solvers() { return {}; }

#else

#include <algorithm>
#include <memory>

#include "local_contacts.hpp"
#include <numerics/FrictionContactProblem.h>
#include <numerics/Friction_cst.h>
#include <numerics/LinearComplementarityProblem.h>
#include <numerics/NonSmoothDrivers.h>
#include <numerics/NumericsMatrix.h>
#include <numerics/SolverOptions.h>
#include <numerics/lcp_cst.h>

namespace tumble::bench {
namespace {

using Index = std::size_t;

struct OptionsDeleter {
  void operator()(SolverOptions* options) const { solver_options_delete(options); }
};
using Options = std::unique_ptr<SolverOptions, OptionsDeleter>;

struct MatrixDeleter {
  void operator()(NumericsMatrix* matrix) const { NM_free_not_dense(matrix); }
};
using Matrix = std::unique_ptr<NumericsMatrix, MatrixDeleter>;

// A dense matrix over memory of ours, column after column.
Matrix dense(std::vector<double>& values, Index n) {
  return Matrix(NM_create_from_data(NM_DENSE, static_cast<int>(n), static_cast<int>(n), values.data()));
}

struct LcpState {
  explicit LcpState(const LcpProblem& p, int solver) : options(solver_options_create(solver)) {
    const Index n = p.size();
    for (Index j = 0; j < n; ++j) {
      for (Index i = 0; i < n; ++i) M.push_back(p(i, j));
    }
    q = p.q;
    z.resize(n);
    w.resize(n);
    matrix = dense(M, n);
    problem = {static_cast<int>(n), matrix.get(), q.data()};
  }

  void run() {
    std::fill(z.begin(), z.end(), 0.0);
    std::fill(w.begin(), w.end(), 0.0);
    info = linearComplementarity_driver(&problem, z.data(), w.data(), options.get());
  }

  std::vector<double> M, q, z, w;
  Matrix matrix;
  LinearComplementarityProblem problem{};
  Options options;
  int info = -1;
};

Solver lcp_solver(const std::string& name, int id) {
  return {name, [=](const Case& c) -> std::optional<Attempt> {
            auto state = std::make_shared<LcpState>(c.problem, id);
            return Attempt{[=] { state->run(); }, [=] { return Answer{state->info == 0, state->z}; }};
          }};
}

// The contact problem itself.
struct ContactState {
  ContactState(const LcpProblem& p, double tolerance)
      : contacts(problems::local_contacts(p)), options(solver_options_create(SICONOS_FRICTION_2D_NSGS)) {
    const Index k = contacts.friction.size();
    impulse.resize(2 * k);
    velocity.resize(2 * k);
    matrix = dense(contacts.W, 2 * k);
    problem.dimension = 2;
    problem.numberOfContacts = static_cast<int>(k);
    problem.M = matrix.get();
    problem.q = contacts.q.data();
    problem.mu = contacts.friction.data();
    options->dparam[SICONOS_DPARAM_TOL] = tolerance;
  }
  void run() {
    std::fill(impulse.begin(), impulse.end(), 0.0);
    std::fill(velocity.begin(), velocity.end(), 0.0);
    info = fc2d_driver(&problem, impulse.data(), velocity.data(), options.get());
  }

  Answer answer() {
    z = problems::lcp_solution(contacts, impulse);
    return {info == 0, z};
  }

  problems::LocalContacts contacts;
  std::vector<double> impulse, velocity, z;
  Matrix matrix;
  FrictionContactProblem problem{};
  Options options;
  int info = -1;
};

std::optional<Attempt> prepare_nsgs(const Case& c) {
  if (!c.contacts) return std::nullopt;
  auto state = std::make_shared<ContactState>(c.problem, 1e-10);
  return Attempt{[=] { state->run(); }, [=] { return state->answer(); }};
}

}  // namespace

std::vector<Solver> siconos_solvers() {
  return {lcp_solver("Siconos lexicolemke", SICONOS_LCP_LEMKE),
          lcp_solver("Siconos lcp_pivot", SICONOS_LCP_PIVOT),
          {"Siconos fc2d_nsgs, 1e-10", prepare_nsgs}};
}

}  // namespace tumble::bench

#endif
