// What the program prints: tables for people, JSON for machines.
#pragma once

#include <string>
#include <vector>

#include "tumble/drop/drop.hpp"
#include "tumble/lcp/problem.hpp"
#include "tumble/lcp/result.hpp"

namespace tumble::cli {

// A table of the impacts, the final state and the files written.
std::string drop_text(const drop::Record& record, const std::vector<std::string>& files);
std::string drop_json(const drop::Record& record, const std::vector<std::string>& files);

// At least one result; `all` says whether they are meant to be all the solutions there are.
std::string lcp_text(const LcpProblem& problem, const std::vector<LcpResult>& results, bool all);
std::string lcp_json(const LcpProblem& problem, const std::vector<LcpResult>& results, bool all);

}  // namespace tumble::cli
