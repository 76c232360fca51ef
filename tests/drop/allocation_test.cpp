// Steps and solvers take no memory from the heap.
#include <utility>
#include <vector>

#include "../allocations.hpp"
#include <gtest/gtest.h>

#include "tumble/drop/drop.hpp"
#include "tumble/lcp/contact_system.hpp"
#include "tumble/lcp/solve.hpp"

namespace tumble::drop {
namespace {

TEST(Allocations, AStepMakesNone) {
  State state{{0.0, 0.2, 0.5}, {1.0, -2.0, 3.0}};
  int num_contacts = 0;
  const long before = test::num_allocations();
  for (int k = 0; k < 500; ++k) {
    const auto [next, record] = step_with_record(state.q, state.v);
    if (record.z[0] > 0.0) ++num_contacts;
    state = next;
  }
  EXPECT_EQ(test::num_allocations(), before);
  EXPECT_GT(num_contacts, 10);
}

TEST(Allocations, ATrajectoryMakesTwo) {  // q and v
  const long before = test::num_allocations();
  const Trajectory trajectory = simulate({0.0, 0.2, 0.5}, {1.0, -2.0, 3.0}, {.columns = 1000});
  EXPECT_EQ(test::num_allocations(), before + 2);
  EXPECT_EQ(trajectory.columns, 1000);
}

TEST(Allocations, ASolverWithAWarmWorkspaceMakesNone) {
  // Two contacts of a box, and a problem without contacts.
  const BodyContact left{-1, 0, {}, {0.0, 1.0, -0.5}, {}, {1.0, 0.0, 0.5}, 0.3, 0.0};
  const BodyContact right{-1, 0, {}, {0.0, 1.0, 0.5}, {}, {1.0, 0.0, 0.5}, 0.3, 0.0};
  const std::vector<LcpProblem> problems = {as_lcp({{{1.0, 1.0, 6.0}}, {{2.0, -1.0, 0.5}}, {left, right}}),
                                            {{2, 1, 0, 1, 2, 1, 0, 1, 2}, {-1, 0.5, -1}, {}},
                                            {{1, -1, -1, 1}, {-1, -1}, {}}};
  const std::vector<LcpSettings> all = {MurtySettings{}, DantzigSettings{}, NewtonSettings{}, PgsSettings{},
                                        NlgsSettings{}};
  LcpWorkspace workspace;
  for (const LcpSettings& settings : all) {
    for (const LcpProblem& problem : problems) solve_lcp(problem, settings, workspace);
    const long before = test::num_allocations();
    for (const LcpProblem& problem : problems) solve_lcp(problem, settings, workspace);
    EXPECT_EQ(test::num_allocations(), before) << to_string(workspace.result.rung);
  }
}

// The rungs that most problems end on, in turns of small and large ones.
TEST(Allocations, TheDefaultSolverWithAWarmWorkspaceMakesNone) {
  const auto tower = [](int num_boxes) {
    ContactSystem system;
    for (int k = 0; k < num_boxes; ++k) {
      system.inverse_mass.push_back({1.0, 1.0, 6.0});
      system.velocity.push_back({0.1, -0.5, 0.02 * k});
      for (const double x : {-0.5, 0.5}) {
        system.contacts.push_back(
            {k - 1, k, {0.0, -1.0, -x}, {0.0, 1.0, x}, {-1.0, 0.0, 0.5}, {1.0, 0.0, 0.5}, 0.3, 0.0});
      }
    }
    return system;
  };
  ContactSystem single = tower(1);
  single.contacts.pop_back();
  const LcpProblem large = as_lcp(tower(6));
  const std::vector<std::pair<LcpProblem, RobustSettings>> cases = {
      {as_lcp(single), {}},
      {large, {}},
      {{{2, 1, 0, 1, 2, 1, 0, 1, 2}, {-1, 0.5, -1}, {}}, {}},
      {large, {.start_basis = robust(large).basis}},
      {as_lcp(tower(1)), {}},
      {{{2, 1, 0, 1, 2, 1, 0, 1, 2}, {-1, 0.5, -1}, {}}, {.start_basis = {1, 0, 1}}}};
  const LcpRung rungs[] = {LcpRung::closed_form, LcpRung::contact_modes, LcpRung::lemke,
                           LcpRung::warm_start,  LcpRung::contact_modes, LcpRung::warm_start};
  LcpWorkspace workspace;
  std::vector<LcpSettings> settings;
  for (const auto& [problem, chosen] : cases) settings.emplace_back(chosen);
  const auto solve_all = [&] {
    for (std::size_t i = 0; i < cases.size(); ++i) {
      solve_lcp(cases[i].first, settings[i], workspace);
      EXPECT_EQ(workspace.result.rung, rungs[i]) << i;
    }
  };
  solve_all();
  solve_all();  // results and candidates swap their memory
  const long before = test::num_allocations();
  solve_all();
  EXPECT_EQ(test::num_allocations(), before);
}

}  // namespace
}  // namespace tumble::drop
