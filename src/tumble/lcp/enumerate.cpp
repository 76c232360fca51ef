#include "tumble/lcp/enumerate.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "tumble/lcp/contact_structure.hpp"
#include "tumble/lcp/equilibrate.hpp"
#include "tumble/lcp/integer_lcp.hpp"
#include "tumble/lcp/judge.hpp"
#include "tumble/lcp/require.hpp"
#include "tumble/lcp/small_elimination.hpp"
#include "tumble/math/format.hpp"

namespace tumble {
namespace {

constexpr double k_rank_tolerance = 1e-11;      // pivots of a scaled matrix below this count as 0
constexpr double k_clear_rank = 1e-9;           // a rank decided by smaller pivots, or none, does not prove anything
constexpr double k_clear_inconsistency = 1e-9;  // a singular system off by more has no solution
constexpr double k_clear_failure = 1e-6;        // a basis that fails by less does not prove anything

using Elimination = SmallElimination<k_max_enumerate_size>;
using Vector = std::array<double, k_max_enumerate_size>;

struct Members {
  std::array<std::size_t, k_max_enumerate_size> at;
  std::size_t count = 0;

  explicit Members(unsigned set) {
    for (; set != 0; set &= set - 1) at[count++] = static_cast<std::size_t>(std::countr_zero(set));
  }
  const std::size_t* begin() const { return at.data(); }
  const std::size_t* end() const { return at.data() + count; }
};

double largest_magnitude(const Vector& values, std::size_t count) {
  double largest = 0.0;
  for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, std::abs(values[i]));
  return largest;
}

// Exponents of two for rows and columns, each free, that bring the entries other than 0 near 1 on average: the least
// squares of their logarithms [Curtis & Reid 1972], by alternating means. A basis, unlike a pivot rule, knows nothing
// of the ratio of w_i and z_i, so that rows and columns scaled apart in any way can be brought back.
void balance(const LcpProblem& problem, std::vector<int>& row, std::vector<int>& column) {
  const std::size_t n = problem.size();
  constexpr int num_rounds = 8;  // one round is enough for a full matrix, a few for a sparse one
  std::array<Vector, k_max_enumerate_size> exponent;
  Vector of_row{}, of_column{};
  Vector row_count{}, column_count{};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      int e = 0;
      std::frexp(problem(i, j), &e);
      exponent[i][j] = e + row[i] + column[j];
      row_count[i] += problem(i, j) != 0.0;
      column_count[j] += problem(i, j) != 0.0;
    }
  }
  for (int round = 0; round < num_rounds; ++round) {
    for (std::size_t i = 0; i < n; ++i) {
      double sum = 0.0;
      for (std::size_t j = 0; j < n; ++j) sum += problem(i, j) != 0.0 ? exponent[i][j] + of_column[j] : 0.0;
      if (row_count[i] > 0.0) of_row[i] = -sum / row_count[i];
    }
    for (std::size_t j = 0; j < n; ++j) {
      double sum = 0.0;
      for (std::size_t i = 0; i < n; ++i) sum += problem(i, j) != 0.0 ? exponent[i][j] + of_row[i] : 0.0;
      if (column_count[j] > 0.0) of_column[j] = -sum / column_count[j];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    row[i] += static_cast<int>(std::lround(of_row[i]));
    column[i] += static_cast<int>(std::lround(of_column[i]));
  }
}

class Enumeration {
 public:
  Enumeration(const LcpProblem& problem, const EnumerateSettings& settings, bool wants_rays)
      : problem_(problem), n_(problem.size()), accepted_residual_(settings.accepted_residual), wants_rays_(wants_rays) {
    ContactStructure contacts;
    if (find_row_sizes(problem, contacts, scales_, row_sizes_)) equilibrate(problem, scales_);
    balance(problem, scales_.row, scales_.column);
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = 0; j < n_; ++j) M_[i][j] = std::ldexp(problem(i, j), scales_.row[i] + scales_.column[j]);
      q_[i] = std::ldexp(problem.q[i], scales_.row[i]);
    }
    // Without sizes of its own, a row has those of the scales here, which undo more than those of `residual`.
    std::vector<double> sizes = row_sizes_.round_off;
    if (row_sizes_.is_guess) {
      std::vector<double> of_q;
      row_sizes_of_q(problem, scales_, of_q);
      share_for_round_off(of_q, sizes);
    }
    for (std::size_t i = 0; i < n_; ++i) row_floor_[i] = std::ldexp(sizes[i], scales_.row[i]);
  }

  void run() {
    const unsigned num_bases = 1u << n_;
    for (unsigned basis = 0; basis < num_bases; ++basis) try_basis(basis);
    if (solutions_.empty() && !is_clear_) settle_exactly();
    for (LcpResult& solution : solutions_) solution.pivots = static_cast<int>(num_bases);
  }

  // True if there is a proof that what is not in the list is no solution.
  bool is_clear() const { return is_clear_; }
  std::vector<LcpResult>& solutions() { return solutions_; }

  // Rays and faces of the solutions found.
  void find_faces(SolutionSet& set) {
    std::vector<Support> of_vertices, of_rays;
    for (const LcpResult& vertex : solutions_) of_vertices.push_back(support(vertex));
    for (const Ray& ray : rays_) of_rays.push_back(ray.support);
    set.faces = solution_faces(n_, of_vertices, of_rays);
    // Rays from which no vertex starts belong to M z >= 0 only.
    std::vector<std::size_t> new_index(rays_.size(), rays_.size());
    for (SolutionFace& face : set.faces) {
      for (std::size_t& ray : face.rays) {
        if (new_index[ray] == rays_.size()) {
          new_index[ray] = set.rays.size();
          set.rays.push_back(direction(rays_[ray]));
        }
        ray = new_index[ray];
      }
    }
  }

 private:
  struct Ray {
    Vector z{};  // scaled, the largest entry 1
    Support support;
  };

  // Rows `rows` of M z = -q in the unknowns `columns`.
  Elimination system(const Members& rows, const Members& columns) const {
    Elimination elimination(rows.count, columns.count);
    for (std::size_t i = 0; i < rows.count; ++i) {
      for (std::size_t j = 0; j < columns.count; ++j) elimination.at(i, j) = M_[rows.at[i]][columns.at[j]];
      elimination.right(i) = -q_[rows.at[i]];
    }
    elimination.run(k_rank_tolerance);
    return elimination;
  }

  // z = 0 outside `basis`, w = 0 on it.
  void try_basis(unsigned basis) {
    const Members columns(basis);
    const Elimination elimination = system(columns, columns);
    if (elimination.rank() < columns.count || elimination.pivot_ratio() < k_clear_rank) is_clear_ = false;
    Vector z_B;
    elimination.solve(z_B.data());
    if (elimination.rank() == columns.count) return keep_if_solution(basis, columns, z_B);
    const std::size_t num_missing = columns.count - elimination.rank();
    if (wants_rays_) try_rays(basis, columns, num_missing - 1);
    double size = largest_magnitude(z_B, columns.count);
    for (const std::size_t i : columns) size = std::max(size, std::abs(q_[i]));
    const double inconsistency = size > 0.0 ? elimination.inconsistency() / size : 0.0;
    if (inconsistency > k_clear_inconsistency) return note_failure(inconsistency);
    for_each_choice(basis, num_missing, [&](const Members& rows) {
      const Elimination completed = system(rows, columns);
      if (completed.rank() != columns.count) return;
      completed.solve(z_B.data());
      keep_if_solution(basis, columns, z_B);
    });
  }

  // A vertex with a singular M_BB has `num_extra` more rows with w = 0 outside the basis: calls `visit` with the rows
  // of the basis and each choice of those.
  template <class Visit>
  void for_each_choice(unsigned basis, std::size_t num_extra, Visit visit) const {
    const unsigned outside = ((1u << n_) - 1u) & ~basis;
    if (num_extra == 0) return visit(Members(basis));
    for (unsigned extra = outside; extra != 0; extra = (extra - 1u) & outside) {
      if (static_cast<std::size_t>(std::popcount(extra)) == num_extra) visit(Members(basis | extra));
    }
  }

  // Extreme directions with z > 0 on the basis, w = 0 there, w >= 0 elsewhere.
  void try_rays(unsigned basis, const Members& columns, std::size_t num_extra) {
    for_each_choice(basis, num_extra, [&](const Members& rows) {
      const Elimination elimination = system(rows, columns);
      if (elimination.rank() + 1 != columns.count) return;
      Vector z_B;
      elimination.null_vector(z_B.data());
      keep_if_ray(columns, z_B);
    });
  }

  void keep_if_ray(const Members& columns, Vector z_B) {
    const std::size_t k = columns.count;
    double largest = *std::max_element(z_B.begin(), z_B.begin() + k);
    const double smallest = *std::min_element(z_B.begin(), z_B.begin() + k);
    if (-smallest > largest) largest = smallest;
    Ray ray;
    for (std::size_t j = 0; j < k; ++j) {
      const double z_j = z_B[j] / largest;
      if (!(z_j > accepted_residual_)) return;  // z_j = 0 belongs to a smaller basis
      ray.z[columns.at[j]] = z_j;
    }
    for (std::size_t i = 0; i < n_; ++i) {
      double w = 0.0, size = 0.0;
      for (const std::size_t j : columns) {
        w += M_[i][j] * ray.z[j];
        size += std::abs(M_[i][j] * ray.z[j]);
      }
      if (w < -accepted_residual_ * size) return;
      if (w > accepted_residual_ * size) ray.support.w |= 1u << i;
    }
    for (const std::size_t j : columns) ray.support.z |= 1u << j;
    if ((ray.support.z & ray.support.w) != 0) return;
    const bool is_known = std::any_of(rays_.begin(), rays_.end(), [&](const Ray& known) {
      return known.support.z == ray.support.z && is_same(known.z, ray.z);
    });
    if (!is_known) rays_.push_back(ray);
  }

  std::vector<double> direction(const Ray& ray) const {
    std::vector<double> z(n_);
    for (std::size_t i = 0; i < n_; ++i) z[i] = std::ldexp(ray.z[i], scales_.column[i]);
    const double largest = *std::max_element(z.begin(), z.end());
    for (double& z_i : z) z_i /= largest;
    return z;
  }

  void keep_if_solution(unsigned basis, const Members& columns, const Vector& z_B) {
    Vector z{};
    const double largest = largest_magnitude(z_B, columns.count);
    for (std::size_t k = 0; k < columns.count; ++k) {
      if (!(z_B[k] >= -accepted_residual_ * largest)) return note_failure(-z_B[k] / largest);
      z[columns.at[k]] = std::max(z_B[k], 0.0);
    }
    const double violation = scaled_violation(columns, z);
    if (!(violation <= accepted_residual_)) return note_failure(violation);
    const bool is_known = std::any_of(scaled_solutions_.begin(), scaled_solutions_.end(),
                                      [&](const Vector& known) { return is_same(known, z); });
    if (is_known) return;
    LcpResult candidate;
    candidate.z.resize(n_);
    for (std::size_t i = 0; i < n_; ++i) candidate.z[i] = std::ldexp(z[i], scales_.column[i]);
    if (keep(std::move(candidate), basis, LcpRung::enumerate)) scaled_solutions_.push_back(z);
  }

  // Judges a candidate against the input. False if it is none after all.
  bool keep(LcpResult&& candidate, unsigned basis, LcpRung rung) {
    candidate.parts = judge(problem_, row_sizes_, candidate.z, candidate.w, judge_buffers_);
    candidate.residual = candidate.parts.largest();
    if (!(candidate.residual <= accepted_residual_)) {
      note_failure(candidate.residual);
      return false;
    }
    candidate.basis.resize(n_);
    for (std::size_t i = 0; i < n_; ++i) candidate.basis[i] = basis >> i & 1;
    candidate.rung = rung;
    candidate.status = LcpStatus::solved;
    solutions_.push_back(std::move(candidate));
    return true;
  }

  // w_i / d_i and z_i / s_i of residual.hpp, in scaled numbers and with the row sizes of these scales.
  struct Relative {
    Vector w, z;
  };

  Relative relative(const Members& columns, const Vector& z) const {
    Relative result;
    Vector d;
    for (std::size_t i = 0; i < n_; ++i) {
      double sum = 0.0, size = 0.0;
      for (const std::size_t j : columns) {
        const double term = M_[i][j] * z[j];
        sum += term;
        size += std::abs(term);
      }
      d[i] = row_floor_[i] + std::abs(q_[i]) + size;
      result.w[i] = d[i] > 0.0 ? (sum + q_[i]) / d[i] : 0.0;
      result.z[i] = 0.0;
    }
    for (const std::size_t j : columns) {
      for (std::size_t i = 0; i < n_; ++i) {
        if (d[i] > 0.0) result.z[j] = std::max(result.z[j], std::abs(M_[i][j]) * z[j] / d[i]);
      }
    }
    return result;
  }

  // The residual of z >= 0.
  double scaled_violation(const Members& columns, const Vector& z) const {
    const Relative sizes = relative(columns, z);
    double violation = 0.0;
    for (std::size_t i = 0; i < n_; ++i) {
      if (!(-sizes.w[i] <= violation)) violation = -sizes.w[i];
    }
    for (const std::size_t j : columns) violation = std::max(violation, std::min(sizes.w[j], sizes.z[j]));
    return violation;
  }

  // By how much a basis missed, relative to the sizes involved; not finite if numbers left the range of double.
  void note_failure(double violation) {
    if (!(violation > k_clear_failure && std::isfinite(violation))) is_clear_ = false;
  }

  // Equal in scaled units up to a tolerance well above the error of a small linear solve.
  bool is_same(const Vector& a, const Vector& b) const {
    double difference = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < n_; ++i) {
      difference = std::max(difference, std::abs(a[i] - b[i]));
      size = std::max(size, std::abs(a[i]) + std::abs(b[i]));
    }
    return difference <= 1e-8 * size;
  }

  // Where z and w of a solution are not 0.
  Support support(const LcpResult& solution) const {
    Vector z;
    for (std::size_t i = 0; i < n_; ++i) z[i] = std::ldexp(solution.z[i], -scales_.column[i]);
    const Relative sizes = relative(Members((1u << n_) - 1u), z);
    Support result;
    for (std::size_t i = 0; i < n_; ++i) {
      if (sizes.w[i] > accepted_residual_) result.w |= 1u << i;
      if (sizes.z[i] > accepted_residual_) result.z |= 1u << i;
    }
    return result;
  }

  // No basis is a solution, but some came too close to tell: exact arithmetic tells, within its limits.
  void settle_exactly() {
    const IntegerLcp integers = integers_of(rationals_of(problem_));
    if (integers.n * integers.num_bits > k_max_exact_bits) return;
    const RationalSolutionSet set = rational_solution_set(integers);
    is_clear_ = set.is_complete && set.z.empty();
    for (std::size_t v = 0; v < set.z.size(); ++v) {
      LcpResult candidate;
      candidate.z = nearest_doubles(set.z[v]);
      keep(std::move(candidate), set.bases[v], LcpRung::exact);
    }
  }

  const LcpProblem& problem_;
  std::size_t n_;
  double accepted_residual_;
  bool wants_rays_;
  Equilibration scales_;
  std::array<Vector, k_max_enumerate_size> M_;  // scaled
  Vector q_, row_floor_;
  RowSizes row_sizes_;  // of `residual`
  JudgeBuffers judge_buffers_;
  std::vector<Vector> scaled_solutions_;
  std::vector<LcpResult> solutions_;
  std::vector<Ray> rays_;
  bool is_clear_ = true;
};

void check(const LcpProblem& problem, const EnumerateSettings& settings) {
  validate(problem);
  if (problem.size() > k_max_enumerate_size) {
    throw std::invalid_argument(tumble::format("q: enumeration takes at most {} entries (it tries 2^n bases), got {}",
                                               k_max_enumerate_size, problem.size()));
  }
  validate(settings);
}

LcpStatus status_of(Enumeration& enumeration) {
  if (!enumeration.solutions().empty()) return LcpStatus::solved;
  return enumeration.is_clear() ? LcpStatus::no_solution_proved : LcpStatus::numerical;
}

}  // namespace

void validate(const EnumerateSettings& settings) { require_accepted_residual(settings.accepted_residual); }

std::vector<LcpResult> enumerate_solutions(const LcpProblem& problem, const EnumerateSettings& settings) {
  check(problem, settings);
  Enumeration enumeration(problem, settings, false);
  enumeration.run();
  return std::move(enumeration.solutions());
}

LcpResult enumerate(const LcpProblem& problem, const EnumerateSettings& settings) {
  check(problem, settings);
  Enumeration enumeration(problem, settings, false);
  enumeration.run();
  if (!enumeration.solutions().empty()) return std::move(enumeration.solutions().front());
  LcpResult none;
  none.status = status_of(enumeration);
  none.z.assign(problem.size(), 0.0);
  none.w = complement(problem, none.z);
  none.parts = residual(problem, none.z);
  none.residual = none.parts.largest();
  none.rung = LcpRung::enumerate;
  none.basis.assign(problem.size(), 0);
  none.pivots = 1 << problem.size();
  return none;
}

SolutionSet solution_set(const LcpProblem& problem, const EnumerateSettings& settings) {
  check(problem, settings);
  Enumeration enumeration(problem, settings, true);
  enumeration.run();
  SolutionSet set;
  set.status = status_of(enumeration);
  enumeration.find_faces(set);
  set.vertices = std::move(enumeration.solutions());
  return set;
}

}  // namespace tumble
