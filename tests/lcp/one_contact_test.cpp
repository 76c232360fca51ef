#include "tumble/lcp/one_contact.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "../random_contact.hpp"
#include <gtest/gtest.h>

#include "tumble/lcp/enumerate.hpp"
#include "tumble/lcp/one_contact_lanes.hpp"
#include "tumble/lcp/residual.hpp"

namespace tumble {
namespace {

// J_n = (0, 1, n), J_t = (1, 0, t), M^-1 = diag(1, 1, 12), velocity v.
OneContact contact(double n, double t, double friction, const Vector3& v) {
  return {1 + 12 * n * n, 12 * n * t, 1 + 12 * t * t, v[1] + n * v[2], v[0] + t * v[2], friction};
}

void expect_solution(const OneContact& c, ContactMode mode, double f_n, double f_t, double slip_speed) {
  const OneContactSolution solution = solve_one_contact(c);
  EXPECT_EQ(solution.status, LcpStatus::solved);
  EXPECT_EQ(solution.mode, mode);
  EXPECT_NEAR(solution.f_n, f_n, 1e-14);
  EXPECT_NEAR(solution.f_t, f_t, 1e-14);
  EXPECT_NEAR(solution.slip_speed, slip_speed, 1e-14);
  EXPECT_LT(solution.residual, 1e-14);
}

TEST(OneContact, SolvesProblemsWithExactSolutions) {
  expect_solution(contact(0, .5, .5, {.1, -1, 0}), ContactMode::stick, 1, -1 / 40., 0);
  expect_solution(contact(0, .5, .5, {4, -1, 0}), ContactMode::slip_right, 1, -.5, 2);
  expect_solution(contact(0, .5, .5, {-4, -1, 0}), ContactMode::slip_left, 1, .5, 2);
  expect_solution(contact(.4, .3, 1, {1, -1, 0}), ContactMode::slip_right, 25 / 37., -25 / 37., 21 / 37.);
  expect_solution(contact(.4, .3, 1, {1, 0, 0}), ContactMode::open, 0, 0, 1);
  expect_solution(contact(.4, .3, 1, {-1, 2, 0}), ContactMode::open, 0, 0, 1);
}

// Friction above A_nn / |A_nt|, where sliding one way pulls the contact in. [Painleve 1895]
TEST(OneContact, SolvesPainleveContacts) {
  expect_solution(contact(.3, -.8, 3, {1, -.01, 0}), ContactMode::slip_right, 1 / 1072., -3 / 1072., 26077 / 26800.);
  // Jammed: only sticking is left, an impact without collision.
  expect_solution(contact(.3, -.8, 3, {-1, -.01, 0}), ContactMode::stick, 7417 / 24400., 659 / 3050., 0);
  // Opening while jammed has three solutions; the one without force is chosen.
  expect_solution(contact(.3, -.8, 3, {-1, .01, 0}), ContactMode::open, 0, 0, 1);
}

TEST(OneContact, DoesNothingAtRestWithoutLoad) { expect_solution({1, 0, 1, 0, 0, .5}, ContactMode::open, 0, 0, 0); }

TEST(OneContact, MirrorsTheSolutionOfAMirroredContactBitForBit) {
  test::Random random(11);
  for (int i = 0; i < 2000; ++i) {
    OneContact c = test::random_contact(random, 3.0);
    const OneContactSolution original = solve_one_contact(c);
    c.A_nt = -c.A_nt;
    c.b_t = -c.b_t;
    const OneContactSolution mirrored = solve_one_contact(c);
    EXPECT_EQ(original.f_n, mirrored.f_n);
    EXPECT_EQ(original.f_t, -mirrored.f_t);
    EXPECT_EQ(original.slip_speed, mirrored.slip_speed);
  }
}

// The residual in closed form is the general one: same rows, same scales.
TEST(OneContact, ReportsTheResidualOfItsLcp) {
  test::Random random(12);
  for (int i = 0; i < 2000; ++i) {
    const OneContact c = test::random_contact(random, 3.0);
    const OneContactSolution solution = solve_one_contact(c);
    const double general = residual(as_lcp(c), as_z(solution)).largest();
    EXPECT_NEAR(solution.residual, general, 4e-16);  // both are round-off, summed in another order
    EXPECT_EQ(solution.status, LcpStatus::solved);
  }
}

TEST(OneContact, ReportsAWrongContactAsNumerical) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(solve_one_contact({1, 0, 1, -1, 0, nan}).status, LcpStatus::numerical);
  EXPECT_EQ(solve_one_contact({nan, 0, 1, -1, 0, .5}).status, LcpStatus::numerical);
  EXPECT_EQ(solve_one_contact({-1, 0, 1, -1, 0, 0}).status, LcpStatus::numerical);  // A not positive definite
  EXPECT_EQ(solve_one_contact({1, 0, 1, 1, 0, nan}).status, LcpStatus::numerical);
  EXPECT_EQ(solve_one_contact({1, 5, 1, 1, 1, -.5}).status, LcpStatus::numerical);
  const OneContactSolution beyond_double = solve_one_contact({1e-300, 0, 1e-300, -1e300, 0, .5});
  EXPECT_EQ(beyond_double.status, LcpStatus::numerical);
  EXPECT_EQ(beyond_double.residual, std::numeric_limits<double>::infinity());
}

// P5 of [Genot & Brogliato 1999]: opening while jammed, three motions with exact solutions.
TEST(OneContact, ListsTheThreeMotionsOfAJammedContactThatOpens) {
  const OneContactMotions motions = one_contact_motions(contact(.3, -.8, 3, {-1, .01, 0}));
  ASSERT_EQ(motions.count, 3);
  EXPECT_EQ(motions.motion[0].mode, ContactMode::open);
  EXPECT_EQ(motions.motion[1].mode, ContactMode::stick);
  EXPECT_NEAR(motions.motion[1].f_n, 6983 / 24400., 1e-14);
  EXPECT_NEAR(motions.motion[1].f_t, 641 / 3050., 1e-14);
  EXPECT_EQ(motions.motion[2].mode, ContactMode::slip_left);
  EXPECT_NEAR(motions.motion[2].f_n, 1 / 656., 1e-14);
  EXPECT_NEAR(motions.motion[2].f_t, 3 / 656., 1e-14);
  EXPECT_NEAR(motions.motion[2].slip_speed, 15821 / 16400., 1e-14);
  EXPECT_FALSE(motions.has_between);
}

// b_n = 0 and friction A_nn / |A_nt|: slip at any force up to that of sticking.
TEST(OneContact, TellsOfASegmentOfMotions) {
  const OneContactMotions motions = one_contact_motions({1.0, 0.5, 1.0, 0.0, -1.0, 2.0});
  EXPECT_EQ(motions.count, 1);
  const OneContactMotions jammed = one_contact_motions({1.0, 0.5, 1.0, 0.0, 1.0, 2.0});
  ASSERT_EQ(jammed.count, 2);
  EXPECT_TRUE(jammed.has_between);
  EXPECT_EQ(jammed.motion[1].mode, ContactMode::stick);
}

// The motions are those among the vertices that enumeration finds, which differ only by how friction is split.
TEST(OneContact, ListsTheMotionsThatEnumerationFinds) {
  test::Random random(14);
  int num_several = 0;
  for (int i = 0; i < 5000; ++i) {
    const OneContact c = test::random_contact(random, 8.0);
    const OneContactMotions motions = one_contact_motions(c);
    if (motions.count > 1) ++num_several;
    std::array<bool, 3> is_found{};
    for (const LcpResult& vertex : enumerate_solutions(as_lcp(c))) {
      const double f_n = vertex.z[0], f_t = vertex.z[2] - vertex.z[1];
      bool is_known = false;
      for (int k = 0; k < motions.count; ++k) {
        const OneContactSolution& motion = motions.motion[static_cast<std::size_t>(k)];
        // Condition of A up to 1e3, 1e-13 relative to the larger force.
        const double size = std::abs(f_n) + std::abs(f_t) + motion.f_n;
        if (std::abs(f_n - motion.f_n) + std::abs(f_t - motion.f_t) > 1e-10 * size) continue;
        is_known = is_found[static_cast<std::size_t>(k)] = true;
      }
      ASSERT_TRUE(is_known) << i;
    }
    for (int k = 0; k < motions.count; ++k) ASSERT_TRUE(is_found[static_cast<std::size_t>(k)]) << i << ' ' << k;
  }
  EXPECT_GT(num_several, 50);
}

struct Arrays {
  std::vector<double> in[6], f_n, f_t, slip_speed, residual;
  std::vector<ContactMode> mode;
  std::vector<LcpStatus> status;

  explicit Arrays(const std::vector<OneContact>& contacts) {
    for (const OneContact& c : contacts) {
      const double values[6] = {c.A_nn, c.A_nt, c.A_tt, c.b_n, c.b_t, c.friction};
      for (int k = 0; k < 6; ++k) in[k].push_back(values[k]);
    }
    for (auto* out : {&f_n, &f_t, &slip_speed, &residual}) out->resize(contacts.size());
    mode.resize(contacts.size());
    status.resize(contacts.size());
  }
  OneContactArrays contacts() const { return {in[0], in[1], in[2], in[3], in[4], in[5]}; }
  OneContactSolutionArrays solutions() { return {f_n, f_t, slip_speed, residual, mode, status}; }
};

bool is_equal(Arrays& arrays, std::size_t i, const OneContactSolution& s) {
  return arrays.f_n[i] == s.f_n && arrays.f_t[i] == s.f_t && arrays.slip_speed[i] == s.slip_speed &&
         arrays.residual[i] == s.residual && arrays.mode[i] == s.mode && arrays.status[i] == s.status;
}

std::vector<OneContact> many_contacts(std::size_t count) {
  test::Random random(15);
  std::vector<OneContact> contacts;
  for (std::size_t i = 0; i < count; ++i) contacts.push_back(test::random_contact(random, 3.0));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  if (count > 64) {  // some that need a closer look
    contacts[3] = {1, 0, 1, -1, 0, nan};
    contacts[17] = {1e-300, 0, 1e-300, -1e300, 0, .5};
    contacts[40] = {1, 0, 1, 0, 0, .5};
    contacts[63] = {-1, 0, 1, -1, 0, 0};
  }
  return contacts;
}

TEST(OneContact, SideBySideGivesTheSameBits) {
  for (const std::size_t count : {0, 1, 7, 63, 64, 65, 1000}) {
    const std::vector<OneContact> contacts = many_contacts(count);
    Arrays arrays(contacts);
    solve_one_contacts(arrays.contacts(), arrays.solutions());
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_TRUE(is_equal(arrays, i, solve_one_contact(contacts[i]))) << count << ' ' << i;
    }
  }
}

TEST(OneContact, EveryInstructionSetGivesTheSameBits) {
  const std::vector<OneContact> contacts = many_contacts(6400);
  for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!has_instruction_set(set)) continue;
    Arrays arrays(contacts);
    int num_done = 0;
    for (std::size_t first = 0; first < contacts.size(); first += 64) {
      std::array<std::uint8_t, 64> is_done{};
      const bool is_all = one_contact::block_solver(set)(arrays.contacts(), arrays.solutions(), first, is_done.data());
      EXPECT_EQ(is_all, std::find(is_done.begin(), is_done.end(), 0) == is_done.end());
      for (std::size_t k = 0; k < 64; ++k) {
        if (is_done[k] == 0) continue;
        ++num_done;
        ASSERT_TRUE(is_equal(arrays, first + k, solve_one_contact(contacts[first + k]))) << first + k;
      }
    }
    EXPECT_GT(num_done, 6300);  // the closer look stays rare
  }
}

TEST(OneContact, SideBySideRefusesArraysThatDoNotFit) {
  Arrays arrays(many_contacts(70));
  OneContactSolutionArrays forces_only;
  forces_only.f_n = arrays.f_n;
  solve_one_contacts(arrays.contacts(), forces_only);
  EXPECT_GT(*std::max_element(arrays.f_n.begin(), arrays.f_n.end()), 0.0);
  arrays.in[3].pop_back();
  EXPECT_THROW(solve_one_contacts(arrays.contacts(), arrays.solutions()), std::invalid_argument);
}

}  // namespace
}  // namespace tumble
