#include "local_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tumble::problems {
namespace {

using Index = std::size_t;

// Row of the LCP that holds row i of W.
Index lcp_row(Index i, Index num_contacts) { return i % 2 == 0 ? i / 2 : num_contacts + 2 * (i / 2); }

}  // namespace

LcpProblem as_lcp(const LocalContacts& contacts) {
  const Index k = contacts.friction.size(), n = 4 * k;
  LcpProblem problem{std::vector<double>(n * n), std::vector<double>(n), std::vector<double>(n)};
  const auto entry = [&](Index i, Index j) -> double& { return problem.M[i * n + j]; };
  double speed = 0.0;
  for (Index i = 0; i < 2 * k; ++i) {
    const Index row = lcp_row(i, k);
    problem.q[row] = contacts.q[i];
    speed = std::max(speed, std::abs(contacts.q[i]));
    if (i % 2 == 1) problem.q[row + 1] = contacts.q[i] == 0.0 ? 0.0 : -contacts.q[i];
    for (Index j = 0; j < 2 * k; ++j) {
      const double value = contacts.W[j * 2 * k + i];
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
    entry(cone, i) = contacts.friction[i];
    entry(cone, plus) = entry(cone, plus + 1) = -1.0;
    const double nn = entry(i, i);
    problem.row_sizes[i] = problem.row_sizes[plus] = problem.row_sizes[plus + 1] = speed;
    problem.row_sizes[cone] = nn > 0.0 ? speed / nn : 0.0;
  }
  return problem;
}

LocalContacts local_contacts(const LcpProblem& problem) {
  validate(problem);
  const Index k = problem.size() / 4;
  LocalContacts contacts;
  if (4 * k == problem.size()) {
    for (Index j = 0; j < 2 * k; ++j) {
      for (Index i = 0; i < 2 * k; ++i) contacts.W.push_back(problem(lcp_row(i, k), lcp_row(j, k)));
      contacts.q.push_back(problem.q[lcp_row(j, k)]);
    }
    for (Index i = 0; i < k; ++i) contacts.friction.push_back(problem(3 * k + i, i));
    const LcpProblem again = as_lcp(contacts);
    if (again.M == problem.M && again.q == problem.q) return contacts;
  }
  throw std::invalid_argument("M, q: must be the LCP of planar contacts, ordered (c, b+ and b-, s)");
}

std::vector<double> lcp_solution(const LocalContacts& contacts, std::span<const double> impulses) {
  const Index k = contacts.friction.size();
  std::vector<double> z(4 * k);
  for (Index i = 0; i < k; ++i) {
    const Index normal = 2 * i, tangent = normal + 1, plus = lcp_row(tangent, k);
    double slip = contacts.q[tangent];
    for (Index j = 0; j < 2 * k; ++j) slip += contacts.W[j * 2 * k + tangent] * impulses[j];
    z[lcp_row(normal, k)] = impulses[normal];
    z[plus] = std::max(impulses[tangent], 0.0);
    z[plus + 1] = std::max(-impulses[tangent], 0.0);
    z[3 * k + i] = std::abs(slip);
  }
  return z;
}

}  // namespace tumble::problems
