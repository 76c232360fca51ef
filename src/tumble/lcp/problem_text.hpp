// LCPs as text, for the command line and for collections of test problems.
#pragma once

#include <string>
#include <string_view>

#include "tumble/lcp/exact.hpp"
#include "tumble/lcp/problem.hpp"

namespace tumble {

inline constexpr std::size_t k_max_text_problem_size = 2000;

// Reads
//
//   # anything behind a '#' is a comment
//   M
//   2 -1        one row per line, numbers separated by blanks; decimal (1e-3) or a fraction of two numbers (1/3)
//   1  2
//   q
//   -1 -1/2     on one line or spread over several
//
// Throws std::invalid_argument "<name>:<line>:<column>: <what is wrong>, <what is allowed>" for anything else, NaN,
// infinities, a matrix that is not square or a q of another length, and for n above k_max_text_problem_size.
// `name` stands for the text in those messages, usually the file's name.
LcpProblem parse_lcp(std::string_view text, const std::string& name = "lcp");

// The same text, every number meaning exactly what it says: 0.1 is 1/10. n is at most k_max_exact_size; a decimal has
// at most 1000 digits, and an exponent within +-1000.
ExactLcp parse_exact_lcp(std::string_view text, const std::string& name = "lcp");

// The form of `parse_lcp`, each number in the shortest decimal that reads back to the same bits.
std::string to_text(const LcpProblem& problem);

}  // namespace tumble
