#include "tumble/lcp/block_lu.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "random.hpp"
#include <gtest/gtest.h>

#include "tumble/lcp/dense_lu.hpp"

namespace tumble {
namespace {

using problems::Random;
using Index = std::size_t;

// Rows of blocks, all of them; only the diagonal and `pairs` are filled.
struct BlockMatrix {
  int num_rows;
  BlockLu::Pairs pairs;
  std::vector<Matrix3> blocks;

  explicit BlockMatrix(int rows) : num_rows(rows), blocks(static_cast<Index>(rows * rows)) {}
  Matrix3& at(int i, int j) { return blocks[static_cast<Index>(i * num_rows + j)]; }
  const Matrix3& at(int i, int j) const { return blocks[static_cast<Index>(i * num_rows + j)]; }
  double entry(Index i, Index j) const { return at(static_cast<int>(i / 3), static_cast<int>(j / 3))[i % 3][j % 3]; }
};

BlockLu::Pairs random_pairs(Random& random, int num_rows, double share) {
  BlockLu::Pairs pairs;
  for (int i = 0; i < num_rows; ++i) {
    for (int j = i + 1; j < num_rows; ++j) {
      if (random.uniform(0.0, 1.0) < share) pairs.push_back({i, j});
    }
  }
  return pairs;
}

Matrix3 random_block(Random& random, double size) {
  Matrix3 block;
  for (Vector3& row : block) {
    for (double& entry : row) entry = random.uniform(-size, size);
  }
  return block;
}

// Any entries, with the sum of each row on its diagonal: the symmetric part need not be definite, yet no pivot is
// small.
BlockMatrix random_matrix(Random& random, int num_rows, double share) {
  BlockMatrix matrix(num_rows);
  matrix.pairs = random_pairs(random, num_rows, share);
  for (int i = 0; i < num_rows; ++i) matrix.at(i, i) = random_block(random, 1.0);
  for (const auto& [i, j] : matrix.pairs) {
    matrix.at(i, j) = random_block(random, 1.0);
    matrix.at(j, i) = random_block(random, 1.0);
  }
  for (Index i = 0; i < static_cast<Index>(3 * num_rows); ++i) {
    double sum = 0.1;
    for (Index j = 0; j < static_cast<Index>(3 * num_rows); ++j) sum += std::abs(matrix.entry(i, j));
    matrix.at(static_cast<int>(i / 3), static_cast<int>(i / 3))[i % 3][i % 3] = sum;
  }
  return matrix;
}

void fill(BlockLu& lu, const BlockMatrix& matrix) {
  lu.set_pattern(matrix.num_rows, matrix.pairs);
  lu.clear();
  for (int i = 0; i < matrix.num_rows; ++i) lu.diagonal(i) = matrix.at(i, i);
  for (Index p = 0; p < matrix.pairs.size(); ++p) {
    const auto [i, j] = matrix.pairs[p];
    lu.upper(p) = matrix.at(i, j);
    lu.lower(p) = matrix.at(j, i);
  }
}

std::vector<Vector3> random_vector(Random& random, int num_rows) {
  std::vector<Vector3> x(static_cast<Index>(num_rows));
  for (Vector3& row : x) {
    for (double& entry : row) entry = random.uniform(-1.0, 1.0);
  }
  return x;
}

std::vector<Vector3> solve_dense(const BlockMatrix& matrix, const std::vector<Vector3>& b) {
  const auto n = static_cast<Index>(3 * matrix.num_rows);
  DenseLu<long double> lu;
  std::vector<long double>& entries = lu.start(n);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) entries[i * n + j] = matrix.entry(i, j);
  }
  EXPECT_TRUE(lu.factor());
  std::vector<long double> right(n), solution(n);
  for (Index i = 0; i < n; ++i) right[i] = b[i / 3][i % 3];
  lu.solve(right.data(), solution.data());
  std::vector<Vector3> x(b.size());
  for (Index i = 0; i < n; ++i) x[i / 3][i % 3] = static_cast<double>(solution[i]);
  return x;
}

double largest_difference(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
  double largest = 0.0, size = 0.0;
  for (Index i = 0; i < a.size(); ++i) {
    for (Index k = 0; k < 3; ++k) {
      const double difference = std::abs(a[i][k] - b[i][k]);
      if (!std::isfinite(difference)) return difference;
      largest = std::max(largest, difference);
      size = std::max(size, std::abs(b[i][k]));
    }
  }
  return largest / size;
}

// Up to 8 rows keep their order; above, they are reordered, and chains, trees and full patterns fill in differently.
// Elimination of a matrix dominated by its diagonal does not grow; its condition, below 1e4, times round-off is left.
TEST(BlockLu, SolvesAsDenseEliminationDoesOnRandomPatterns) {
  Random random(41);
  BlockLu lu;  // one for all: the pattern changes from matrix to matrix
  for (int trial = 0; trial < 400; ++trial) {
    const int num_rows = 1 + trial % 24;
    const BlockMatrix matrix = random_matrix(random, num_rows, trial % 5 * 0.25);
    fill(lu, matrix);
    ASSERT_TRUE(lu.factor()) << trial;
    for (int k = 0; k < 2; ++k) {  // the factors serve several times
      const std::vector<Vector3> b = random_vector(random, num_rows);
      std::vector<Vector3> x = b;
      lu.solve(x);
      ASSERT_LT(largest_difference(x, solve_dense(matrix, b)), 1e-12) << trial << ": " << num_rows << " rows";
    }
  }
}

TEST(BlockLu, TakesNewNumbersInTheSamePattern) {
  Random random(42);
  BlockMatrix matrix = random_matrix(random, 12, 0.3);
  BlockLu lu, fresh;
  fill(lu, random_matrix(random, 12, 0.3));
  ASSERT_TRUE(lu.factor());
  fill(lu, matrix);
  fill(fresh, matrix);
  ASSERT_TRUE(lu.factor() && fresh.factor());
  std::vector<Vector3> x = random_vector(random, 12), y = x;
  lu.solve(x);
  fresh.solve(y);
  EXPECT_EQ(x, y);
}

// M + C D^-1 J of contacts that stick, as stiff as their ridge is small: only the stiff directions lose digits, and
// what is free moves as if alone.
TEST(BlockLu, KeepsTheFreeDirectionsOfStiffChains) {
  Random random(43);
  for (const double stiffness : {1e2, 1e6, 1e10}) {
    constexpr int num_rows = 10;
    BlockMatrix matrix(num_rows);
    std::vector<Vector3> b(num_rows);
    for (int i = 0; i < num_rows; ++i) {
      for (Index k = 0; k < 3; ++k) matrix.at(i, i)[k][k] = 1.0;
      b[static_cast<Index>(i)] = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    }
    for (int i = 0; i + 1 < num_rows; ++i) {  // springs along y between neighbours
      matrix.pairs.push_back({i, i + 1});
      matrix.at(i, i)[1][1] += stiffness;
      matrix.at(i + 1, i + 1)[1][1] += stiffness;
      matrix.at(i, i + 1)[1][1] = matrix.at(i + 1, i)[1][1] = -stiffness;
    }
    BlockLu lu;
    fill(lu, matrix);
    ASSERT_TRUE(lu.factor());
    std::vector<Vector3> x = b;
    lu.solve(x);
    double sum_before = 0.0, sum = 0.0;
    for (Index i = 0; i < num_rows; ++i) {
      EXPECT_EQ(x[i][0], b[i][0]);
      EXPECT_EQ(x[i][2], b[i][2]);
      sum_before += b[i][1];
      sum += x[i][1];
    }
    // The stiff sum of all is free too: round-off of `stiffness` in the pivots shows in it, no more.
    EXPECT_NEAR(sum, sum_before, 1e-15 * 100.0 * stiffness) << stiffness;
  }
}

// Units that are powers of two change no bit, for rows and for columns.
TEST(BlockLu, HasTheSameBitsInOtherUnits) {
  Random random(44);
  for (int trial = 0; trial < 50; ++trial) {
    const int num_rows = 2 + trial % 14;
    const BlockMatrix matrix = random_matrix(random, num_rows, 0.4);
    const auto n = static_cast<Index>(3 * num_rows);
    std::vector<double> row_unit(n), column_unit(n);
    for (Index i = 0; i < n; ++i) {
      row_unit[i] = std::ldexp(1.0, static_cast<int>(random.uniform(-30.0, 30.0)));
      column_unit[i] = std::ldexp(1.0, static_cast<int>(random.uniform(-30.0, 30.0)));
    }
    BlockMatrix scaled = matrix;
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < n; ++j) {
        scaled.at(static_cast<int>(i / 3), static_cast<int>(j / 3))[i % 3][j % 3] *= row_unit[i] * column_unit[j];
      }
    }
    std::vector<Vector3> x = random_vector(random, num_rows), y = x;
    for (Index i = 0; i < n; ++i) y[i / 3][i % 3] *= row_unit[i];
    BlockLu lu, scaled_lu;
    fill(lu, matrix);
    fill(scaled_lu, scaled);
    ASSERT_TRUE(lu.factor() && scaled_lu.factor());
    lu.solve(x);
    scaled_lu.solve(y);
    for (Index i = 0; i < n; ++i) ASSERT_EQ(x[i / 3][i % 3], y[i / 3][i % 3] * column_unit[i]) << trial;
  }
}

TEST(BlockLu, GivesTheSameSolutionForRowsInAnotherOrder) {
  Random random(45);
  for (int trial = 0; trial < 50; ++trial) {
    const int num_rows = 2 + trial % 19;
    const BlockMatrix matrix = random_matrix(random, num_rows, 0.3);
    std::vector<int> place(static_cast<Index>(num_rows));
    std::iota(place.begin(), place.end(), 0);
    for (Index i = place.size(); i-- > 1;) {
      std::swap(place[i], place[static_cast<Index>(random.uniform(0.0, static_cast<double>(i + 1)))]);
    }
    const auto place_of = [&](int i) { return place[static_cast<Index>(i)]; };
    BlockMatrix moved(num_rows);
    for (int i = 0; i < num_rows; ++i) {
      for (int j = 0; j < num_rows; ++j) moved.at(place_of(i), place_of(j)) = matrix.at(i, j);
    }
    for (const auto& [i, j] : matrix.pairs) {
      moved.pairs.push_back({std::min(place_of(i), place_of(j)), std::max(place_of(i), place_of(j))});
    }
    std::sort(moved.pairs.begin(), moved.pairs.end());
    std::vector<Vector3> x = random_vector(random, num_rows), y(x.size()), back(x.size());
    for (int i = 0; i < num_rows; ++i) y[static_cast<Index>(place_of(i))] = x[static_cast<Index>(i)];
    BlockLu lu, moved_lu;
    fill(lu, matrix);
    fill(moved_lu, moved);
    ASSERT_TRUE(lu.factor() && moved_lu.factor());
    lu.solve(x);
    moved_lu.solve(y);
    for (int i = 0; i < num_rows; ++i) back[static_cast<Index>(i)] = y[static_cast<Index>(place_of(i))];
    ASSERT_LT(largest_difference(back, x), 1e-12) << trial;
  }
}

// Small whole numbers, so that the pivot that is 0 is 0 to the bit.
TEST(BlockLu, SaysThatSingularMatricesAre) {
  const Matrix3 identity = {Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}};
  for (const int num_rows : {1, 2, 9, 20}) {
    BlockMatrix matrix(num_rows);
    for (int i = 0; i < num_rows; ++i) matrix.at(i, i) = identity;
    for (int i = 0; i + 1 < num_rows; ++i) matrix.pairs.push_back({i, i + 1});
    BlockLu lu;
    for (int i = 0; i < num_rows; ++i) {
      for (Index k = 0; k < 3; ++k) {
        BlockMatrix singular = matrix;
        singular.at(i, i)[k][k] = 0.0;
        fill(lu, singular);
        EXPECT_FALSE(lu.factor()) << num_rows << " rows, " << i << " " << k;
        singular.at(i, i)[k][k] = std::numeric_limits<double>::quiet_NaN();
        fill(lu, singular);
        EXPECT_FALSE(lu.factor()) << num_rows << " rows, " << i << " " << k;
      }
    }
    if (num_rows == 1) continue;
    // Two rows of the whole matrix alike: [1 1; 1 1] in the blocks of two neighbours.
    BlockMatrix alike = matrix;
    alike.at(0, 1) = alike.at(1, 0) = identity;
    fill(lu, alike);
    EXPECT_FALSE(lu.factor()) << num_rows;
    // The same blocks are good again after that.
    fill(lu, matrix);
    EXPECT_TRUE(lu.factor()) << num_rows;
  }
  BlockMatrix rank_2(1);
  rank_2.at(0, 0) = {Vector3{1, 2, 3}, Vector3{4, 5, 6}, Vector3{5, 7, 9}};
  BlockLu lu;
  fill(lu, rank_2);
  EXPECT_FALSE(lu.factor());
}

}  // namespace
}  // namespace tumble
