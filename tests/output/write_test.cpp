#include "tumble/output/write.hpp"

#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "../temporary_folder.hpp"
#include "record_samples.hpp"
#include <sys/stat.h>

#include "tumble/output/file.hpp"
#include "tumble/output/hdf5.hpp"
#include "tumble/output/mp4.hpp"

namespace tumble::output {
namespace {

namespace fs = std::filesystem;
using test::has;
using test::message_of;
using tumble::test::TemporaryFolder;

bool has_ffmpeg() {
  try {
    check_ffmpeg();
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

// Another PATH while it lives.
class PathOf {
 public:
  explicit PathOf(const std::string& path) : before_(std::getenv("PATH")) { ::setenv("PATH", path.c_str(), 1); }
  ~PathOf() { ::setenv("PATH", before_.c_str(), 1); }
  PathOf(const PathOf&) = delete;
  PathOf& operator=(const PathOf&) = delete;

 private:
  std::string before_;
};

void write_program(const fs::path& path, const std::string& text) {
  std::ofstream(path) << text;
  ASSERT_EQ(::chmod(path.c_str(), 0755), 0);
}

TEST(Write, EveryFormatAndReadsTheRecordsBack) {
  const TemporaryFolder folder;
  const drop::Record record = test::course_record(20);
  std::vector<std::string> endings = {"csv", "npz", "gif", "png", "svg", "CSV"};
  if (has_hdf5()) endings.push_back("h5");
  if (has_ffmpeg()) endings.push_back("mp4");
  for (const std::string& ending : endings) {
    const fs::path path = folder / ("run." + ending);
    write_record(record, path);
    EXPECT_GT(fs::file_size(path), 1000u) << ending;
    if (ending == "csv" || ending == "npz" || ending == "h5" || ending == "CSV") {
      test::expect_same(read_record(path), record);
    } else {
      EXPECT_THROW(read_record(path), std::invalid_argument);
    }
  }
  EXPECT_EQ(folder.count_files(), endings.size()) << "no temporary file is left";
}

TEST(Write, RefusesBeforeAnythingIsSimulated) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& name, const WriteOptions& options = {}) {
    const std::string text = message_of<std::invalid_argument>([&] { check_writable(folder / name, options); });
    EXPECT_EQ(text.find('\n'), std::string::npos);
    return text;
  };
  EXPECT_TRUE(has(refusal("run.txt"), "the name must end in .csv, .npz, .h5, .gif, .mp4, .png, .svg or .html"));
  EXPECT_TRUE(has(refusal("run"), "the name must end in"));
  EXPECT_TRUE(has(refusal("run.csv", {.format = "avi"}),
                  "format: must be csv, npz, h5, gif, mp4, png, svg or html, got 'avi'"));
  EXPECT_TRUE(has(refusal("none/run.csv"), "none cannot be used: No such file or directory"));
  EXPECT_TRUE(
      has(refusal("run.gif", {.width = 159}), "width: must be 0 (chosen for you) or in [160, 4096] px, got 159"));
  EXPECT_TRUE(has(refusal("run.gif", {.height = 5000}), "height: must be"));
  EXPECT_TRUE(has(refusal("run.gif", {.speed = -1.0}), "speed: must be finite and > 0, got -1"));
  write_file_atomically(folder / "old.csv", "x", false);
  EXPECT_TRUE(has(refusal("old.csv"), "old.csv: already exists"));
  EXPECT_NO_THROW(check_writable(folder / "old.csv", {.overwrite = true}));
  EXPECT_NO_THROW(check_writable(folder / "data", {.format = "npz"}));
  EXPECT_EQ(folder.count_files(), 1u) << "a check leaves nothing";
  drop::Parameters parameters;
  parameters.columns = 10'000;
  EXPECT_THROW(check_writable(folder / "run.gif", {}, parameters), std::invalid_argument);
  EXPECT_NO_THROW(check_writable(folder / "run.gif", {.speed = 2.0}, parameters));
  EXPECT_NO_THROW(check_writable(folder / "run.csv", {}, parameters));
}

TEST(Write, ToAFullDeviceFailsWithPathAndReason) {
  const TemporaryFolder folder;
  for (const char* name : {"full.csv", "full.npz", "full.png", "full.svg", "full.gif"}) {
    fs::create_symlink("/dev/full", folder / name);
    const std::string text =
        message_of<std::runtime_error>([&] { write_record(test::course_record(20), folder / name); });
    EXPECT_TRUE(has(text, name) && has(text, "No space left on device")) << text;
  }
}

TEST(Write, ARecordThatCannotBeDrawnLeavesNoFile) {
  const TemporaryFolder folder;
  for (const char* name : {"a.gif", "a.png", "a.mp4"}) {
    if (std::string(name) == "a.mp4" && !has_ffmpeg()) continue;
    drop::Record record = test::course_record(5);
    record.trajectory.q[0] = 1e200;
    EXPECT_THROW(write_record(record, folder / name), std::invalid_argument);
  }
  EXPECT_EQ(folder.count_files(), 0u);
}

TEST(Read, RefusesWhatIsNoRecord) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a.npz", "hello", false);
  EXPECT_TRUE(has(message_of<std::invalid_argument>([&] { read_record(folder / "a.npz"); }), "a.npz: is not a whole"));
  write_file_atomically(folder / "a.csv", "k,t\n", false);
  EXPECT_TRUE(has(message_of<std::invalid_argument>([&] { read_record(folder / "a.csv"); }), "a.csv:1:1: expected"));
  EXPECT_THROW(read_record(folder / "none.csv"), std::system_error);
  EXPECT_TRUE(has(message_of<std::invalid_argument>([&] { read_record(folder / "a.txt"); }),
                  "a record is read from a .csv, .npz or .h5 file"));
}

TEST(Mp4, AMissingFfmpegIsNamedWithItsPackage) {
  const TemporaryFolder folder;
  const PathOf path(folder.path().string());
  const std::string text = message_of<std::runtime_error>([&] { check_writable(folder / "run.mp4"); });
  EXPECT_TRUE(has(text, "needs the program ffmpeg") && has(text, "Debian's package ffmpeg")) << text;
}

TEST(Mp4, AnFfmpegThatFailsIsReportedWithItsLastWords) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "bin");
  write_program(folder / "bin/ffmpeg",
                "#!/bin/sh\nhead -c 1000 >/dev/null\necho first >&2\necho no such codec >&2\nexit 3\n");
  const PathOf path((folder / "bin").string() + ":" + std::getenv("PATH"));
  write_file_atomically(folder / "run.mp4", "old", false);
  const std::string text = message_of<std::runtime_error>(
      [&] { write_record(test::course_record(150), folder / "run.mp4", {.overwrite = true}); });
  EXPECT_TRUE(has(text, "run.mp4: ffmpeg failed (exit status 3): no such codec")) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos);
  EXPECT_EQ(read_file(folder / "run.mp4", 100), "old");
  EXPECT_EQ(folder.count_files(), 2u) << "no temporary file is left";
}

TEST(Mp4, AnFfmpegThatTalksWithoutEndDoesNotBlock) {
  const TemporaryFolder folder;
  write_program(folder / "ffmpeg",
                "#!/bin/sh\nhead -c 500000 /dev/zero | tr '\\0' 'x' >&2\ncat >/dev/null\necho the end >&2\nexit 1\n");
  const PathOf path(folder.path().string() + ":" + std::getenv("PATH"));
  const std::string text =
      message_of<std::runtime_error>([&] { write_record(test::course_record(10), folder / "run.mp4"); });
  EXPECT_TRUE(has(text, "the end")) << text;
}

TEST(Mp4, OddSizesAndPipesAreRefused) {
  if (!has_ffmpeg()) GTEST_SKIP();
  const TemporaryFolder folder;
  const std::string text =
      message_of<std::invalid_argument>([&] { check_writable(folder / "run.mp4", {.width = 641, .height = 400}); });
  EXPECT_TRUE(has(text, "width: must be even for an .mp4, got 641 px")) << text;
  EXPECT_NO_THROW(check_writable(folder / "run.mp4", {.width = 642}));
  EXPECT_THROW(check_writable("/dev/null", {.format = "mp4"}), std::invalid_argument);
}

TEST(Mp4, TakesNamesThatLookLikeSomethingElse) {
  if (!has_ffmpeg()) GTEST_SKIP();
  const TemporaryFolder folder;
  for (const char* name : {"-y.mp4", "pipe:1.mp4", "a b %d 'c'.mp4"}) {
    write_record(test::course_record(3), folder / name, {.width = 320, .height = 200});
    EXPECT_GT(fs::file_size(folder / name), 500u) << name;
  }
}

}  // namespace
}  // namespace tumble::output
