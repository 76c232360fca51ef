#include "cases.hpp"

#include <algorithm>

#include "known_problems.hpp"
#include "problems.hpp"

#include "tumble/lcp/robust.hpp"
#include "tumble/math/format.hpp"

namespace tumble::bench {
namespace {

using problems::Family;
using problems::Random;

Case as_case(const std::string& group, const std::string& name, const ContactSystem& system) {
  return {group, name, as_lcp(system), system, false, {}};
}

int scaled(int count, double scale) { return std::max(1, static_cast<int>(count * scale)); }

constexpr std::size_t k_stack_sizes[] = {8, 16, 40, 80, 160, 240, 400};  // n

}  // namespace

std::vector<Case> cases_from_files(const std::filesystem::path& file_or_folder, const std::string& group) {
  std::vector<Case> cases;
  for (problems::KnownProblem& known : problems::read_known_problems(file_or_folder)) {
    cases.push_back({group, known.name, std::move(known.problem), std::nullopt, known.num_solutions == 0u, {}});
  }
  return cases;
}

std::vector<Case> generated_cases(std::uint64_t seed, double scale) {
  std::vector<Case> cases;
  Random random(seed);
  const auto add = [&](const std::string& group, const Family& family, std::size_t num_contacts, int count) {
    for (int i = 0; i < scaled(count, scale); ++i) {
      const std::string name = tumble::format("{} {} #{}", family.name, 4 * num_contacts, i);
      cases.push_back(as_case(group, name, family.make(random, num_contacts)));
    }
  };
  const auto families = problems::families();
  for (const Family& family : families) {
    if (family.name == "wild") {
      add("wild, n = 4", family, 1, 500);
      for (std::size_t k = 1; k <= 4; ++k) add("wild, n = 4 .. 16", family, k, 500);
      for (std::size_t k = 5; k <= 12; ++k) add("wild, n = 20 .. 48", family, k, 50);
    } else if (family.name == "wedge" || family.name == "painleve") {
      for (std::size_t k = 1; k <= 4; ++k) add(tumble::format("{}, n = 4 .. 16", family.name), family, k, 50);
    }
  }
  for (const std::size_t n : k_stack_sizes) {
    for (const Family& family : families) {
      if (family.name == "tower" || family.name == "pyramid" || family.name == "pile") {
        add(tumble::format("stacks, n = {}", n), family, n / 4, n < 100 ? 20 : 5);
      }
    }
  }
  return cases;
}

std::vector<Case> warm_cases(std::uint64_t seed, double scale) {
  std::vector<Case> cases;
  Random random(seed);
  for (const std::size_t n : k_stack_sizes) {
    for (int i = 0; i < scaled(n < 100 ? 20 : 5, scale); ++i) {
      const ContactSystem first = problems::resting_tower(random, n / 4);
      const LcpResult result = robust(as_lcp(first));
      if (result.status != LcpStatus::solved) continue;
      const ContactSystem second = problems::next_step(first, result.z, random);
      cases.push_back(
          as_case(tumble::format("next step at rest, n = {}", n), tumble::format("tower {} #{}", n, i), second));
      cases.back().start_basis = result.basis;
    }
  }
  return cases;
}

}  // namespace tumble::bench
