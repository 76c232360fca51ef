#include "tumble/lcp/integer_dictionary.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tumble {
namespace {

std::optional<std::size_t> place_of(int variable, const std::vector<int>& list) {
  const auto found = std::find(list.begin(), list.end(), variable);
  if (found == list.end()) return std::nullopt;
  return static_cast<std::size_t>(found - list.begin());
}

}  // namespace

IntegerDictionary::IntegerDictionary(std::size_t m, std::size_t k, std::vector<Integer> entries)
    : basic_(m), nonbasic_(k), entries_(std::move(entries)) {
  std::iota(basic_.begin(), basic_.end(), 0);
  std::iota(nonbasic_.begin(), nonbasic_.end(), static_cast<int>(m));
}

std::optional<std::size_t> IntegerDictionary::row_of(int variable) const { return place_of(variable, basic_); }
std::optional<std::size_t> IntegerDictionary::column_of(int variable) const { return place_of(variable, nonbasic_); }

// Solving row r for the entering x_s, with p = |a_rs| and sigma = sign a_rs:
//   p x_s = sigma (D x_r - sum_{j != s} a_rj x_j),     p x_i = sum_{j != s} (p a_ij - sigma a_is a_rj) / D x_j
//                                                              + sigma a_is x_r.
void IntegerDictionary::pivot(std::size_t row, std::size_t column) {
  Integer* pivot_row = entries_.data() + row * stride();
  const bool is_negative = pivot_row[column] < 0;
  // sigma a_rj; its entry in the pivot column is p.
  if (is_negative) {
    for (std::size_t j = 0; j < stride(); ++j) pivot_row[j].backend().negate();
  }
  const Integer p = pivot_row[column];
  Integer product;
  for (std::size_t i = 0; i < num_rows(); ++i) {
    if (i == row) continue;
    Integer* to = entries_.data() + i * stride();
    const Integer factor = to[column];
    for (std::size_t j = 0; j < stride(); ++j) {
      if (j == column) continue;
      to[j] *= p;
      if (factor != 0 && pivot_row[j] != 0) {
        boost::multiprecision::multiply(product, factor, pivot_row[j]);
        to[j] -= product;
      }
      if (denominator_ != 1 && to[j] != 0) to[j] /= denominator_;
    }
    if (is_negative) to[column].backend().negate();
  }
  for (std::size_t j = 0; j < stride(); ++j) pivot_row[j].backend().negate();
  pivot_row[column] = is_negative ? Integer(-denominator_) : denominator_;
  denominator_ = p;
  std::swap(basic_[row], nonbasic_[column]);
}

}  // namespace tumble
