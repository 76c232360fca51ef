#include "tumble/lcp/sparse_lu.hpp"

#include <vector>

#include <Eigen/SparseLU>

namespace tumble {
namespace {

class EigenSparseLu : public SparseLu {
 public:
  void start() override { triplets_.clear(); }

  void add(std::size_t row, std::size_t column, double value) override {
    triplets_.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
  }

  bool factor(std::size_t k) override {
    const auto size = static_cast<Eigen::Index>(k);
    matrix_.resize(size, size);
    matrix_.setFromTriplets(triplets_.begin(), triplets_.end());
    lu_.compute(matrix_);
    return lu_.info() == Eigen::Success;
  }

  void solve(const double* b, double* x) const override {
    const Eigen::Index size = matrix_.rows();
    Eigen::Map<Eigen::VectorXd>(x, size) = lu_.solve(Eigen::Map<const Eigen::VectorXd>(b, size));
  }

 private:
  std::vector<Eigen::Triplet<double>> triplets_;
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> lu_;
};

}  // namespace

std::unique_ptr<SparseLu> make_sparse_lu() { return std::make_unique<EigenSparseLu>(); }

}  // namespace tumble
