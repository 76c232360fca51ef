// The comparison of solvers must survive the solvers.
#include "measure.hpp"

#include <chrono>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <thread>

#include "table.hpp"
#include <gtest/gtest.h>

namespace tumble::bench {
namespace {

// Answers z for every case, after doing `first`.
Solver answering(
    const std::string& name, double z, bool is_solved, void (*first)(const Case&) = [](const Case&) {}) {
  return {name, [=](const Case& c) -> std::optional<Attempt> {
            auto answer = std::make_shared<std::vector<double>>(1, z);
            return Attempt{[=, &c] { first(c); }, [=] { return Answer{is_solved, *answer}; }};
          }};
}

TEST(Measure, JudgesAnswersAndOutlivesCrashesAndHangs) {
  // z = 1; and no solution.
  const std::vector<Case> cases = {{"g", "one", {{1}, {-1}, {}}, {}, false, {}},
                                   {"g", "none", {{-1}, {-1}, {}}, {}, true, {}}};
  const std::vector<Solver> solvers = {
      answering("right", 1.0, true),
      answering("wrong", 0.5, true),
      answering("no", 0.0, false),
      answering("crashes on the first", 1.0, true,
                [](const Case& c) {
                  if (!c.has_no_solution) std::abort();
                }),
      answering("throws on the first", 1.0, true,
                [](const Case& c) {
                  if (!c.has_no_solution) throw std::runtime_error("no");
                }),
      answering("hangs on the first", 1.0, true,
                [](const Case& c) {
                  if (!c.has_no_solution) std::this_thread::sleep_for(std::chrono::minutes(1));
                }),
      {"not for these", [](const Case&) { return std::optional<Attempt>(); }},
      answering("last", 1.0, true),
  };
  std::size_t num_done = 0;
  const std::vector<Measurement> m = measure(cases, solvers, 1.0, [&](std::size_t done) { num_done = done; });
  using enum Verdict;
  const std::vector<Verdict> expected = {good,  wrong, said_no, crashed, crashed, timed_out, good,  //
                                         wrong, wrong, good,    wrong,   wrong,   wrong,     wrong};
  ASSERT_EQ(m.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(m[i].verdict, expected[i]) << "case " << m[i].case_index << ", " << solvers[m[i].solver_index].name;
  }
  EXPECT_EQ(num_done, cases.size());
}

TEST(Tables, CompareTimesOnlyWhereTheReferenceCameToAnEnd) {
  const Case one{"g", "one", {{1}, {-1}, {}}, {}, false, {}};
  const std::vector<Case> cases = {one, one, one};
  const std::vector<Solver> solvers = {{k_reference, {}}, {"other", {}}};
  using enum Verdict;
  const std::vector<Measurement> measurements = {{0, 0, timed_out, 0.0, 9.0, -1}, {0, 1, good, 0.0, 1e-3, 3},
                                                 {1, 0, crashed, 0.0, 9.0, -1},   {1, 1, good, 0.0, 1e-3, 3},
                                                 {2, 0, good, 0.0, 2e-3, -1},     {2, 1, good, 0.0, 1e-3, 3}};
  const auto has_row = [&](const std::vector<Measurement>& chosen, const std::string& row) {
    return tables(cases, solvers, chosen).find(row) != std::string::npos;
  };
  EXPECT_TRUE(has_row(measurements, "| other | 3 | 0 | 0 | 0 | 0e+00 | 1 ms | 0.5 | 3 |\n"));
  EXPECT_TRUE(has_row(measurements, "| Siconos lexicolemke | 3 | 0 | 0 | 2 | 0e+00 | 2 ms | 1 | - |\n"));
  const std::vector<Measurement> without_reference(measurements.begin(), measurements.begin() + 4);
  EXPECT_TRUE(has_row(without_reference, "| other | 2 | 0 | 0 | 0 | 0e+00 | 1 ms | - | 3 |\n"));
}

}  // namespace
}  // namespace tumble::bench
