// libFuzzer: any text is an LCP or is refused with std::invalid_argument; an LCP reads back from its own text, and is
// solved or not, but never with NaN in z.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "tumble/lcp/lemke.hpp"
#include "tumble/lcp/problem_text.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tumble::LcpProblem problem;
  try {
    problem = tumble::parse_lcp({reinterpret_cast<const char*>(data), size}, "fuzz.txt");
  } catch (const std::invalid_argument&) {
    return 0;
  }
  const tumble::LcpProblem again = tumble::parse_lcp(tumble::to_text(problem));
  if (again.M != problem.M || again.q != problem.q) std::abort();
  if (problem.size() > 12) return 0;
  const tumble::LcpResult result = tumble::lemke(problem);
  if (result.status == tumble::LcpStatus::solved) {
    for (const double z : result.z) {
      if (!std::isfinite(z) || z < 0.0) std::abort();
    }
  }
  return 0;
}
