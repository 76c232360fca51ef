#include "tumble/output/npz.hpp"

#include <limits>
#include <stdexcept>

#include "record_samples.hpp"

#include "tumble/output/file.hpp"
#include "tumble/output/zip.hpp"

namespace tumble::output {
namespace {

using test::has;
using test::message_of;

std::string refusal(const std::string& bytes) {
  return message_of<std::invalid_argument>([&] { parse_record_npz(bytes, "run.npz"); });
}

std::filesystem::path data_folder() { return TUMBLE_SOURCE "/tests/output/data"; }

TEST(Npz, ReadsBackTheSameBits) {
  for (const int columns : {2, 3, 150}) {
    const drop::Record record = test::course_record(columns);
    test::expect_same(parse_record_npz(to_npz(record), "run.npz"), record);
  }
}

TEST(Npz, ReadsBackARunThatFailed) {
  drop::Record record = test::failed_record();
  record.steps.back().residual = std::numeric_limits<double>::quiet_NaN();
  test::expect_same(parse_record_npz(to_npz(record), "run.npz"), record);
}

TEST(Npz, TheSameRecordGivesTheSameBytes) {
  EXPECT_TRUE(to_npz(test::course_record(20)) == to_npz(test::course_record(20)));
}

// Made with numpy 1.24: q, v and the parameters of course_record(40) alone, a free fall; in the first file
// stored, q in Fortran order, m as big-endian, columns as int64 and an array of foreign name beside them; in
// the second compressed.
//   d = np.load("run.npz"); keys = ["l", "m", "mu", "eps", "dt", "delta", "g"]; p = {k: d[k] for k in keys}
//   np.savez("numpy_stored.npz", q=np.asfortranarray(d["q"]), v=d["v"], columns=np.int64(40),
//   note=np.arange(3),
//            **{**p, "m": d["m"].astype(">f8")})
//   np.savez_compressed("numpy_compressed.npz", q=d["q"], v=d["v"], **p)
TEST(Npz, ReadsWhatNumpySavedAndCompletesIt) {
  for (const char* name : {"numpy_stored.npz", "numpy_compressed.npz"}) {
    const std::string bytes = read_file(data_folder() / name, 1 << 20);
    test::expect_same(parse_record_npz(bytes, name), test::course_record(40));
  }
}

TEST(Npz, RefusesEveryTruncation) {
  const std::string bytes = to_npz(test::course_record(2));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_THROW(parse_record_npz(std::string_view(bytes).substr(0, size), "run.npz"), std::invalid_argument) << size;
  }
}

TEST(Npz, AChangedByteNeverChangesANumber) {
  const drop::Record record = test::course_record(2);
  const std::string bytes = to_npz(record);
  std::size_t refused = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    for (const int flip : {0x01, 0x80, 0xff}) {
      std::string changed = bytes;
      changed[at] = static_cast<char>(changed[at] ^ flip);
      try {
        test::expect_same(parse_record_npz(changed, "run.npz"), record);  // the byte was not one that counts
      } catch (const std::invalid_argument& error) {
        ++refused;
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line";
      }
    }
  }
  EXPECT_GT(refused, bytes.size());
}

std::string with_entry(const std::string& left_out, const std::string& name, const std::string& content) {
  const std::string bytes = to_npz(test::course_record(2));
  ZipWriter zip;
  for (const ZipEntry& entry : read_zip_directory(bytes, "run.npz")) {
    if (entry.name != left_out) zip.add(entry.name, extract(entry, 1 << 20, "run.npz"));
  }
  if (!name.empty()) zip.add(name, content);
  return zip.finish();
}

std::string npy(const std::string& dictionary, std::size_t content_bytes) {
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(dictionary.size() & 0xff);
  bytes += static_cast<char>(dictionary.size() >> 8);
  return bytes + dictionary + std::string(content_bytes, '\0');
}

TEST(Npz, NamesTheArrayAtFault) {
  EXPECT_EQ(refusal(with_entry("mu.npy", "", "")),
            "run.npz: mu: is missing; a record of the drop has q, v, l, m, mu, eps, dt, delta and g");
  EXPECT_TRUE(
      has(refusal(with_entry("q.npy", "q.npy", npy("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }", 48))),
          "run.npz: q: must have shape (3, 3), got (2, 3)"));
  EXPECT_TRUE(
      has(refusal(with_entry("q.npy", "q.npy", npy("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 0), }", 0))),
          "run.npz: q: must have 1 to 10000000 columns, got 0"));
  EXPECT_TRUE(
      has(refusal(with_entry("l.npy", "l.npy", npy("{'descr': '<f8', 'fortran_order': False, 'shape': (), }", 8))),
          "run.npz: l: must be finite and > 0, got 0 m"));
  EXPECT_TRUE(
      has(refusal(with_entry("l.npy", "l.npy", npy("{'descr': '|O', 'fortran_order': False, 'shape': (), }", 8))),
          "run.npz: l: must hold"));
  EXPECT_TRUE(has(refusal(with_entry("", "q.npy", "")), "run.npz: q: is there twice"));
  EXPECT_TRUE(has(refusal("hello"), "run.npz: is not a whole zip archive"));
}

TEST(Npz, RefusesSizesBeforeItAllocatesThem) {
  EXPECT_TRUE(has(refusal(with_entry("q.npy", "q.npy",
                                     npy("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 99999999999), }", 8))),
                  "q: is too large"));
  EXPECT_TRUE(
      has(refusal(with_entry("q.npy", "q.npy",
                             npy("{'descr': '<f8', 'fortran_order': False, 'shape': (4294967296, 4294967296), }", 8))),
          "q: is too large"));
  // An entry that announces 300 MB, with nothing behind it.
  std::string bytes = to_npz(test::course_record(2));
  const std::size_t directory = bytes.find("PK\x01\x02");
  ASSERT_NE(directory, std::string::npos);
  bytes[bytes.find("q.npy", directory) - 46 + 27] = '\x12';
  EXPECT_TRUE(has(refusal(bytes), "q.npy: announces more bytes than it can hold"));
}

TEST(Npz, RecomputesTheStepsWhereOneOfTheirArraysIsAbsent) {
  test::expect_same(parse_record_npz(with_entry("z.npy", "", ""), "run.npz"), test::course_record(2));
}

TEST(Zip, HoldsEmptyAndIncompressibleContent) {
  std::string noise;
  unsigned state = 1;
  for (int i = 0; i < 100'000; ++i) noise += static_cast<char>((state = state * 1664525u + 1013904223u) >> 24);
  ZipWriter zip;
  zip.add("empty", "");
  zip.add("noise", noise);
  const std::string bytes = zip.finish();
  const std::vector<ZipEntry> entries = read_zip_directory(bytes, "a.zip");
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(extract(entries[0], 10, "a.zip"), "");
  EXPECT_EQ(extract(entries[1], noise.size(), "a.zip"), noise);
  EXPECT_THROW(extract(entries[1], noise.size() - 1, "a.zip"), std::invalid_argument);
}

}  // namespace
}  // namespace tumble::output
