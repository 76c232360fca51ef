// An almost complementary basis of Lemke's method: the list of its variables, LU factors of an earlier list, and the
// exchanges since then. Not a public header.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "tumble/lcp/core_lu.hpp"
#include "tumble/lcp/scaled_problem.hpp"

namespace tumble {

// Variables w = 0 .. n-1, z = n .. 2n-1, z0 = 2n of  w - M z - cover z0 = q.  B has the columns of the n basic ones,
// each in a slot 0 .. n-1. Since the last `factor`, B = B0 E_1 E_2 .. where E_k exchanges one column: the product form
// of the inverse. B0 is solved by the factors of its core, the rows whose w is not basic.
template <class Real>
class LuBasis {
 public:
  // Large sparse cores are factored as such.
  void allow_sparse(std::unique_ptr<SparseLu> (*make)()) { lu_.allow_sparse(make); }

  // A complementary basis; the cover is such that every w_i and z_i in it grows by 1 with z0, or, for a cover number
  // above 0, by a pseudo-random amount in [1, 2).
  void start(const ScaledProblem& problem, double ridge, const std::vector<std::uint8_t>& basis, int cover_number = 0) {
    n_ = static_cast<int>(problem.size());
    const auto n = static_cast<std::size_t>(n_);
    column_begin_.assign(1, 0);
    row_.clear();
    entry_.clear();
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t i = 0; i < n; ++i) {
        const Real entry = i == j ? Real(problem(i, j)) + Real(ridge) : Real(problem(i, j));
        if (entry == Real(0)) continue;
        row_.push_back(static_cast<int>(i));
        entry_.push_back(entry);
      }
      column_begin_.push_back(row_.size());
    }
    q_.assign(problem.q.begin(), problem.q.end());
    slot_of_.assign(2 * n + 1, k_none);
    for (std::size_t i = 0; i < n; ++i) slot_of_[!basis.empty() && basis[i] ? n + i : i] = 0;
    cover_.assign(n, Real(0));
    for (std::size_t i = 0; i < n; ++i) {
      const Real growth = growth_in_cover(i, cover_number);
      if (is_basic(static_cast<int>(i))) cover_[i] += growth;
      if (!is_basic(static_cast<int>(n + i))) continue;
      for (std::size_t e = column_begin_[i]; e < column_begin_[i + 1]; ++e) cover_[row_[e]] -= entry_[e] * growth;
    }
  }

  // Another constant than the problem's in row i.
  void set_constant(int i, const Real& q_i) { q_[i] = q_i; }

  // Another cover: z0 adds to w_i alone.
  void set_cover_to_row(int i) {
    cover_.assign(cover_.size(), Real(0));
    cover_[i] = Real(1);
  }

  static constexpr int k_none = -1;
  int z0() const { return 2 * n_; }
  int complement_of(int variable) const { return variable < n_ ? variable + n_ : variable - n_; }
  bool is_basic(int variable) const { return slot_of_[variable] != k_none; }
  int variable(int slot) const { return variable_[slot]; }
  int num_exchanges() const { return static_cast<int>(etas_.size()); }

  // Factors the basis as it is now; the slots are dealt out anew. False if it is singular.
  bool factor() {
    etas_.clear();
    eta_entries_.clear();
    core_rows_.clear();
    core_columns_.clear();
    variable_.assign(n_, k_none);
    core_row_of_.assign(n_, k_none);
    for (int i = 0; i < n_; ++i) {
      if (is_basic(i)) {
        place(i, i);
      } else {
        core_row_of_[i] = static_cast<int>(core_rows_.size());
        core_rows_.push_back(i);
      }
    }
    std::size_t num_entries = is_basic(z0()) ? core_rows_.size() : 0;
    for (int variable = n_; variable <= z0(); ++variable) {
      if (!is_basic(variable)) continue;
      if (core_columns_.size() == core_rows_.size()) return false;
      place(variable, core_rows_[core_columns_.size()]);
      core_columns_.push_back(variable);
      if (variable < z0()) num_entries += column_begin_[variable - n_ + 1] - column_begin_[variable - n_];
    }
    if (core_columns_.size() != core_rows_.size()) return false;
    lu_.start(core_rows_.size(), num_entries);
    for (std::size_t j = 0; j < core_columns_.size(); ++j) {
      for_column(core_columns_[j], [&](int row, const Real& entry) {
        if (core_row_of_[row] != k_none) lu_.add(static_cast<std::size_t>(core_row_of_[row]), j, entry);
      });
    }
    return lu_.factor();
  }

  // x = B^-1 q, slot by slot. Refined once, which makes the error of each row as small as its own terms allow, however
  // the rows are scaled. [Skeel 1980]
  void values(std::vector<Real>& x) {
    solve(q_, x);
    multiply(x);
    right_.resize(n_);
    for (int i = 0; i < n_; ++i) right_[i] = q_[i] - sum_[i];
    solve(right_, correction_);
    for (int i = 0; i < n_; ++i) x[i] += correction_[i];
  }

  // y = B^-1 a for the column a of a nonbasic variable: basic ones change by -y while it grows by 1. Returns the
  // largest residual of B y = a, relative to the terms of its row.
  Real direction(int entering, std::vector<Real>& y) {
    right_.assign(n_, Real(0));
    for_column(entering, [&](int row, const Real& entry) { right_[row] = entry; });
    solve(right_, y);
    return residual(right_, y);
  }

  // z of the values x of the slots.
  void z_part(const std::vector<Real>& x, std::vector<double>& z) const {
    z.assign(n_, 0.0);
    for (int slot = 0; slot < static_cast<int>(x.size()); ++slot) {
      const int variable = variable_[slot];
      if (variable >= n_ && variable < z0()) z[variable - n_] = static_cast<double>(x[slot]);
    }
  }

  // How z changes while `entering`, whose direction is y, grows by 1.
  void z_direction(int entering, const std::vector<Real>& y, std::vector<double>& z) const {
    z_part(y, z);
    for (double& z_i : z) z_i = -z_i;
    if (entering >= n_ && entering < z0()) z[entering - n_] = 1.0;
  }

  // Makes `entering` basic in the slot; y is its `direction`. Costs n operations in each solve to come.
  void exchange(int entering, int slot, const std::vector<Real>& y) {
    slot_of_[variable_[slot]] = k_none;
    place(entering, slot);
    etas_.push_back({slot, eta_entries_.size()});
    eta_entries_.insert(eta_entries_.end(), y.begin(), y.end());
  }

 private:
  static Real growth_in_cover(std::size_t i, int cover_number) {
    if (cover_number == 0) return Real(1);
    std::uint64_t x = (i + 1) * 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(cover_number) * 0xd1b54a32d192ed03u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;  // SplitMix64
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return Real(1.0 + static_cast<double>(x >> 44) * 0x1p-20);
  }

  struct Eta {
    int slot;
    std::size_t begin;  // of its n entries
  };

  void place(int variable, int slot) {
    variable_[slot] = variable;
    slot_of_[variable] = slot;
  }

  // Calls visit(row, entry) for the entries of a variable's column.
  template <class Visit>
  void for_column(int variable, Visit visit) const {
    if (variable < n_) {
      visit(variable, Real(1));
    } else if (variable == z0()) {
      for (int i = 0; i < n_; ++i) visit(i, Real(-cover_[i]));
    } else {
      const auto j = static_cast<std::size_t>(variable - n_);
      for (std::size_t e = column_begin_[j]; e < column_begin_[j + 1]; ++e) visit(row_[e], Real(-entry_[e]));
    }
  }

  // y = B^-1 a.
  void solve(const std::vector<Real>& a, std::vector<Real>& y) {
    core_right_.clear();
    for (const int row : core_rows_) core_right_.push_back(a[row]);
    core_solution_.resize(core_right_.size());
    lu_.solve(core_right_.data(), core_solution_.data());
    y = a;
    for (std::size_t j = 0; j < core_columns_.size(); ++j) {
      const Real& value = core_solution_[j];
      if (value == Real(0)) continue;
      for_column(core_columns_[j], [&](int row, const Real& entry) { y[row] -= entry * value; });
    }
    for (std::size_t j = 0; j < core_rows_.size(); ++j) y[core_rows_[j]] = core_solution_[j];
    for (const Eta& eta : etas_) {
      const Real* column = eta_entries_.data() + eta.begin;
      if (y[eta.slot] == Real(0)) continue;
      const Real value = y[eta.slot] / column[eta.slot];
      for (int i = 0; i < n_; ++i) y[i] -= value * column[i];
      y[eta.slot] = value;
    }
  }

  // B y, into sum_, and the sizes of its terms, into size_.
  void multiply(const std::vector<Real>& y) {
    using std::abs;
    sum_.assign(n_, Real(0));
    size_.assign(n_, Real(0));
    for (int slot = 0; slot < n_; ++slot) {
      if (y[slot] == Real(0)) continue;
      for_column(variable_[slot], [&](int row, const Real& entry) {
        const Real term = entry * y[slot];
        sum_[row] += term;
        size_[row] += abs(term);
      });
    }
  }

  Real residual(const std::vector<Real>& a, const std::vector<Real>& y) {
    using std::abs;
    multiply(y);
    Real largest(0);
    Real largest_size(0);
    for (int i = 0; i < n_; ++i) largest_size = size_[i] > largest_size ? size_[i] : largest_size;
    for (int i = 0; i < n_; ++i) {
      const Real error = abs(sum_[i] - a[i]);
      largest = error > largest ? error : largest;
    }
    return largest_size > Real(0) ? Real(largest / largest_size) : Real(0);
  }

  int n_ = 0;
  std::vector<std::size_t> column_begin_;  // M column by column, entries other than 0
  std::vector<int> row_;
  std::vector<Real> entry_, q_, cover_;
  std::vector<int> slot_of_;   // of each variable; k_none if it is not basic
  std::vector<int> variable_;  // of each slot
  std::vector<int> core_rows_, core_columns_, core_row_of_;
  CoreLu<Real> lu_;
  std::vector<Eta> etas_;
  std::vector<Real> eta_entries_;
  std::vector<Real> right_, core_right_, core_solution_, sum_, size_, correction_;
};

}  // namespace tumble
