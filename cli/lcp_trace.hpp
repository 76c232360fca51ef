// Lemke's pivots as a textbook shows them.
#pragma once

#include <cstddef>
#include <string>

#include "tumble/lcp/lemke.hpp"

namespace tumble::cli {

inline constexpr std::size_t k_max_trace_size = 8;  // wider tableaus do not fit on a line

// Every tableau, with what enters and what leaves. n is that of the problem, at most k_max_trace_size.
std::string trace_text(const LemkeTrace& trace, std::size_t n, const LemkeSettings& settings);

}  // namespace tumble::cli
