// Which motions contacts allow: problems with known answers, and one contact against its closed form.
#include "tumble/lcp/contact_motions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "../random_contact.hpp"
#include "known_problems.hpp"
#include "other_units.hpp"
#include "problems.hpp"
#include <gtest/gtest.h>

#include "tumble/lcp/enumerate.hpp"

namespace tumble {
namespace {

using enum ContactMode;

LcpProblem known(const char* name) {
  const auto file = std::filesystem::path(TUMBLE_LCP_DATA) / (std::string(name) + ".txt");
  return problems::read_known_problems(file).front().problem;
}

const ContactMotion* with_modes(const ContactMotions& motions, const std::vector<ContactMode>& modes) {
  const auto has_modes = [&](const ContactMotion& motion) { return motion.modes == modes; };
  const auto found = std::find_if(motions.motions.begin(), motions.motions.end(), has_modes);
  return found == motions.motions.end() ? nullptr : &*found;
}

TEST(ContactMotions, AreFewerThanSolutions) {
  struct Case {
    const char* name;
    std::size_t num_vertices;
  };
  // Two corners of a box, where friction is undetermined, and the rod that can only jam.
  for (const Case& c : {Case{"box-at-rest", 5}, Case{"box-rocking", 7}, Case{"painleve-jam", 2}, Case{"stick", 2}}) {
    const LcpProblem problem = known(c.name);
    const ContactMotions motions = contact_motions(problem);
    EXPECT_EQ(enumerate_solutions(problem).size(), c.num_vertices) << c.name;
    EXPECT_EQ(motions.status, LcpStatus::solved) << c.name;
    ASSERT_TRUE(motions.is_unique()) << c.name;
    const ContactMotion& motion = motions.motions.front();
    for (const ContactMode mode : motion.modes) EXPECT_EQ(mode, stick) << c.name;
    for (const double u : motion.velocities) EXPECT_NEAR(u, 0.0, 1e-14) << c.name;  // terms of order 1
  }
}

TEST(ContactMotions, ListTheThreeOfAJammedRodThatOpens) {
  const ContactMotions motions = contact_motions(known("painleve-three-motions"));
  EXPECT_EQ(motions.motions.size(), 3u);
  EXPECT_FALSE(motions.has_between);
  EXPECT_FALSE(motions.is_unique());
  const ContactMotion* parts = with_modes(motions, {open});
  ASSERT_NE(parts, nullptr);
  EXPECT_EQ(parts->velocities, (std::vector<double>{0.01, -1.0}));
  const ContactMotion* slides = with_modes(motions, {slip_left});
  ASSERT_NE(slides, nullptr);
  EXPECT_NEAR(slides->velocities[0], 0.0, 1e-15);
  EXPECT_NEAR(slides->velocities[1], -15821 / 16400., 1e-15);
  EXPECT_NE(with_modes(motions, {stick}), nullptr);
}

// Opposed normals of a body that slides: without a force it goes on; squeezed with 1 N s on each side, it stops. Any
// weaker squeeze slows it down by as much, so every speed between is a motion too.
TEST(ContactMotions, TellOfAContinuum) {
  const ContactMotions wedge = contact_motions(known("wedge-consistent"));
  EXPECT_EQ(wedge.motions.size(), 2u);
  EXPECT_TRUE(wedge.has_between);
  EXPECT_NE(with_modes(wedge, {stick, stick}), nullptr);
  const ContactMotion* slides = with_modes(wedge, {open, open});
  ASSERT_NE(slides, nullptr);
  EXPECT_EQ(slides->velocities, (std::vector<double>{0.0, 1.0, 0.0, -1.0}));

  const ContactMotions one = contact_motions(as_lcp(OneContact{1.0, 0.5, 1.0, 0.0, 1.0, 2.0}));
  EXPECT_EQ(one.motions.size(), 2u);
  EXPECT_TRUE(one.has_between);
}

// A body between two opposed surfaces that does not move can be squeezed without end: the ray changes nothing. A slip
// speed above that of an open contact is a ray as well.
TEST(ContactMotions, IgnoreRaysThatMoveNothing) {
  const Vector3 up{0, 1, 0}, down{0, -1, 0}, right{1, 0, 0}, none{};
  const ContactSystem jaws{
      {{1, 1, 1}}, {{0, 0, 0}}, {{-1, 0, none, up, none, right, 0.5, 0.0}, {-1, 0, none, down, none, right, 0.5, 0.0}}};
  ASSERT_FALSE(solution_set(as_lcp(jaws)).rays.empty());
  EXPECT_TRUE(contact_motions(jaws).is_unique());
  EXPECT_TRUE(contact_motions(as_lcp(jaws)).is_unique());
}

TEST(ContactMotions, AreNoneWithoutASolution) {
  const ContactMotions motions = contact_motions(known("wedge-too-narrow"));
  EXPECT_NE(motions.status, LcpStatus::solved);
  EXPECT_TRUE(motions.motions.empty());
  EXPECT_FALSE(motions.is_unique());
}

TEST(ContactMotions, OfOneContactAreThoseInClosedForm) {
  test::Random random(41);
  std::array<int, 4> num_with{};
  for (int i = 0; i < 5'000; ++i) {
    const OneContact c = test::random_contact(random, 8.0);
    const OneContactMotions expected = one_contact_motions(c);
    const ContactMotions motions = contact_motions(as_lcp(c));
    ASSERT_EQ(motions.motions.size(), static_cast<std::size_t>(expected.count)) << i;
    EXPECT_EQ(motions.has_between, expected.has_between) << i;
    ++num_with[motions.motions.size()];
    for (int k = 0; k < expected.count; ++k) {
      const OneContactSolution& motion = expected.motion[static_cast<std::size_t>(k)];
      // The first friction unknown of `as_lcp(OneContact)` acts along -t.
      const bool is_left = motion.mode == slip_left, is_right = motion.mode == slip_right;
      const ContactMotion* found = with_modes(motions, {is_left ? slip_right : is_right ? slip_left : motion.mode});
      ASSERT_NE(found, nullptr) << i;
      EXPECT_NEAR(std::abs(found->velocities[1]), motion.slip_speed, 1e-10 * (std::abs(c.b_t) + motion.slip_speed));
    }
  }
  EXPECT_GT(num_with[1], 4'000);
  EXPECT_GT(num_with[2] + num_with[3], 50);
}

// With friction 0 a system still has one mode and two velocities for each contact.
TEST(ContactMotions, OfASystemAreInTheOrderOfItsContacts) {
  ContactSystem system{{{1, 1, 12}}, {{0.5, -1, 0}}, {}};
  for (const double r_x : {-0.5, 0.5}) {
    system.contacts.push_back({-1, 0, {}, {0, 1, r_x}, {}, {1, 0, 0.25}, 0.0, 0.0});
  }
  system.contacts[1].friction = 0.5;
  const ContactMotions motions = contact_motions(system);
  ASSERT_TRUE(motions.is_unique());
  EXPECT_EQ(motions.motions[0].velocities.size(), 4u);
  EXPECT_EQ(motions.motions[0].modes.size(), 2u);
  system.contacts.resize(1);
  EXPECT_TRUE(contact_motions(system).is_unique());
}

// The LCP of contacts without friction does not tell which normal belongs to which cone; their order does.
TEST(ContactMotions, OfAnLcpAreInTheOrderOfItsContactsWithoutFrictionToo) {
  test::Random random(44);
  for (int i = 0; i < 40; ++i) {
    ContactSystem system = problems::tower(random, 3);
    for (std::size_t k = 0; k < 3; ++k) {
      if ((i >> k) % 2 != 0) system.contacts[k].friction = 0.0;
    }
    const ContactMotions expected = contact_motions(system), found = contact_motions(as_lcp(system));
    ASSERT_EQ(found.motions.size(), expected.motions.size()) << i;
    for (std::size_t m = 0; m < expected.motions.size(); ++m) {
      EXPECT_EQ(found.motions[m].modes, expected.motions[m].modes) << i;
      EXPECT_EQ(found.motions[m].velocities, expected.motions[m].velocities) << i;
    }
  }
}

// (c_1, c_2, b+, b-, s): one of the normals has no friction unknowns, and nothing tells which.
TEST(ContactMotions, CountConesAndNormalsAloneThatDoNotPair) {
  const LcpProblem problem{{1, 0, 0,  0,  0,  //
                            0, 1, 0,  0,  0,  //
                            0, 0, 1,  -1, 1,  //
                            0, 0, -1, 1,  1,  //
                            0, 0, -1, -1, 0},
                           {-1, 2, 3, -3, 0},
                           {}};
  const ContactMotions found = contact_motions(problem);
  ASSERT_TRUE(found.is_unique());
  EXPECT_EQ(found.motions[0].modes, (std::vector<ContactMode>{open, stick, open}));
  EXPECT_EQ(found.motions[0].velocities, (std::vector<double>{0, 3, 0, 0, 2, 0}));
}

TEST(ContactMotions, DoNotDependOnUnits) {
  test::Random random(42);
  int num_unique = 0;
  for (int i = 0; i < 300; ++i) {
    const ContactSystem system = i % 2 ? problems::painleve(random, 2) : problems::tower(random, 2);
    const ContactMotions motions = contact_motions(system);
    ASSERT_EQ(motions.status, LcpStatus::solved) << i;
    num_unique += motions.is_unique();
    const ContactMotions other = contact_motions(test::in_other_units(system, 13, -9, 6));
    ASSERT_EQ(other.motions.size(), motions.motions.size()) << i;
    EXPECT_EQ(other.has_between, motions.has_between) << i;
    for (std::size_t k = 0; k < motions.motions.size(); ++k) {
      EXPECT_EQ(other.motions[k].modes, motions.motions[k].modes) << i;
    }
  }
  EXPECT_GT(num_unique, 100);
}

TEST(ContactMotions, RefuseWhatIsNoContact) {
  EXPECT_THROW(contact_motions({{2, 1, 1, 2}, {-5, -6}, {}}), std::invalid_argument);
  test::Random random(43);
  EXPECT_THROW(contact_motions(problems::tower(random, 4)), std::invalid_argument);  // n = 16
}

}  // namespace
}  // namespace tumble
