// How the vertices and rays of an LCP's solution set belong together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tumble {

// One polyhedron of solutions: the hull of its vertices plus the cone of its rays, by their indices in the lists of the
// solution set. A single vertex without a ray is an isolated solution, or one that ends no edge.
struct SolutionFace {
  std::vector<std::size_t> vertices;
  std::vector<std::size_t> rays;
};

// Where z and w of a vertex or a ray are not 0; bit i for entry i.
struct Support {
  std::uint32_t z = 0;
  std::uint32_t w = 0;
};

// The largest sets of vertices and rays that are complementary to each other, each with a vertex at least: there is a
// basis where all of them lie. n <= 32. The order follows the bases, 0 before 1 in the first entry.
std::vector<SolutionFace> solution_faces(std::size_t n, const std::vector<Support>& vertices,
                                         const std::vector<Support>& rays);

}  // namespace tumble
