#include "tumble/lcp/solution_face.hpp"

#include <algorithm>
#include <utility>

namespace tumble {
namespace {

bool includes(const SolutionFace& large, const SolutionFace& small) {
  return std::includes(large.vertices.begin(), large.vertices.end(), small.vertices.begin(), small.vertices.end()) &&
         std::includes(large.rays.begin(), large.rays.end(), small.rays.begin(), small.rays.end());
}

// Divides a set of generators, pair (z_i, w_i) by pair, into those with z_i = 0 and those with w_i = 0.
struct Division {
  std::size_t n;
  const std::vector<Support>& vertices;
  const std::vector<Support>& rays;
  std::vector<SolutionFace> faces = {};

  SolutionFace part(const SolutionFace& set, std::uint32_t Support::*side, std::uint32_t bit) const {
    SolutionFace kept;
    for (const std::size_t v : set.vertices) {
      if ((vertices[v].*side & bit) == 0) kept.vertices.push_back(v);
    }
    for (const std::size_t r : set.rays) {
      if ((rays[r].*side & bit) == 0) kept.rays.push_back(r);
    }
    return kept;
  }

  void divide(SolutionFace set, std::size_t i) {
    if (set.vertices.empty()) return;
    if (i == n) {
      if (std::none_of(faces.begin(), faces.end(), [&](const SolutionFace& face) { return includes(face, set); })) {
        faces.push_back(std::move(set));
      }
      return;
    }
    const std::uint32_t bit = std::uint32_t{1} << i;
    const std::size_t size = set.vertices.size() + set.rays.size();
    SolutionFace without_z = part(set, &Support::z, bit);
    if (without_z.vertices.size() + without_z.rays.size() == size) return divide(std::move(without_z), i + 1);
    SolutionFace without_w = part(set, &Support::w, bit);
    const bool is_whole = without_w.vertices.size() + without_w.rays.size() == size;
    if (!is_whole) divide(std::move(without_z), i + 1);
    divide(std::move(without_w), i + 1);
  }
};

}  // namespace

std::vector<SolutionFace> solution_faces(std::size_t n, const std::vector<Support>& vertices,
                                         const std::vector<Support>& rays) {
  Division division{n, vertices, rays};
  SolutionFace all;
  for (std::size_t v = 0; v < vertices.size(); ++v) all.vertices.push_back(v);
  for (std::size_t r = 0; r < rays.size(); ++r) all.rays.push_back(r);
  division.divide(std::move(all), 0);
  // A face found early may be part of a later one.
  std::vector<SolutionFace> largest;
  for (std::size_t f = 0; f < division.faces.size(); ++f) {
    const SolutionFace& face = division.faces[f];
    const bool is_part = std::any_of(division.faces.begin(), division.faces.end(), [&](const SolutionFace& other) {
      return &other != &face && includes(other, face);
    });
    if (!is_part) largest.push_back(face);
  }
  return largest;
}

}  // namespace tumble
