// Solvers with a warm workspace take no memory from the heap.
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

#include "../allocations.hpp"
#include "problems.hpp"
#include "random_problems.hpp"
#include <gtest/gtest.h>

#include "tumble/lcp/methods.hpp"

namespace tumble {
namespace {

class LcpAllocations : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::counts_allocations()) GTEST_SKIP() << "only glibc without a sanitizer lets a program count all of them";
  }
};

// Solves them all in turn, again and again: none may allocate once all have been met.
void expect_no_allocation(const std::vector<LcpProblem>& problems, const LcpSettings& settings,
                          const std::string& what) {
  LcpWorkspace workspace;
  const auto solve_all = [&] {
    for (const LcpProblem& problem : problems) solve_lcp(problem, settings, workspace);
  };
  solve_all();
  solve_all();  // results and candidates swap their memory
  const long before = test::num_allocations();
  solve_all();
  EXPECT_EQ(test::num_allocations(), before) << what;
}

LcpProblem tower(std::size_t num_contacts) {
  problems::Random random(num_contacts);
  return as_lcp(problems::resting_tower(random, num_contacts));
}

LcpProblem dense(std::size_t n) {
  test::Random random(n);
  return test::random_definite(random, n);
}

TEST_F(LcpAllocations, AreCountedHoweverTheyAreMade) {
  const auto expect_one = [](const char* what, auto make) {
    const long before = test::num_allocations();
    void* volatile memory = make();  // volatile: or a pair of calls is optimised away
    EXPECT_EQ(test::num_allocations(), before + 1) << what;
    return static_cast<void*>(memory);
  };
  void* memory = expect_one("malloc", [] { return std::malloc(8); });
  std::free(expect_one("realloc", [&] { return std::realloc(memory, 10'000); }));
  std::free(expect_one("calloc", [] { return std::calloc(2, 8); }));
  std::free(expect_one("aligned_alloc", [] { return std::aligned_alloc(64, 64); }));
  std::free(expect_one("posix_memalign", [] {
    void* aligned = nullptr;
    return posix_memalign(&aligned, 64, 64) == 0 ? aligned : nullptr;
  }));
  ::operator delete(expect_one("new", [] { return ::operator new(8); }));
  constexpr std::align_val_t alignment{64};
  ::operator delete(expect_one("aligned new", [] { return ::operator new(64, alignment); }), alignment);
}

// `enumerate` has no workspace.
TEST_F(LcpAllocations, NoMethodMakesAnyInAWarmWorkspace) {
  const std::vector<LcpProblem> problems = {
      tower(2),  {{2, 1, 0, 1, 2, 1, 0, 1, 2}, {-1, 0.5, -1}, {}}, {{1, -1, -1, 1}, {-1, 2}, {}}, tower(5), dense(20),
      dense(120)};
  for (const LcpMethod& method : lcp_methods()) {
    if (std::holds_alternative<EnumerateSettings>(method.defaults)) continue;
    expect_no_allocation(problems, method.defaults, std::string(method.name));
    // Infeasible: here `robust` looks for a proof, which takes memory.
    if (std::holds_alternative<RobustSettings>(method.defaults)) continue;
    expect_no_allocation({tower(2), {{1, -1, -1, 1}, {-1, -1}, {}}}, method.defaults, std::string(method.name));
  }
}

// Not every method solves these. The bases of `lemke_lu` stay below the size where its factors are sparse: for those
// Eigen allocates.
TEST_F(LcpAllocations, NoMethodMakesAnyForTowers) {
  for (const LcpMethod& method : lcp_methods()) {
    if (std::holds_alternative<EnumerateSettings>(method.defaults)) continue;
    expect_no_allocation({tower(20), tower(2), tower(10), tower(4)}, method.defaults, std::string(method.name));
  }
}

// The rungs that most problems end on, in turns of small and large ones.
TEST_F(LcpAllocations, TheDefaultMakesNoneOnAnyOfItsUsualRungs) {
  const LcpProblem chain{{2, 1, 0, 1, 2, 1, 0, 1, 2}, {-1, 0.5, -1}, {}};
  const LcpProblem large = tower(12);
  struct Case {
    LcpProblem problem;
    LcpSettings settings;
    LcpRung rung;
  };
  const std::vector<Case> cases = {
      {tower(1), RobustSettings{}, LcpRung::closed_form},
      {large, RobustSettings{}, LcpRung::contact_modes},
      {chain, RobustSettings{}, LcpRung::lemke},
      {large, RobustSettings{.start_basis = robust(large).basis}, LcpRung::warm_start},
      {tower(2), RobustSettings{}, LcpRung::contact_modes},
      {chain, RobustSettings{.start_basis = {1, 0, 1}}, LcpRung::warm_start},
      {dense(120), RobustSettings{}, LcpRung::lemke_lu},
      {tower(20), RobustSettings{}, LcpRung::contact_modes},
  };
  LcpWorkspace workspace;
  const auto solve_all = [&] {
    for (const Case& c : cases) {
      EXPECT_EQ(solve_lcp(c.problem, c.settings, workspace).rung, c.rung) << c.problem.size();
    }
  };
  solve_all();
  solve_all();  // results and candidates swap their memory
  const long before = test::num_allocations();
  solve_all();
  EXPECT_EQ(test::num_allocations(), before);
}

}  // namespace
}  // namespace tumble
