#include "tumble/lcp/enumerate.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include <Eigen/LU>
#include <Eigen/QR>
#include <fmt/format.h>

#include "tumble/lcp/equilibrate.hpp"
#include "tumble/lcp/require.hpp"
#include "tumble/lcp/residual.hpp"

namespace tumble {
namespace {

using Index = Eigen::Index;

constexpr double k_rank_tolerance = 1e-11;  // pivots of an equilibrated matrix below this count as 0
constexpr double k_clear_failure = 1e-6;    // a basis that fails by less does not prove anything

std::vector<Index> members(unsigned set) {
  std::vector<Index> indices;
  for (; set != 0; set &= set - 1) indices.push_back(std::countr_zero(set));
  return indices;
}

class Enumeration {
 public:
  Enumeration(const LcpProblem& problem, const EnumerateSettings& settings)
      : problem_(problem), accepted_residual_(settings.accepted_residual), scales_(equilibrate(problem)) {
    const auto n = static_cast<Index>(problem.size());
    M_.resize(n, n);
    q_.resize(n);
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < n; ++j) M_(i, j) = std::ldexp(problem(i, j), scales_.row[i] + scales_.column[j]);
      q_[i] = std::ldexp(problem.q[i], scales_.row[i]);
    }
  }

  std::vector<LcpResult> run() {
    const unsigned num_bases = 1u << problem_.size();
    for (unsigned basis = 0; basis < num_bases; ++basis) {
      ++num_tried_;
      try_basis(basis);
    }
    for (LcpResult& solution : solutions_) solution.pivots = num_tried_;
    return std::move(solutions_);
  }

  // True if every basis that is not a solution failed clearly.
  bool is_clear() const { return is_clear_; }

 private:
  // z = 0 outside `basis`, w = 0 on it.
  void try_basis(unsigned basis) {
    if (basis == 0) return keep_if_solution(basis, Eigen::VectorXd(0));
    const std::vector<Index> columns = members(basis);
    const Eigen::MatrixXd M_BB = M_(columns, columns);
    const Eigen::VectorXd right = -q_(columns);
    Eigen::FullPivLU<Eigen::MatrixXd> lu(M_BB);
    lu.setThreshold(k_rank_tolerance);
    const Eigen::VectorXd z_B = lu.solve(right);
    if (lu.isInvertible()) {
      if (lu.rcond() < k_rank_tolerance) is_clear_ = false;
      return keep_if_solution(basis, z_B);
    }
    const double size = right.cwiseAbs().maxCoeff() + z_B.cwiseAbs().maxCoeff();
    const double inconsistency = size > 0.0 ? (M_BB * z_B - right).cwiseAbs().maxCoeff() / size : 0.0;
    if (inconsistency > 1e-9) return note_failure(inconsistency);
    complete_singular_basis(basis, columns, columns.size() - static_cast<std::size_t>(lu.rank()));
  }

  // A vertex with a singular M_BB has `num_missing` more rows with w = 0 outside the basis: tries all choices.
  void complete_singular_basis(unsigned basis, const std::vector<Index>& columns, std::size_t num_missing) {
    const unsigned all = (1u << problem_.size()) - 1u;
    const unsigned outside = all & ~basis;
    for (unsigned extra = outside; extra != 0; extra = (extra - 1u) & outside) {
      if (static_cast<std::size_t>(std::popcount(extra)) != num_missing) continue;
      const std::vector<Index> rows = members(basis | extra);
      Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(M_(rows, columns));
      qr.setThreshold(k_rank_tolerance);
      if (qr.rank() == static_cast<Index>(columns.size())) keep_if_solution(basis, qr.solve(-q_(rows)));
    }
  }

  void keep_if_solution(unsigned basis, const Eigen::VectorXd& z_B) {
    const std::size_t n = problem_.size();
    LcpResult candidate;
    candidate.z.assign(n, 0.0);
    candidate.basis.assign(n, 0);
    const std::vector<Index> columns = members(basis);
    const double largest = columns.empty() ? 0.0 : z_B.cwiseAbs().maxCoeff();
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const double z_k = z_B[static_cast<Index>(k)];
      if (!(z_k >= -accepted_residual_ * largest)) return note_failure(-z_k / largest);
      candidate.z[columns[k]] = std::ldexp(std::max(z_k, 0.0), scales_.column[columns[k]]);
      candidate.basis[columns[k]] = 1;
    }
    candidate.rung = LcpRung::enumerate;
    candidate.parts = residual(problem_, candidate.z);
    candidate.residual = candidate.parts.largest();
    if (!(candidate.residual <= accepted_residual_)) return note_failure(candidate.residual);
    if (std::any_of(solutions_.begin(), solutions_.end(),
                    [&](const LcpResult& known) { return is_same(known.z, candidate.z); })) {
      return;
    }
    candidate.w = complement(problem_, candidate.z);
    candidate.status = LcpStatus::solved;
    solutions_.push_back(std::move(candidate));
  }

  // By how much a basis missed, relative to the sizes involved; not finite if numbers left the range of double.
  void note_failure(double violation) {
    if (!(violation > k_clear_failure && std::isfinite(violation))) is_clear_ = false;
  }

  // Equal in equilibrated units up to a tolerance well above the error of a small linear solve.
  bool is_same(const std::vector<double>& a, const std::vector<double>& b) const {
    double difference = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      difference = std::max(difference, std::ldexp(std::abs(a[i] - b[i]), -scales_.column[i]));
      size = std::max(size, std::ldexp(std::abs(a[i]) + std::abs(b[i]), -scales_.column[i]));
    }
    return difference <= 1e-8 * size;
  }

  const LcpProblem& problem_;
  double accepted_residual_;
  Equilibration scales_;
  Eigen::MatrixXd M_;  // equilibrated
  Eigen::VectorXd q_;
  std::vector<LcpResult> solutions_;
  int num_tried_ = 0;
  bool is_clear_ = true;
};

void check(const LcpProblem& problem, const EnumerateSettings& settings) {
  validate(problem);
  if (problem.size() > k_max_enumerate_size) {
    throw std::invalid_argument(fmt::format("q: enumeration takes at most {} entries (it tries 2^n bases), got {}",
                                            k_max_enumerate_size, problem.size()));
  }
  validate(settings);
}

}  // namespace

void validate(const EnumerateSettings& settings) { require_accepted_residual(settings.accepted_residual); }

std::vector<LcpResult> enumerate_solutions(const LcpProblem& problem, const EnumerateSettings& settings) {
  check(problem, settings);
  return Enumeration(problem, settings).run();
}

LcpResult enumerate(const LcpProblem& problem, const EnumerateSettings& settings) {
  check(problem, settings);
  Enumeration enumeration(problem, settings);
  std::vector<LcpResult> solutions = enumeration.run();
  if (!solutions.empty()) return std::move(solutions.front());
  LcpResult none;
  none.status = enumeration.is_clear() ? LcpStatus::no_solution_proved : LcpStatus::numerical;
  none.z.assign(problem.size(), 0.0);
  none.w = complement(problem, none.z);
  none.parts = residual(problem, none.z);
  none.residual = none.parts.largest();
  none.rung = LcpRung::enumerate;
  none.basis.assign(problem.size(), 0);
  none.pivots = 1 << problem.size();
  return none;
}

}  // namespace tumble
