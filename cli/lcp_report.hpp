// What `tumble lcp` prints: text for people, JSON for machines.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tumble/lcp/problem.hpp"
#include "tumble/lcp/result.hpp"

namespace tumble::cli {

// What became of one file.
struct LcpReport {
  std::string name;
  std::size_t n = 0;
  bool all = false;                // whether `results` are meant to be all the solutions there are
  std::vector<LcpResult> results;  // at least one, but for bad input; all solutions, or one that says why there is none
  std::string error;               // bad input: what is wrong, else empty
};

LcpStatus status_of(const LcpReport& report);

// "z1 w2 w3": of each pair the variable that may be other than 0.
std::string basis_text(const std::vector<std::uint8_t>& basis);

// A file alone.
std::string lcp_text(const LcpReport& report);
std::string lcp_json(const LcpReport& report);

// Several: a table with one line each; an array of objects.
std::string lcp_text(const std::vector<LcpReport>& reports);
std::string lcp_json(const std::vector<LcpReport>& reports);

}  // namespace tumble::cli
