#include "fclib_file.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

extern "C" {
#include <fclib.h>
}

namespace tumble::problems {
namespace {

using Index = std::size_t;

// u = W r + q, normal and tangent of each contact in turn.
struct LocalProblem {
  std::vector<double> W;  // 2 k x 2 k, row after row
  std::vector<double> q;  // 2 k
  std::vector<double> friction;
};

// Row of the LCP that holds row i of W.
Index lcp_row(Index i, Index num_contacts) { return i % 2 == 0 ? i / 2 : num_contacts + 2 * (i / 2); }

LcpProblem as_lcp(const LocalProblem& local) {
  const Index k = local.friction.size(), n = 4 * k;
  LcpProblem problem{std::vector<double>(n * n), std::vector<double>(n), std::vector<double>(n)};
  const auto entry = [&](Index i, Index j) -> double& { return problem.M[i * n + j]; };
  double speed = 0.0;
  for (Index i = 0; i < 2 * k; ++i) {
    const Index row = lcp_row(i, k);
    problem.q[row] = local.q[i];
    speed = std::max(speed, std::abs(local.q[i]));
    if (i % 2 == 1) problem.q[row + 1] = local.q[i] == 0.0 ? 0.0 : -local.q[i];
    for (Index j = 0; j < 2 * k; ++j) {
      const double value = local.W[i * 2 * k + j];
      if (value == 0.0) continue;
      const Index column = lcp_row(j, k);
      entry(row, column) = value;
      if (j % 2 == 1) entry(row, column + 1) = -value;
      if (i % 2 == 1) entry(row + 1, column) = -value;
      if (i % 2 == 1 && j % 2 == 1) entry(row + 1, column + 1) = value;
    }
  }
  for (Index i = 0; i < k; ++i) {
    const Index plus = k + 2 * i, cone = 3 * k + i;
    entry(plus, cone) = entry(plus + 1, cone) = 1.0;
    entry(cone, i) = local.friction[i];
    entry(cone, plus) = entry(cone, plus + 1) = -1.0;
    const double nn = entry(i, i);
    problem.row_sizes[i] = problem.row_sizes[plus] = problem.row_sizes[plus + 1] = speed;
    problem.row_sizes[cone] = nn > 0.0 ? speed / nn : 0.0;
  }
  return problem;
}

LocalProblem as_local(const LcpProblem& problem) {
  validate(problem);
  const Index k = problem.size() / 4;
  LocalProblem local;
  if (4 * k == problem.size()) {
    for (Index i = 0; i < 2 * k; ++i) {
      for (Index j = 0; j < 2 * k; ++j) local.W.push_back(problem(lcp_row(i, k), lcp_row(j, k)));
      local.q.push_back(problem.q[lcp_row(i, k)]);
    }
    for (Index i = 0; i < k; ++i) local.friction.push_back(problem(3 * k + i, i));
    const LcpProblem again = as_lcp(local);
    if (again.M == problem.M && again.q == problem.q) return local;
  }
  throw std::invalid_argument("M, q: must be the LCP of planar contacts, ordered (c, b+ and b-, s)");
}

// The matrix in compressed columns, in memory of ours.
struct Compressed {
  explicit Compressed(const LocalProblem& local) {
    const Index n = local.q.size();
    for (Index j = 0; j < n; ++j) {
      start.push_back(static_cast<int>(value.size()));
      for (Index i = 0; i < n; ++i) {
        if (local.W[i * n + j] == 0.0) continue;
        row.push_back(static_cast<int>(i));
        value.push_back(local.W[i * n + j]);
      }
    }
    const int count = static_cast<int>(value.size()), size = static_cast<int>(n);
    start.push_back(count);
    matrix = {count, size, size, start.data(), row.data(), value.data(), -1, nullptr};
  }
  std::vector<int> start, row;
  std::vector<double> value;
  fclib_matrix matrix{};
};

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw std::runtime_error(fmt::format("{}: {}", path.string(), why));
}

// The entries of any of fclib's three forms, those of one place added up.
std::vector<double> dense(const fclib_matrix& matrix, const std::filesystem::path& path) {
  const int n = matrix.n;
  std::vector<double> entries(static_cast<Index>(n) * static_cast<Index>(n));
  const auto add = [&](int i, int j, double value) {
    if (i < 0 || i >= n || j < 0 || j >= n) refuse(path, fmt::format("W has an entry outside its {} rows", n));
    entries[static_cast<Index>(i) * static_cast<Index>(n) + static_cast<Index>(j)] += value;
  };
  if (matrix.nz >= 0) {
    for (int e = 0; e < std::min(matrix.nz, matrix.nzmax); ++e) add(matrix.p[e], matrix.i[e], matrix.x[e]);
    return entries;
  }
  for (int major = 0; major < n; ++major) {
    for (int e = std::max(matrix.p[major], 0); e < std::min(matrix.p[major + 1], matrix.nzmax); ++e) {
      if (matrix.nz == -1) {
        add(matrix.i[e], major, matrix.x[e]);
      } else {
        add(major, matrix.i[e], matrix.x[e]);
      }
    }
  }
  return entries;
}

struct Deleter {
  void operator()(fclib_local* problem) const {
    fclib_delete_local(problem);
    std::free(problem);
  }
};

}  // namespace

void write_fclib(const std::filesystem::path& path, const LcpProblem& problem) {
  LocalProblem local = as_local(problem);
  Compressed W(local);
  std::string title = "planar contacts", description = "u = W r + q, normal before tangent", none;
  fclib_info info{title.data(), description.data(), none.data()};
  fclib_local file{};
  file.W = &W.matrix;
  file.mu = local.friction.data();
  file.q = local.q.data();
  file.spacedim = 2;
  file.info = &info;
  // fclib adds to a file that exists.
  std::filesystem::path part = path;
  part += ".part";
  std::filesystem::remove(part);
  if (fclib_write_local(&file, part.c_str()) != 1) refuse(path, "cannot be written");
  std::filesystem::rename(part, path);
}

LcpProblem read_fclib(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) refuse(path, "is no file");
  const std::unique_ptr<fclib_local, Deleter> file(fclib_read_local(path.c_str()));
  if (!file || !file->W) refuse(path, "holds no local problem of fclib");
  if (file->spacedim != 2) refuse(path, fmt::format("spacedim must be 2, got {}", file->spacedim));
  if (file->V || file->R) refuse(path, "equality constraints (V, R) are not supported");
  const fclib_matrix& W = *file->W;
  if (W.m != W.n || W.n < 2 || W.n % 2 != 0) {
    refuse(path, fmt::format("W must be square with two rows per contact, got {} x {}", W.m, W.n));
  }
  const auto size = static_cast<Index>(W.n);
  LocalProblem local{dense(W, path), {file->q, file->q + size}, {file->mu, file->mu + size / 2}};
  LcpProblem problem = as_lcp(local);
  validate(problem);
  return problem;
}

}  // namespace tumble::problems
