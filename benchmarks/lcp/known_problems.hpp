// Problems in text files, with what is known about their solutions.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tumble/lcp/problem.hpp"

namespace tumble::problems {

struct KnownProblem {
  std::string name;
  LcpProblem problem;
  std::optional<std::size_t> num_solutions;    // number of vertex solutions; nothing if the text does not say
  std::vector<std::vector<double>> solutions;  // those that are listed
  std::vector<double> certificate;             // y >= 0 with M^T y <= 0 and q^T y < 0, or empty
  std::string text;                            // what all this was read from
  std::vector<std::vector<std::string>> exact_solutions;  // `solutions` as they are written: fractions
};

// The text of `parse_lcp`. Comment lines of these forms say what is known, all optional; other comments are skipped:
//   # solutions: 2
//   # solution: 1 0 1/40 0
//   # infeasible: 1 1
// Throws std::invalid_argument where `parse_lcp` does, or "<name>:<line>: ..." for a number that is none, or a vector
// of another length than q.
KnownProblem parse_known_problem(std::string_view text, const std::string& name);

// The problem in a file, or those in all files *.txt of a folder in the order of their names; the file's stem is the
// name. Throws std::runtime_error for what cannot be read, and as `parse_known_problem`.
std::vector<KnownProblem> read_known_problems(const std::filesystem::path& file_or_folder);

}  // namespace tumble::problems
