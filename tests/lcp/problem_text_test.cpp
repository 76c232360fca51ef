#include "tumble/lcp/problem_text.hpp"

#include <stdexcept>

#include "../random_contact.hpp"
#include <gtest/gtest.h>

namespace tumble {
namespace {

std::string error_of(const std::string& text) {
  try {
    parse_lcp(text, "file");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(ParseLcp, ReadsCommentsFractionsAndAnySpacing) {
  const LcpProblem problem = parse_lcp("# two by two\nM\n 2\t-1 # first row\r\n\n1 2e0\nq\n-1\n  -1/2");
  EXPECT_EQ(problem.M, (std::vector<double>{2, -1, 1, 2}));
  EXPECT_EQ(problem.q, (std::vector<double>{-1, -0.5}));
}

TEST(ParseLcp, PassesOverAByteOrderMark) { EXPECT_EQ(parse_lcp("\xEF\xBB\xBFM\n1\nq\n-1\n").M[0], 1.0); }

TEST(ParseLcp, ReadsBackWhatToTextWrites) {
  test::Random random(14);
  LcpProblem problem;
  for (int i = 0; i < 49; ++i) problem.M.push_back(random.uniform(-1.0, 1.0) * random.log_uniform(-200.0, 200.0));
  for (int i = 0; i < 7; ++i) problem.q.push_back(random.uniform(-1.0, 1.0));
  const LcpProblem read = parse_lcp(to_text(problem));
  EXPECT_EQ(read.M, problem.M);
  EXPECT_EQ(read.q, problem.q);
}

TEST(ParseLcp, NamesThePlaceOfWhatIsWrong) {
  EXPECT_EQ(error_of(""), "file:1:1: empty, expected a line 'M'");
  EXPECT_EQ(error_of("\n\n  N\n"), "file:3:3: expected a line 'M' before the matrix, got 'N'");
  EXPECT_EQ(error_of("M\n1 2\n3 x\nq\n1 1\n"), "file:3:3: expected a number like 1e-3 or 1/3, got 'x'");
  EXPECT_EQ(error_of("M\n1 2\n3\nq\n1 1\n"), "file:3:1: M: row 2 must have 2 entries like row 1, got 1");
  EXPECT_EQ(error_of("M\n1 2\n3 4\n5 6\nq\n1 1\n"), "file:4:1: M: must be square, got more than 2 rows of 2");
  EXPECT_EQ(error_of("M\n1 2\nq\n1 1\n"), "file:3:1: M: must be square with at least 1 row, got 1 rows of 2");
  EXPECT_EQ(error_of("M\nq\n1\n"), "file:2:1: M: must be square with at least 1 row, got 0 rows of 0");
  EXPECT_EQ(error_of("M\n1\n"), "file:2:1: expected a line 'q' after the matrix");
  EXPECT_EQ(error_of("M\n1\nq\n"), "file:3:1: q: must have 1 entries, got 0");
  EXPECT_EQ(error_of("M\n1\nq\n1 2\n"), "file:4:3: q: must have 1 entries, got more");
  EXPECT_EQ(error_of("M\nnan\nq\n1\n"), "file:2:1: must be finite, got 'nan'");
  EXPECT_EQ(error_of("M\n1/0\nq\n1\n"), "file:2:1: must be finite, got '1/0'");
  EXPECT_EQ(error_of("M\n1/\nq\n1\n"), "file:2:1: expected a number like 1e-3 or 1/3, got '1/'");
  EXPECT_EQ(error_of(std::string("M\n\x1b[31m\0\nq\n1\n", 12)).find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace tumble
