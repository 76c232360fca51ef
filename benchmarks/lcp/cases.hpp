// The cases of the comparison.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "solver.hpp"

namespace tumble::bench {

// Problems of a file or a folder, as `read_known_problems`.
std::vector<Case> cases_from_files(const std::filesystem::path& file_or_folder, const std::string& group);

// Random problems of `scale` times the usual number, made from `seed`.
std::vector<Case> generated_cases(std::uint64_t seed, double scale);

// The second step of stacks at rest, with the basis that solved the first.
std::vector<Case> warm_cases(std::uint64_t seed, double scale);

}  // namespace tumble::bench
