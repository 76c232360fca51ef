#include "tumble/output/hdf5.hpp"

#include <stdexcept>

#include "record_samples.hpp"

namespace tumble::output {
namespace {

TEST(Hdf5, ABuildWithoutItSaysSo) {
  if (has_hdf5()) {
    EXPECT_NO_THROW(check_hdf5());
    return;
  }
  const std::string text = test::message_of<std::runtime_error>([] { to_hdf5(test::course_record(2)); });
  EXPECT_TRUE(test::has(text, "this build has no HDF5"));
  EXPECT_THROW(check_hdf5(), std::runtime_error);
}

TEST(Hdf5, ReadsBackTheSameBits) {
  if (!has_hdf5()) GTEST_SKIP() << "built without HDF5, which is optional";
  for (const int columns : {2, 150, 5000}) {
    const drop::Record record = test::course_record(columns);
    test::expect_same(parse_record_hdf5(to_hdf5(record), "run.h5"), record);
  }
  test::expect_same(parse_record_hdf5(to_hdf5(test::failed_record()), "run.h5"), test::failed_record());
}

TEST(Hdf5, TheSameRecordGivesTheSameBytes) {
  if (!has_hdf5()) GTEST_SKIP() << "built without HDF5, which is optional";
  EXPECT_TRUE(to_hdf5(test::course_record(20)) == to_hdf5(test::course_record(20)));
}

TEST(Hdf5, RefusesTruncatedAndForeignBytes) {
  if (!has_hdf5()) GTEST_SKIP() << "built without HDF5, which is optional";
  const std::string bytes = to_hdf5(test::course_record(20));
  for (std::size_t size = 0; size < bytes.size(); size += 97) {
    EXPECT_THROW(parse_record_hdf5(bytes.substr(0, size), "run.h5"), std::invalid_argument) << size;
  }
  const std::string text =
      test::message_of<std::invalid_argument>([] { parse_record_hdf5("hello, not HDF5 at all", "run.h5"); });
  EXPECT_TRUE(test::has(text, "run.h5: is not a whole HDF5 file"));
}

}  // namespace
}  // namespace tumble::output
