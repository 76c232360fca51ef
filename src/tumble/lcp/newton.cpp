#include "tumble/lcp/newton.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tumble/lcp/require.hpp"
#include "tumble/lcp/rung.hpp"
#include "tumble/lcp/solve.hpp"

namespace tumble {
namespace {

using Vector = std::vector<double>;

double dot(const Vector& a, const Vector& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// sqrt(a^2 + b^2) - a - b, without cancellation where both are > 0.
double fischer_burmeister(double a, double b) {
  const double radius = std::sqrt(a * a + b * b);
  return a + b > 0.0 ? -2.0 * a * b / (radius + a + b) : radius - a - b;
}

class Search {
 public:
  Search(const LcpProblem& problem, LcpWorkspace& workspace)
      : problem_(problem), workspace_(workspace), buffers_(workspace.buffers()), at_(buffers_.newton) {
    at_.z.assign(problem.size(), 0.0);
    merit_ = evaluate(at_.z, at_.w, at_.phi);
  }

  LcpStatus run(const NewtonSettings& settings) {
    LcpResult& result = workspace_.result;
    for (;; ++result.pivots) {
      choose_basis();
      offer(at_.z);
      if (result.residual <= settings.accepted_residual) return LcpStatus::solved;
      if (result.pivots == settings.max_iterations) return LcpStatus::iteration_limit;
      find_gradient();
      bool has_moved = false;
      ++result.refactorisations;
      if (solve_basis(buffers_.basis, buffers_, k_singular)) {
        offer(buffers_.z_scaled);
        if (result.residual <= settings.accepted_residual) {
          ++result.pivots;
          return LcpStatus::solved;
        }
        for (std::size_t i = 0; i < at_.step.size(); ++i) at_.step[i] = buffers_.z_scaled[i] - at_.z[i];
        has_moved = move(k_newton_halvings);
      }
      if (!has_moved && !(find_regularised_step() && move(k_all_halvings))) return LcpStatus::numerical;
    }
  }

 private:
  static constexpr int k_newton_halvings = 10;  // a Newton step that must be cut shorter leads nowhere
  static constexpr int k_all_halvings = 50;

  // w = M z + q, phi, and the merit function.
  double evaluate(const Vector& z, Vector& w, Vector& phi) const {
    const ScaledProblem& scaled = buffers_.scaled;
    const std::size_t n = scaled.size();
    w.resize(n);
    phi.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      double sum = scaled.q[i];
      for (std::size_t j = 0; j < n; ++j) sum += scaled(i, j) * z[j];
      w[i] = sum;
      phi[i] = fischer_burmeister(z[i], sum);
    }
    return 0.5 * dot(phi, phi);
  }

  void choose_basis() {
    buffers_.basis.resize(at_.z.size());
    at_.step.resize(at_.z.size());
    for (std::size_t i = 0; i < at_.z.size(); ++i) buffers_.basis[i] = at_.w[i] < at_.z[i];
  }

  // Lets a candidate be judged, in scaled numbers.
  void offer(const Vector& z_scaled) {
    LcpResult& result = workspace_.result;
    const double before = result.residual;
    unscale(buffers_.scaled, z_scaled, buffers_.z);
    judge_candidate(problem_, workspace_);
    if (result.residual < before) result.basis = buffers_.basis;
  }

  // J of phi, row by row: share of e_i, and share of row i of M. At z_i = w_i = 0 any direction serves.
  void find_gradient() {
    const ScaledProblem& scaled = buffers_.scaled;
    const std::size_t n = scaled.size();
    at_.jacobian.resize(n * n);
    at_.gradient.assign(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      const double radius = std::sqrt(at_.z[i] * at_.z[i] + at_.w[i] * at_.w[i]);
      const double z_share = (radius > 0.0 ? at_.z[i] / radius : std::sqrt(0.5)) - 1.0;
      const double w_share = (radius > 0.0 ? at_.w[i] / radius : std::sqrt(0.5)) - 1.0;
      double* row = at_.jacobian.data() + i * n;
      for (std::size_t j = 0; j < n; ++j) row[j] = w_share * scaled(i, j);
      row[i] += z_share;
      for (std::size_t j = 0; j < n; ++j) at_.gradient[j] += row[j] * at_.phi[i];
    }
  }

  // The step of Levenberg and Marquardt; the closer to a solution, the less it is held back.
  bool find_regularised_step() {
    const std::size_t n = problem_.size();
    ++workspace_.result.refactorisations;
    Vector& entries = buffers_.lu.start(n);
    std::fill(entries.begin(), entries.end(), 0.0);
    for (std::size_t k = 0; k < n; ++k) {
      const double* row = at_.jacobian.data() + k * n;
      for (std::size_t i = 0; i < n; ++i) {
        if (row[i] == 0.0) continue;
        for (std::size_t j = 0; j < n; ++j) entries[i * n + j] += row[i] * row[j];
      }
    }
    // Large far away, so that a singular Jacobian leads downhill, and small near the solution, so that steps are
    // Newton's.
    const double nu = std::min(1e-2, std::sqrt(merit_));
    buffers_.right.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      entries[i * n + i] += nu;
      buffers_.right[i] = -at_.gradient[i];
    }
    if (!buffers_.lu.factor()) return false;
    buffers_.lu.solve(buffers_.right.data(), at_.step.data());
    return true;
  }

  // Armijo's rule along the step. False if the step does not lead downhill, or not far enough.
  bool move(int max_halvings) {
    constexpr double smallest_cosine = 1e-8, share = 1e-4;
    const double slope = dot(at_.gradient, at_.step);
    const double sizes = std::sqrt(dot(at_.gradient, at_.gradient) * dot(at_.step, at_.step));
    if (!(slope < -smallest_cosine * sizes)) return false;
    at_.next.resize(at_.z.size());
    double length = 1.0;
    for (int halvings = 0; halvings <= max_halvings; ++halvings, length *= 0.5) {
      for (std::size_t i = 0; i < at_.z.size(); ++i) at_.next[i] = at_.z[i] + length * at_.step[i];
      const double next_merit = evaluate(at_.next, at_.next_w, at_.next_phi);
      if (!(next_merit <= merit_ + share * length * slope)) continue;
      std::swap(at_.z, at_.next);
      std::swap(at_.w, at_.next_w);
      std::swap(at_.phi, at_.next_phi);
      merit_ = next_merit;
      return true;
    }
    return false;
  }

  const LcpProblem& problem_;
  LcpWorkspace& workspace_;
  LcpWorkspace::Buffers& buffers_;
  NewtonBuffers& at_;
  double merit_ = 0.0;
};

}  // namespace

void validate(const NewtonSettings& settings) {
  require(settings.max_iterations >= 1, "max_iterations", ">= 1", settings.max_iterations);
  require_accepted_residual(settings.accepted_residual);
}

void run_newton(const LcpProblem& problem, const NewtonSettings& settings, LcpWorkspace& workspace) {
  workspace.result.rung = LcpRung::newton;
  workspace.result.status = Search(problem, workspace).run(settings);
}

LcpResult newton(const LcpProblem& problem, const NewtonSettings& settings) { return solve_lcp(problem, settings); }

}  // namespace tumble
