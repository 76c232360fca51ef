#include "tumble/lcp/sparse_lu.hpp"

#include <vector>

#ifdef __EMSCRIPTEN__
// Eigen writes a number into a message through a stream, which would bring all locales into the browser's module.
#include <Eigen/Core>

namespace std {
struct tumble_no_stream {
  template <class Value>
  void operator<<(const Value&) {}
  string str() const { return {}; }
};
}  // namespace std
#define ostringstream tumble_no_stream
#endif
#include <Eigen/SparseLU>
#undef ostringstream

namespace tumble {

struct SparseLu::Parts {
  std::vector<Eigen::Triplet<double>> triplets;
  Eigen::SparseMatrix<double> matrix;
  Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> lu;
};

SparseLu::SparseLu() : parts_(std::make_unique<Parts>()) {}
SparseLu::~SparseLu() = default;
SparseLu::SparseLu(SparseLu&&) noexcept = default;
SparseLu& SparseLu::operator=(SparseLu&&) noexcept = default;

void SparseLu::start() { parts_->triplets.clear(); }

void SparseLu::add(std::size_t row, std::size_t column, double value) {
  parts_->triplets.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
}

bool SparseLu::factor(std::size_t k) {
  const auto size = static_cast<Eigen::Index>(k);
  parts_->matrix.resize(size, size);
  parts_->matrix.setFromTriplets(parts_->triplets.begin(), parts_->triplets.end());
  parts_->lu.compute(parts_->matrix);
  return parts_->lu.info() == Eigen::Success;
}

void SparseLu::solve(const double* b, double* x) const {
  const Eigen::Index size = parts_->matrix.rows();
  Eigen::Map<Eigen::VectorXd>(x, size) = parts_->lu.solve(Eigen::Map<const Eigen::VectorXd>(b, size));
}

}  // namespace tumble
