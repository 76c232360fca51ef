// Contact problems written to fclib's files and read back.
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "../temporary_folder.hpp"
#include "fclib_file.hpp"
#include "problems.hpp"
#include <gtest/gtest.h>

namespace tumble {
namespace {

TEST(Fclib, ReadsBackWhatItWrote) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "round_trip.hdf5";
  for (const problems::Family& family : problems::families()) {
    for (const std::size_t num_contacts : {1u, 2u, 7u}) {
      problems::Random random(num_contacts);
      LcpProblem problem = as_lcp(family.make(random, num_contacts));
      if (num_contacts > 1) problem.M[1] += 1.0;  // no longer symmetric: rows must not become columns
      problems::write_fclib(path, problem);
      const LcpProblem again = problems::read_fclib(path);
      EXPECT_EQ(again.M, problem.M) << family.name;
      EXPECT_EQ(again.q, problem.q) << family.name;
      EXPECT_EQ(again.row_sizes, problem.row_sizes) << family.name;
    }
  }
}

TEST(Fclib, RefusesProblemsThatAreNotOfContacts) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "refused.hdf5";
  EXPECT_THROW(problems::write_fclib(path, {{1}, {-1}, {}}), std::invalid_argument);
  problems::Random random(1);
  LcpProblem problem = as_lcp(problems::tower(random, 2));
  problem.M[8 * 2 + 6] = 2.0;  // the 1 of a slip speed
  EXPECT_THROW(problems::write_fclib(path, problem), std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(Fclib, RefusesFilesThatAreNotItsOwn) {
  const test::TemporaryFolder folder;
  const std::filesystem::path path = folder / "text.hdf5";
  EXPECT_THROW(problems::read_fclib(path), std::runtime_error);
  std::ofstream(path) << "M\n1\nq\n1\n";
  EXPECT_THROW(problems::read_fclib(path), std::runtime_error);
}

}  // namespace
}  // namespace tumble
