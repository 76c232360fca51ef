#include "fclib_file.hpp"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "local_contacts.hpp"

#include "tumble/math/format.hpp"

extern "C" {
#include <fclib.h>
}

namespace tumble::problems {
namespace {

using Index = std::size_t;

// The matrix in compressed columns, in memory of ours.
struct Compressed {
  explicit Compressed(const LocalContacts& local) {
    const Index n = local.q.size();
    for (Index j = 0; j < n; ++j) {
      start.push_back(static_cast<int>(value.size()));
      for (Index i = 0; i < n; ++i) {
        if (local.W[j * n + i] == 0.0) continue;
        row.push_back(static_cast<int>(i));
        value.push_back(local.W[j * n + i]);
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
  throw std::runtime_error(tumble::format("{}: {}", path.string(), why));
}

// The entries of any of fclib's three forms, column after column, those of one place added up.
std::vector<double> dense(const fclib_matrix& matrix, const std::filesystem::path& path) {
  const int n = matrix.n;
  std::vector<double> entries(static_cast<Index>(n) * static_cast<Index>(n));
  const auto add = [&](int i, int j, double value) {
    if (i < 0 || i >= n || j < 0 || j >= n) refuse(path, tumble::format("W has an entry outside its {} rows", n));
    entries[static_cast<Index>(j) * static_cast<Index>(n) + static_cast<Index>(i)] += value;
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
  LocalContacts local = local_contacts(problem);
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
  if (file->spacedim != 2) refuse(path, tumble::format("spacedim must be 2, got {}", file->spacedim));
  if (file->V || file->R) refuse(path, "equality constraints (V, R) are not supported");
  const fclib_matrix& W = *file->W;
  if (W.m != W.n || W.n < 2 || W.n % 2 != 0) {
    refuse(path, tumble::format("W must be square with two rows per contact, got {} x {}", W.m, W.n));
  }
  const auto size = static_cast<Index>(W.n);
  const LocalContacts local{dense(W, path), {file->q, file->q + size}, {file->mu, file->mu + size / 2}};
  LcpProblem problem = as_lcp(local);
  validate(problem);
  return problem;
}

}  // namespace tumble::problems
