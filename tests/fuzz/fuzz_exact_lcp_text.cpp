// libFuzzer: any text is an exact LCP or is refused with std::invalid_argument, without filling the memory; its numbers
// read back from their own text; and what exact Lemke says of it is true.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#include "tumble/lcp/exact.hpp"
#include "tumble/lcp/problem_text.hpp"

namespace {

std::string text_of(const tumble::ExactLcp& problem) {
  std::string text = "M";
  for (std::size_t i = 0; i < problem.M.size(); ++i) text += (i % problem.size() == 0 ? "\n" : " ") + problem.M[i];
  text += "\nq";
  for (const std::string& number : problem.q) text += "\n" + number;
  return text;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tumble::ExactLcp problem;
  try {
    problem = tumble::parse_exact_lcp({reinterpret_cast<const char*>(data), size}, "fuzz.txt");
    if (problem.size() > 4) return 0;
    const std::string text = text_of(problem);
    if (text.size() < 1000) {  // a product of two numbers in a file may be longer than a file may hold
      const tumble::ExactLcp again = tumble::parse_exact_lcp(text);
      if (again.M != problem.M || again.q != problem.q) std::abort();
    }
    const tumble::ExactResult result = tumble::exact_lemke(problem);
    if (result.status == tumble::LcpStatus::solved &&
        tumble::exact_solution(problem, result.basis).status != tumble::LcpStatus::solved) {
      std::abort();
    }
    if (result.status == tumble::LcpStatus::infeasible && !tumble::proves_infeasible(problem, result.certificate)) {
      std::abort();
    }
  } catch (const std::invalid_argument&) {
    return 0;
  }
  return 0;
}
