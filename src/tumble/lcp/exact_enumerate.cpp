// All solutions of an LCP by the double description method: the cone of all (z, t) >= 0 is cut by w_i = (M z + q t)_i
// >= 0 for one i after the other. Of its extreme rays only those with z_i w_i = 0 for every i so far are kept [De
// Schutter & De Moor 1995]. Those with t > 0 are vertices of the solution set, the others its rays.
#include <algorithm>
#include <utility>

#include "tumble/lcp/integer_lcp.hpp"

namespace tumble {
namespace {

using boost::multiprecision::gcd;

struct Generator {
  std::vector<Integer> x;  // n + 1: z, t
  std::vector<Integer> w;  // n
  Support support;         // bit n of support.z is t; support.w knows the rows cut so far
};

// The face that p and q span is made of solutions, as far as rows were cut.
bool is_complementary(const Support& p, const Support& q) { return ((p.z | q.z) & (p.w | q.w)) == 0; }

bool is_within(const Support& inner, const Support& outer) {
  return (inner.z & ~outer.z) == 0 && (inner.w & ~outer.w) == 0;
}

class DoubleDescription {
 public:
  explicit DoubleDescription(const IntegerLcp& problem) : n_(problem.n) {
    for (std::size_t j = 0; j <= n_; ++j) {
      Generator& generator = generators_.emplace_back();
      generator.x.assign(n_ + 1, 0);
      generator.x[j] = 1;
      for (std::size_t i = 0; i < n_; ++i) generator.w.push_back(problem.entries[i * (n_ + 1) + j]);
      generator.support.z = bit(j);
    }
  }

  // False if there are too many generators.
  bool run() {
    for (std::size_t i = 0; i < n_; ++i) {
      if (!cut(i)) return false;
    }
    return true;
  }

  const std::vector<Generator>& generators() const { return generators_; }

 private:
  static std::uint32_t bit(std::size_t i) { return std::uint32_t{1} << i; }

  bool cut(std::size_t i) {
    std::vector<std::size_t> above, below;
    for (std::size_t g = 0; g < generators_.size(); ++g) {
      if (generators_[g].w[i] > 0) above.push_back(g);
      if (generators_[g].w[i] < 0) below.push_back(g);
    }
    std::vector<Generator> kept;
    for (const std::size_t p : above) {
      for (const std::size_t q : below) {
        if (is_edge(p, q)) kept.push_back(on_hyperplane(generators_[p], generators_[q], i));
        if (kept.size() > k_max_exact_generators) return false;
      }
    }
    for (Generator& generator : generators_) {
      if (generator.w[i] < 0) continue;
      if (generator.w[i] > 0) {
        if ((generator.support.z & bit(i)) != 0) continue;
        generator.support.w |= bit(i);
      }
      kept.push_back(std::move(generator));
    }
    generators_ = std::move(kept);
    return generators_.size() <= k_max_exact_generators;
  }

  // True if p and q span a complementary two-dimensional face of the cone: no third generator lies on the smallest face
  // with both. All generators on a complementary face are complementary, so none of them has been dropped.
  bool is_edge(std::size_t p, std::size_t q) const {
    const Support& of_p = generators_[p].support;
    const Support& of_q = generators_[q].support;
    if (!is_complementary(of_p, of_q)) return false;
    const Support both{of_p.z | of_q.z, of_p.w | of_q.w};
    for (std::size_t g = 0; g < generators_.size(); ++g) {
      if (g != p && g != q && is_within(generators_[g].support, both)) return false;
    }
    return true;
  }

  // The point with w_i = 0 between p (w_i > 0) and q (w_i < 0), in lowest terms.
  Generator on_hyperplane(const Generator& p, const Generator& q, std::size_t i) const {
    Integer of_q = p.w[i];
    Integer of_p = -q.w[i];
    Integer factor = gcd(of_p, of_q);
    of_p /= factor;
    of_q /= factor;
    Generator middle;
    factor = 0;
    for (std::size_t j = 0; j <= n_; ++j) {
      middle.x.push_back(of_p * p.x[j] + of_q * q.x[j]);
      if (factor != 1) factor = gcd(factor, middle.x[j]);
    }
    if (factor != 1) {
      for (Integer& x : middle.x) x /= factor;
    }
    for (std::size_t k = 0; k < n_; ++k) {
      Integer w = k == i ? Integer(0) : Integer(of_p * p.w[k] + of_q * q.w[k]);
      middle.w.push_back(factor == 1 ? w : Integer(w / factor));
    }
    middle.support = {p.support.z | q.support.z, p.support.w | q.support.w};
    return middle;
  }

  std::size_t n_;
  std::vector<Generator> generators_;
};

}  // namespace

RationalSolutionSet rational_solution_set(const IntegerLcp& problem) {
  const std::size_t n = problem.n;
  RationalSolutionSet set;
  DoubleDescription description(problem);
  set.is_complete = description.run();
  if (!set.is_complete) return set;

  std::vector<const Generator*> vertices, rays;
  for (const Generator& generator : description.generators()) {
    (generator.x[n] > 0 ? vertices : rays).push_back(&generator);
  }
  const std::uint32_t only_z = (std::uint32_t{1} << n) - 1;
  const auto by_basis = [&](const Generator* a, const Generator* b) {
    return std::pair(a->support.z & only_z, a->support.w) < std::pair(b->support.z & only_z, b->support.w);
  };
  std::sort(vertices.begin(), vertices.end(), by_basis);
  std::sort(rays.begin(), rays.end(), by_basis);
  const auto supports = [&](const std::vector<const Generator*>& list) {
    std::vector<Support> result;
    for (const Generator* generator : list) {
      result.push_back({generator->support.z & only_z, generator->support.w});
    }
    return result;
  };
  set.faces = solution_faces(n, supports(vertices), supports(rays));

  const auto z_of = [&](const Generator& generator, const Integer& divisor) {
    std::vector<Rational> z;
    for (std::size_t i = 0; i < n; ++i) z.push_back(Rational(generator.x[i], divisor) * problem.z_unit[i]);
    return z;
  };
  for (const Generator* vertex : vertices) {
    set.z.push_back(z_of(*vertex, vertex->x[n]));
    set.bases.push_back(vertex->support.z & only_z);
    std::vector<Rational>& w = set.w.emplace_back();
    for (std::size_t i = 0; i < n; ++i) w.push_back(Rational(vertex->w[i], vertex->x[n]) * problem.w_unit[i]);
  }
  // Rays from which no vertex starts solve M z >= 0 only; the others are numbered anew.
  std::vector<std::size_t> new_index(rays.size(), rays.size());
  for (SolutionFace& face : set.faces) {
    for (std::size_t& ray : face.rays) {
      if (new_index[ray] == rays.size()) {
        new_index[ray] = set.rays.size();
        set.rays.push_back(in_lowest_terms(z_of(*rays[ray], 1)));
      }
      ray = new_index[ray];
    }
  }
  return set;
}

}  // namespace tumble
