#include "tumble/output/csv.hpp"

#include <limits>
#include <stdexcept>

#include "record_samples.hpp"

namespace tumble::output {
namespace {

using test::has;
using test::message_of;

std::string refusal(const std::string& text) {
  return message_of<std::invalid_argument>([&] { parse_record_csv(text, "run.csv"); });
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Csv, ReadsBackTheSameBits) {
  for (const int columns : {2, 3, 150}) {
    const drop::Record record = test::course_record(columns);
    test::expect_same(parse_record_csv(to_csv(record), "run.csv"), record);
  }
}

TEST(Csv, ReadsBackParametersAndStatesAtTheEndsOfTheRange) {
  drop::Parameters parameters;
  parameters.l = 0.1;
  parameters.mu = 0.0;
  parameters.eps = 1.0 / 3.0;
  parameters.delta = 5e-324;
  parameters.g = -0.0;
  parameters.columns = 3;
  const drop::Record record =
      drop::simulate_with_record({-0.0, 1e300, 1e-310}, {5e-324, -1e150, 1.0 / 3.0}, parameters);
  const drop::Record read = parse_record_csv(to_csv(record), "run.csv");
  test::expect_same(read, record);
  EXPECT_TRUE(test::same_bits(read.parameters.g, -0.0));
}

TEST(Csv, ReadsBackARunThatFailed) {
  const drop::Record record = test::failed_record();
  ASSERT_NE(record.trajectory.status, LcpStatus::solved);
  ASSERT_LT(record.trajectory.columns, record.parameters.columns);
  test::expect_same(parse_record_csv(to_csv(record), "run.csv"), record);

  drop::Record with_nan = record;
  with_nan.steps.back().residual = std::numeric_limits<double>::quiet_NaN();
  with_nan.steps.back().z[0] = std::numeric_limits<double>::infinity();
  test::expect_same(parse_record_csv(to_csv(with_nan), "run.csv"), with_nan);
}

TEST(Csv, LinesMayEndAsOnWindows) {
  const drop::Record record = test::course_record(3);
  std::string text;
  for (const char c : to_csv(record)) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  test::expect_same(parse_record_csv(text, "run.csv"), record);
}

TEST(Csv, RowsInPiecesAreTheWhole) {
  const drop::Record record = test::course_record(10);
  EXPECT_EQ(csv_header(record) + csv_rows(record, 0, 4) + csv_rows(record, 4, 10), to_csv(record));
}

TEST(Csv, RefusesEveryTruncation) {
  const std::string text = to_csv(test::course_record(4));
  for (std::size_t size = 0; size < text.size(); ++size) {
    EXPECT_THROW(parse_record_csv(std::string_view(text).substr(0, size), "run.csv"), std::invalid_argument) << size;
  }
}

TEST(Csv, AChangedByteIsRefusedOrANumberAndNeverACrash) {
  const std::string text = to_csv(test::course_record(3));
  std::size_t refused = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    for (const char c : {'\0', '\n', ',', 'x', '\xff', '-', '9'}) {
      std::string changed = text;
      changed[at] = c;
      try {
        parse_record_csv(changed, "run.csv");
      } catch (const std::invalid_argument& error) {
        ++refused;
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line";
      }
    }
  }
  EXPECT_GT(refused, 4 * text.size());
}

TEST(Csv, RefusesWithThePlace) {
  const std::string text = to_csv(test::course_record(3));
  EXPECT_TRUE(has(refusal(""), "run.csv:1:1: "));
  EXPECT_TRUE(has(refusal("time,x,y\n1,2,3\n"), "run.csv:1:1: expected '# tumble drop 1', got 'time,x,y'"));
  EXPECT_TRUE(
      has(refusal(replaced(text, "# mu = 0.3", "# mu = -1")), "run.csv:4:1: mu: must be finite and >= 0, got -1"));
  EXPECT_TRUE(has(refusal(replaced(text, "# m = 0.3", "# m = x")), "run.csv:3:7: m: expected a number, got 'x'"));
  EXPECT_TRUE(has(refusal(replaced(text, "# l = 0.2 m", "# l = 0.2 cm")), "run.csv:2:1: expected '# l = VALUE m'"));
  EXPECT_TRUE(has(refusal(replaced(text, "\n1,", "\n2,")), "run.csv:14:1: k: must be 1, got '2'"));
  EXPECT_TRUE(
      has(refusal(replaced(text, "\n1,0.01,", "\n1,0.02,")), "run.csv:14:3: t: must be k dt = 0.01, got '0.02'"));
  EXPECT_TRUE(has(refusal(replaced(text, ",1.5,", ",nan,")), "run.csv:13:7: y: must be finite, got 'nan'"));
  EXPECT_TRUE(has(refusal(replaced(text, ",open,", ",shut,")),
                  "mode: must be one of open, stick, slip left, slip right, got 'shut'"));
  EXPECT_TRUE(has(refusal(replaced(text, "open,solved,0,", "open,solved,inf,")), "residual: must be finite"));
  EXPECT_TRUE(has(refusal(replaced(text, "\n0,0,", "\n0,0,0,")), "run.csv:13:1: expected 19 columns, got 20"));
  EXPECT_TRUE(has(refusal(replaced(text, "\n0,0,0,1.5,", "\n0,0,1.5,")), "run.csv:13:1: expected 19 columns, got 18"));
  EXPECT_TRUE(has(refusal(text + "3\n"), "run.csv:16:1: expected the end of the file after 3 rows"));
  EXPECT_TRUE(has(refusal(replaced(text, "# rows = 3", "# rows = 4")), "rows: must be at most columns = 3, got 4"));
}

TEST(Csv, RefusesMoreRowsThanAllowedBeforeItAllocatesThem) {
  const std::string text = to_csv(test::course_record(3));
  EXPECT_TRUE(has(refusal(replaced(text, "# columns = 3", "# columns = 10000001")),
                  "columns: must be a whole number in [1, 10000000], got '10000001'"));
  const std::string large =
      replaced(replaced(text, "# columns = 3", "# columns = 10000000"), "# rows = 3", "# rows = 10000000");
  EXPECT_TRUE(has(refusal(large), "run.csv:10:1: rows: 10000000 rows are announced, but the file is too short"));
}

TEST(Csv, RefusesToWriteARecordThatDisagreesWithItself) {
  drop::Record record = test::course_record(3);
  record.steps.pop_back();
  EXPECT_THROW(to_csv(record), std::invalid_argument);
  record = test::course_record(3);
  record.trajectory.columns = 4;
  EXPECT_THROW(to_csv(record), std::invalid_argument);
  EXPECT_THROW(to_csv(drop::Record{}), std::invalid_argument);
}

}  // namespace
}  // namespace tumble::output
