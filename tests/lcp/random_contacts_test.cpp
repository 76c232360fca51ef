// Closed form, Lemke and enumeration on 10^5 random contacts: the same motion and impulse.
#include <algorithm>
#include <cmath>

#include "../random_contact.hpp"
#include <gtest/gtest.h>

#include "tumble/lcp/enumerate.hpp"
#include "tumble/lcp/lemke.hpp"
#include "tumble/lcp/one_contact.hpp"

namespace tumble {
namespace {

constexpr int k_num_contacts = 100'000;

// What is unique: the force, not its split into f_t1 and f_t2.
struct Force {
  double normal;
  double tangential;
};

Force force_of(const std::vector<double>& z) { return {z[0], z[2] - z[1]}; }

// Distance of two motions over the size of the velocities before: free of units.
double motion_difference(const OneContact& c, const Force& a, const Force& b) {
  const double d_n = a.normal - b.normal;
  const double d_t = a.tangential - b.tangential;
  const double u_n = c.A_nn * d_n + c.A_nt * d_t;
  const double u_t = c.A_nt * d_n + c.A_tt * d_t;
  return std::max(std::abs(u_n), std::abs(u_t)) / std::max(std::abs(c.b_n), std::abs(c.b_t));
}

// Bodies here have A with condition up to about 1e3 and solves lose that much of 1e-16, twice.
constexpr double k_same = 1e-10;

TEST(RandomContacts, AllMethodsAgreeOnMotionAndImpulse) {
  test::Random random(13);
  int num_unique = 0;
  for (int i = 0; i < k_num_contacts; ++i) {
    const OneContact c = test::random_contact(random, i % 4 == 0 ? 5.0 : 1.0);
    const LcpProblem problem = as_lcp(c);
    const OneContactSolution closed = solve_one_contact(c);
    const LcpResult pivoted = lemke(problem);
    const std::vector<LcpResult> all = enumerate_solutions(problem);
    ASSERT_EQ(closed.status, LcpStatus::solved) << i;
    ASSERT_EQ(pivoted.status, LcpStatus::solved) << i << " residual " << pivoted.residual;
    ASSERT_FALSE(all.empty()) << i;

    // Painleve contacts may have several motions; each method must name one of them.
    const Force first = force_of(all.front().z);
    double spread = 0.0, closed_distance = 1e300, pivoted_distance = 1e300;
    for (const LcpResult& solution : all) {
      const Force force = force_of(solution.z);
      spread = std::max(spread, motion_difference(c, first, force));
      closed_distance = std::min(closed_distance, motion_difference(c, {closed.f_n, closed.f_t}, force));
      pivoted_distance = std::min(pivoted_distance, motion_difference(c, force_of(pivoted.z), force));
    }
    ASSERT_LT(closed_distance, k_same) << i;
    ASSERT_LT(pivoted_distance, k_same) << i;
    if (spread < k_same) ++num_unique;
    if (c.b_n < 0.0) {
      ASSERT_LT(spread, k_same) << "an approaching contact has one motion, " << i;
    }
  }
  EXPECT_GT(num_unique, k_num_contacts * 9 / 10);
}

}  // namespace
}  // namespace tumble
