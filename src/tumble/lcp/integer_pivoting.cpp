#include "tumble/lcp/integer_pivoting.hpp"

#include <optional>
#include <utility>

#include "tumble/lcp/integer_dictionary.hpp"

namespace tumble {
namespace {

constexpr int k_max_simplex_pivots = 10'000;

using Dictionary = IntegerDictionary;

// a_i + sum_j a_ij x_j with one more column of 1 for the artificial variable, the last.
Dictionary with_artificial(std::size_t m, std::size_t k, const std::vector<Integer>& entries) {
  std::vector<Integer> wider;
  for (std::size_t i = 0; i < m; ++i) {
    const auto row = entries.begin() + static_cast<std::ptrdiff_t>(i * (k + 1));
    wider.insert(wider.end(), row, row + static_cast<std::ptrdiff_t>(k));
    wider.emplace_back(1);
    wider.push_back(row[static_cast<std::ptrdiff_t>(k)]);
  }
  return {m, k + 1, std::move(wider)};
}

// The row of the most negative value; among equal ones the last. Nothing if all are >= 0.
std::optional<std::size_t> most_negative_row(const Dictionary& dictionary) {
  std::optional<std::size_t> row;
  for (std::size_t i = 0; i < dictionary.num_rows(); ++i) {
    if (dictionary.value(i) < 0 && (!row || dictionary.value(i) <= dictionary.value(*row))) row = i;
  }
  return row;
}

// Compares value(i) / -entry(i, column) with that of another row; both entries are negative.
int compare_ratios(const Dictionary& dictionary, std::size_t column, std::size_t i, std::size_t other) {
  const Integer left = dictionary.value(i) * dictionary.entry(other, column);
  const Integer right = dictionary.value(other) * dictionary.entry(i, column);
  return right.compare(left);  // the factors are negative
}

}  // namespace

// Minimises x0 in  s = A x + a + e x0.
Phase1 find_feasible_point(std::size_t m, std::size_t k, const std::vector<Integer>& entries) {
  Phase1 result;
  Dictionary dictionary = with_artificial(m, k, entries);
  const int x0 = static_cast<int>(m + k);
  const auto finish = [&] {
    result.status = LcpStatus::solved;
    result.x.assign(k, 0);
    for (std::size_t i = 0; i < m; ++i) {
      const int variable = dictionary.basic(i);
      if (variable >= static_cast<int>(m)) result.x[static_cast<std::size_t>(variable) - m] = dictionary.solution(i);
    }
    return result;
  };
  const std::optional<std::size_t> first = most_negative_row(dictionary);
  if (!first) return finish();
  dictionary.pivot(*first, k);
  for (int pivots = 0; pivots < k_max_simplex_pivots; ++pivots) {
    const std::size_t goal = *dictionary.row_of(x0);
    std::optional<std::size_t> column;
    for (std::size_t j = 0; j < dictionary.num_columns(); ++j) {
      if (dictionary.entry(goal, j) >= 0) continue;
      if (!column || dictionary.nonbasic(j) < dictionary.nonbasic(*column)) column = j;
    }
    if (!column) {  // x0 = value + sum of entries >= 0 times variables >= 0
      result.status = LcpStatus::infeasible;
      result.y.assign(m, 0);
      for (std::size_t j = 0; j < dictionary.num_columns(); ++j) {
        const int variable = dictionary.nonbasic(j);
        if (variable < static_cast<int>(m)) {
          result.y[static_cast<std::size_t>(variable)] = Rational(dictionary.entry(goal, j), dictionary.denominator());
        }
      }
      return result;
    }
    std::size_t row = goal;
    for (std::size_t i = 0; i < m; ++i) {
      if (dictionary.entry(i, *column) >= 0) continue;
      const int order = compare_ratios(dictionary, *column, i, row);
      const bool wins_tie = order == 0 && row != goal && dictionary.basic(i) < dictionary.basic(row);
      if (order < 0 || wins_tie || (order == 0 && i == goal)) row = i;
    }
    dictionary.pivot(row, *column);
    if (row == goal) return finish();
  }
  return result;
}

namespace {

// One entry of the perturbation that makes every ratio different: with q_j + epsilon^(j+1) in place of q_j, the value
// of a row is value + sum_j of these times epsilon^(j+1). Times the common denominator.
Integer perturbation(const Dictionary& dictionary, std::size_t row, int w_j) {
  if (dictionary.basic(row) == w_j) return dictionary.denominator();
  const std::optional<std::size_t> column = dictionary.column_of(w_j);
  return column ? Integer(-dictionary.entry(row, *column)) : Integer(0);
}

// True if row i blocks before row `other` in the lexicographic sense, their ratios being equal.
bool is_before(const Dictionary& dictionary, std::size_t column, std::size_t i, std::size_t other) {
  const int n = static_cast<int>(dictionary.num_rows());
  for (int j = 0; j < n; ++j) {
    const Integer left = perturbation(dictionary, i, j) * dictionary.entry(other, column);
    const Integer right = perturbation(dictionary, other, j) * dictionary.entry(i, column);
    if (left != right) return right < left;
  }
  return false;
}

std::optional<std::size_t> blocking_row(const Dictionary& dictionary, std::size_t column, int z0) {
  std::optional<std::size_t> row;
  for (std::size_t i = 0; i < dictionary.num_rows(); ++i) {
    if (dictionary.entry(i, column) >= 0) continue;
    const int order = row ? compare_ratios(dictionary, column, i, *row) : -1;
    if (order < 0) {
      row = i;
    } else if (order == 0 && dictionary.basic(*row) != z0) {
      // z0 wins: once it is 0, the others being >= 0, the problem is solved.
      if (dictionary.basic(i) == z0 || is_before(dictionary, column, i, *row)) row = i;
    }
  }
  return row;
}

// How z changes while the nonbasic variable of `column` grows.
std::vector<Rational> ray(const IntegerLcp& problem, const Dictionary& dictionary, std::size_t column) {
  const int n = static_cast<int>(problem.n);
  std::vector<Rational> direction(problem.n, 0);
  const auto set = [&](int variable, const Integer& rate) {
    if (n <= variable && variable < 2 * n) {
      const auto i = static_cast<std::size_t>(variable - n);
      direction[i] = Rational(rate, dictionary.denominator()) * problem.z_unit[i];
    }
  };
  set(dictionary.nonbasic(column), dictionary.denominator());
  for (std::size_t i = 0; i < problem.n; ++i) set(dictionary.basic(i), dictionary.entry(i, column));
  return in_lowest_terms(std::move(direction));
}

void set_z(const IntegerLcp& problem, const Dictionary& dictionary, RationalResult& result) {
  const int n = static_cast<int>(problem.n);
  result.z.assign(problem.n, 0);
  result.basis.assign(problem.n, 0);
  for (std::size_t row = 0; row < problem.n; ++row) {
    const int variable = dictionary.basic(row);
    if (variable < n || variable >= 2 * n) continue;
    const auto i = static_cast<std::size_t>(variable - n);
    result.basis[i] = 1;
    result.z[i] = dictionary.solution(row) * problem.z_unit[i];
  }
}

}  // namespace

std::vector<Rational> in_units(std::vector<Rational> y, const IntegerLcp& problem) {
  if (y.empty()) return y;
  for (std::size_t i = 0; i < y.size(); ++i) y[i] /= problem.w_unit[i];
  return in_lowest_terms(std::move(y));
}

RationalResult run_lemke(const IntegerLcp& problem) {
  RationalResult result;
  const int n = static_cast<int>(problem.n);
  const int max_pivots = 100 * n + 1000;
  Dictionary dictionary = with_artificial(problem.n, problem.n, problem.entries);
  const int z0 = 2 * n;
  const auto finish = [&](LcpStatus status) {
    result.status = status;
    if (status == LcpStatus::solved) set_z(problem, dictionary, result);
    return result;
  };
  std::optional<std::size_t> row = most_negative_row(dictionary);
  if (!row) return finish(LcpStatus::solved);
  std::size_t column = problem.n;
  for (;;) {
    const int leaving = dictionary.basic(*row);
    dictionary.pivot(*row, column);
    ++result.pivots;
    if (leaving == z0) return finish(LcpStatus::solved);
    if (result.pivots >= max_pivots) return finish(LcpStatus::iteration_limit);
    column = *dictionary.column_of(leaving < n ? leaving + n : leaving - n);
    row = blocking_row(dictionary, column, z0);
    if (row) continue;
    Phase1 phase1 = find_feasible_point(problem.n, problem.n, problem.entries);
    const bool is_infeasible = phase1.status == LcpStatus::infeasible;
    result.certificate = is_infeasible ? in_units(std::move(phase1.y), problem) : ray(problem, dictionary, column);
    return finish(is_infeasible ? LcpStatus::infeasible : LcpStatus::ray_unproven);
  }
}

namespace {

// Finds values for the z that met no partner among the rows of a singular basis, such that nothing is negative, and
// fills result.z. Status: solved, or no_solution_proved for this basis, or iteration_limit.
LcpStatus complete_singular_basis(const IntegerLcp& problem, const Dictionary& dictionary,
                                  const std::vector<std::size_t>& free_columns, RationalResult& result) {
  const int n = static_cast<int>(problem.n);
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < problem.n; ++row) {
    const int variable = dictionary.basic(row);
    if (variable < n && result.basis[static_cast<std::size_t>(variable)]) {
      if (dictionary.value(row) != 0) return LcpStatus::no_solution_proved;  // w_i = 0 cannot be met
    } else {
      rows.push_back(row);
    }
  }
  std::vector<Integer> entries;
  for (const std::size_t row : rows) {
    for (const std::size_t column : free_columns) entries.push_back(dictionary.entry(row, column));
    entries.push_back(dictionary.value(row));
  }
  // value + entries x >= 0, over the common denominator, which only scales the rows.
  const Phase1 phase1 = find_feasible_point(rows.size(), free_columns.size(), entries);
  if (phase1.status != LcpStatus::solved) {
    return phase1.status == LcpStatus::infeasible ? LcpStatus::no_solution_proved : phase1.status;
  }
  result.z.assign(problem.n, 0);
  const auto z_of = [&](int variable) -> Rational& { return result.z[static_cast<std::size_t>(variable - n)]; };
  for (std::size_t k = 0; k < free_columns.size(); ++k) z_of(dictionary.nonbasic(free_columns[k])) = phase1.x[k];
  for (const std::size_t row : rows) {
    if (dictionary.basic(row) < n) continue;
    Rational& z = z_of(dictionary.basic(row)) = dictionary.solution(row);
    for (std::size_t k = 0; k < free_columns.size(); ++k) {
      z += Rational(dictionary.entry(row, free_columns[k]), dictionary.denominator()) * phase1.x[k];
    }
  }
  for (std::size_t i = 0; i < problem.n; ++i) result.z[i] *= problem.z_unit[i];
  return LcpStatus::solved;
}

}  // namespace

RationalResult run_basis(const IntegerLcp& problem, std::span<const std::uint8_t> basis) {
  RationalResult result;
  result.basis.assign(basis.begin(), basis.end());
  const int n = static_cast<int>(problem.n);
  Dictionary dictionary(problem.n, problem.n, problem.entries);
  std::vector<std::size_t> free_columns;
  for (int i = 0; i < n; ++i) {
    if (!basis[static_cast<std::size_t>(i)]) continue;
    const std::size_t column = *dictionary.column_of(n + i);
    const auto is_partner = [&](std::size_t row) {
      const int variable = dictionary.basic(row);
      return variable < n && basis[static_cast<std::size_t>(variable)] && dictionary.entry(row, column) != 0;
    };
    std::size_t row = 0;
    while (row < problem.n && !is_partner(row)) ++row;
    if (row < problem.n) {
      dictionary.pivot(row, column);
      ++result.pivots;
    } else {
      free_columns.push_back(column);
    }
  }
  if (!free_columns.empty()) {
    result.status = complete_singular_basis(problem, dictionary, free_columns, result);
    return result;
  }
  set_z(problem, dictionary, result);
  result.basis.assign(basis.begin(), basis.end());
  result.status = LcpStatus::solved;
  for (std::size_t row = 0; row < problem.n; ++row) {
    if (dictionary.value(row) < 0) result.status = LcpStatus::no_solution_proved;
  }
  return result;
}

}  // namespace tumble
