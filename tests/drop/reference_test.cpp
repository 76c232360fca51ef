// Part 4: trajectories, against those of an independent implementation that tries every basis of each LCP.
// TUMBLE_VECTORS is the folder they are in: index.csv and one file per trajectory.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tumble/batch/simulate_batch.hpp"
#include "tumble/drop/drop.hpp"

namespace tumble::drop {
namespace {

struct Reference {
  std::string name;
  Parameters parameters;
  std::vector<std::vector<double>> rows;  // k, x, y, theta, vx, vy, omega, phi, f_n, f_t1, f_t2, lambda

  State state(std::size_t k) const {
    return {{rows[k][1], rows[k][2], rows[k][3]}, {rows[k][4], rows[k][5], rows[k][6]}};
  }
};

std::vector<std::vector<std::string>> read_cells(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<std::vector<std::string>> lines;
  std::string line;
  std::getline(file, line);  // names of the columns
  while (std::getline(file, line)) {
    std::istringstream stream(line);
    std::vector<std::string> cells;
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    lines.push_back(cells);
  }
  return lines;
}

std::vector<Reference> references() {
  std::vector<Reference> all;
  const std::filesystem::path folder = TUMBLE_VECTORS;
  for (const auto& cells : read_cells(folder / "index.csv")) {
    const auto value = [&](std::size_t i) { return std::stod(cells[i]); };
    Reference reference{cells[0], {value(1), value(2), value(3), value(4), value(5), value(6), value(7), 150}, {}};
    for (const auto& row : read_cells(folder / (cells[0] + ".csv"))) {
      std::vector<double>& numbers = reference.rows.emplace_back();
      for (const std::string& cell : row) numbers.push_back(std::stod(cell));
    }
    all.push_back(reference);
  }
  return all;
}

double distance(const State& a, const State& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    largest = std::max({largest, std::abs(a.q[i] - b.q[i]), std::abs(a.v[i] - b.v[i])});
  }
  return largest;
}

TEST(ReferenceTrajectories, AreReproducedStepByStep) {
  for (const Reference& reference : references()) {
    ASSERT_EQ(reference.rows.size(), 150u) << reference.name;
    for (std::size_t k = 0; k < 150; ++k) {
      const State state = reference.state(k);
      const auto [next, record] = step_with_record(state.q, state.v, reference.parameters);
      EXPECT_NEAR(record.gap, reference.rows[k][7], 1e-15) << reference.name << " " << k;
      const double f_n = reference.rows[k][8];
      EXPECT_NEAR(record.z[0], f_n, 1e-12 * (1 + f_n)) << reference.name << " " << k;
      EXPECT_NEAR(record.z[2] - record.z[1], reference.rows[k][10] - reference.rows[k][9], 1e-12 * (1 + f_n));
      EXPECT_NEAR(record.z[3], reference.rows[k][11], 1e-13) << reference.name << " " << k;
      if (k + 1 < 150) {
        EXPECT_LT(distance(next, reference.state(k + 1)), 1e-13) << reference.name << " " << k;
      }
    }
  }
}

// How much a whole trajectory may differ: 1e-12, or what round-off in its first contacts grows to. Two of the reference
// trajectories multiply a disturbance of one part in 1e15 more than a thousandfold; in 50-digit arithmetic the
// references themselves are off by up to 1.0e-12.
TEST(ReferenceTrajectories, AreReproducedAsAWhole) {
  for (const Reference& reference : references()) {
    const State start = reference.state(0);
    const Trajectory trajectory = simulate(start.q, start.v, reference.parameters);
    double growth = 0.0;
    for (const double disturbance : {1e-10, -1e-10}) {
      const Vector3 v0 = {start.v[0], start.v[1], start.v[2] + disturbance};
      const Trajectory disturbed = simulate(start.q, v0, reference.parameters);
      growth = std::max(
          growth,
          distance({trajectory.q_at(149), trajectory.v_at(149)}, {disturbed.q_at(149), disturbed.v_at(149)}) / 1e-10);
    }
    const double tolerance = std::max(1e-12, 8e-15 * growth);  // 8e-15: one step's difference, see above
    double largest = 0.0;
    for (int k = 0; k < 150; ++k) {
      largest = std::max(
          largest, distance({trajectory.q_at(k), trajectory.v_at(k)}, reference.state(static_cast<std::size_t>(k))));
    }
    EXPECT_LE(largest, tolerance) << reference.name << ", growth " << growth;
  }
}

// All columns of all reference trajectories at once, each with its own parameters, one step further.
TEST(ReferenceTrajectories, AreReproducedStepByStepInOneBatch) {
  const std::vector<Reference> all = references();
  std::vector<double> q0, v0;
  std::array<std::vector<double>, 7> values;  // l m mu eps dt delta g
  for (const Reference& reference : all) {
    const Parameters& p = reference.parameters;
    for (std::size_t k = 0; k + 1 < 150; ++k) {
      const State state = reference.state(k);
      q0.insert(q0.end(), state.q.begin(), state.q.end());
      v0.insert(v0.end(), state.v.begin(), state.v.end());
      const std::array<double, 7> numbers = {p.l, p.m, p.mu, p.eps, p.dt, p.delta, p.g};
      for (std::size_t i = 0; i < 7; ++i) values[i].push_back(numbers[i]);
    }
  }
  std::vector<double> q(q0.size()), v(v0.size());
  batch::simulate_batch<double>(
      {q0, v0}, {values[0], values[1], values[2], values[3], values[4], values[5], values[6], 2}, {}, {q, v});
  std::size_t i = 0;
  for (const Reference& reference : all) {
    for (std::size_t k = 0; k + 1 < 150; ++k, i += 3) {
      const State next{{q[i], q[i + 1], q[i + 2]}, {v[i], v[i + 1], v[i + 2]}};
      EXPECT_LT(distance(next, reference.state(k + 1)), 1e-13) << reference.name << " " << k;
    }
  }
}

}  // namespace
}  // namespace tumble::drop
