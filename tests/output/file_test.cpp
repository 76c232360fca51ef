#include "tumble/output/file.hpp"

#include <csignal>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <vector>

#include "../temporary_folder.hpp"
#include "record_samples.hpp"
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tumble::output {
namespace {

namespace fs = std::filesystem;
using test::has;
using test::message_of;
using tumble::test::TemporaryFolder;

std::string content(const fs::path& path) { return read_file(path, 1 << 24); }

TEST(File, IsWrittenAndReadBack) {
  const TemporaryFolder folder;
  const std::string bytes = std::string("a\0b\n", 4) + std::string(300'000, 'x');
  write_file_atomically(folder / "a.csv", bytes, false);
  EXPECT_EQ(content(folder / "a.csv"), bytes);
  EXPECT_EQ(folder.count_files(), 1u) << "no temporary file is left";
}

TEST(File, IsOnlyOverwrittenOnDemand) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a.csv", "old", false);
  const std::string text =
      message_of<std::invalid_argument>([&] { write_file_atomically(folder / "a.csv", "new", false); });
  EXPECT_TRUE(has(text, "a.csv: already exists")) << text;
  EXPECT_EQ(content(folder / "a.csv"), "old");
  write_file_atomically(folder / "a.csv", "new", true);
  EXPECT_EQ(content(folder / "a.csv"), "new");
  EXPECT_EQ(folder.count_files(), 1u);
}

TEST(File, OneThatAppearsMeanwhileIsNotOverwritten) {
  const TemporaryFolder folder;
  {
    OutputFile file(folder / "a.csv", false);
    file.write("mine");
    std::ofstream(folder / "a.csv") << "theirs";
    EXPECT_THROW(file.commit(), std::invalid_argument);
  }
  EXPECT_EQ(content(folder / "a.csv"), "theirs");
  EXPECT_EQ(folder.count_files(), 1u);
}

TEST(File, WithoutCommitNothingIsLeft) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a.csv", "old", false);
  {
    OutputFile file(folder / "a.csv", true);
    file.write("half");
  }
  EXPECT_EQ(content(folder / "a.csv"), "old");
  EXPECT_EQ(folder.count_files(), 1u);
}

TEST(File, HasTheModeOfTheUmaskOrOfItsPredecessor) {
  const TemporaryFolder folder;
  const auto mode = [&](const char* name) {
    struct stat info {};
    EXPECT_EQ(::stat((folder / name).c_str(), &info), 0);
    return info.st_mode & 07777;
  };
  const mode_t before = ::umask(027);
  write_file_atomically(folder / "a.csv", "x", false);
  ::umask(before);
  EXPECT_EQ(mode("a.csv"), 0640u);
  ASSERT_EQ(::chmod((folder / "a.csv").c_str(), 0604), 0);
  write_file_atomically(folder / "a.csv", "y", true);
  EXPECT_EQ(mode("a.csv"), 0604u);
}

// The limit on the size of files acts like a disk that is full, in the middle of the writing.
TEST(File, AFullDiskLeavesTheOldFile) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a.csv", "old", false);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{100'000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string text =
      message_of<std::runtime_error>([&] { write_file_atomically(folder / "a.csv", std::string(200'000, 'x'), true); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_TRUE(has(text, "cannot write ") && has(text, "a.csv: File too large")) << text;
  EXPECT_EQ(content(folder / "a.csv"), "old");
  EXPECT_EQ(folder.count_files(), 1u);
}

TEST(File, DevicesAreWrittenToDirectly) {
  EXPECT_NO_THROW(write_file_atomically("/dev/null", "x", false));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  const std::string text = message_of<std::system_error>([] { write_file_atomically("/dev/full", "x", false); });
  EXPECT_EQ(text, "cannot write /dev/full: No space left on device");
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

// Opening a named pipe would wait for somebody to read it.
TEST(File, ANamedPipeOrSocketIsRefused) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe.csv").c_str(), 0600), 0);
  fs::create_symlink("pipe.csv", folder / "link.csv");
  for (const char* name : {"pipe.csv", "link.csv"}) {
    for (const bool overwrite : {false, true}) {
      const std::string text =
          message_of<std::invalid_argument>([&] { write_file_atomically(folder / name, "x", overwrite); });
      EXPECT_TRUE(has(text, "is a named pipe, a socket or a block device")) << text;
    }
  }
  EXPECT_TRUE(fs::is_fifo(folder / "pipe.csv"));
  EXPECT_EQ(folder.count_files(), 2u);
}

// Killed in the middle of the writing, by a signal that leaves no time to clean up.
TEST(File, AKilledProcessLeavesNothing) {
  const TemporaryFolder folder;
  const int probe = ::open(folder.path().c_str(), O_TMPFILE | O_RDWR, 0600);
  if (probe < 0) GTEST_SKIP() << "the file system of the temporary folder has no files without a name";
  ::close(probe);
  write_file_atomically(folder / "old.csv", "old", false);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    OutputFile replaced(folder / "old.csv", true);
    OutputFile made(folder / "new.csv", false);
    replaced.write("half");
    made.write("half");
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(content(folder / "old.csv"), "old");
  EXPECT_EQ(folder.count_files(), 1u);
}

TEST(File, APipeIsWrittenToAndItsEndIsAnError) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  const fs::path path = "/dev/fd/" + std::to_string(ends[1]);
  write_file_atomically(path, "hello", false);
  std::array<char, 8> got{};
  EXPECT_EQ(::read(ends[0], got.data(), got.size()), 5);
  EXPECT_EQ(std::string(got.data()), "hello");
  OutputFile file(path, false);
  ::close(ends[0]);
  const std::string text = message_of<std::system_error>([&] { file.write("lost"); });
  EXPECT_TRUE(has(text, "Broken pipe")) << text;
  ::close(ends[1]);
}

TEST(File, ALinkStaysAndItsTargetIsReplaced) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "inner");
  write_file_atomically(folder / "inner/real.csv", "old", false);
  fs::create_symlink("inner/real.csv", folder / "link.csv");
  EXPECT_THROW(write_file_atomically(folder / "link.csv", "new", false), std::invalid_argument);
  write_file_atomically(folder / "link.csv", "new", true);
  EXPECT_TRUE(fs::is_symlink(folder / "link.csv"));
  EXPECT_EQ(content(folder / "inner/real.csv"), "new");

  fs::create_symlink("inner/new.csv", folder / "dangling.csv");
  write_file_atomically(folder / "dangling.csv", "made", false);
  EXPECT_TRUE(fs::is_symlink(folder / "dangling.csv"));
  EXPECT_EQ(content(folder / "inner/new.csv"), "made");

  fs::create_symlink("round.csv", folder / "round.csv");
  EXPECT_THROW(write_file_atomically(folder / "round.csv", "x", true), std::system_error);
}

TEST(File, AnOpenDescriptorOfARegularFileKeepsItsFile) {
  const TemporaryFolder folder;
  const int descriptor = ::open((folder / "a.csv").c_str(), O_RDWR | O_CREAT, 0666);
  ASSERT_GE(descriptor, 0);
  write_file_atomically("/dev/fd/" + std::to_string(descriptor), "through", false);
  std::array<char, 16> got{};
  EXPECT_EQ(::pread(descriptor, got.data(), got.size(), 0), 7) << "not replaced by another file";
  ::close(descriptor);
}

TEST(File, RefusesWhatCannotBeATarget) {
  const TemporaryFolder folder;
  const auto refusal = [](const fs::path& path) {
    return message_of<std::invalid_argument>([&] { check_target(path, false); });
  };
  EXPECT_TRUE(has(refusal(folder.path()), "is a folder"));
  EXPECT_TRUE(has(refusal(folder / "none/a.csv"), "No such file or directory"));
  EXPECT_TRUE(has(refusal(""), "empty"));
  write_file_atomically(folder / "plain", "x", false);
  EXPECT_TRUE(has(refusal(folder / "plain/a.csv"), "Not a directory"));
  EXPECT_TRUE(has(refusal(folder / (std::string(300, 'a') + ".csv")), "File name too long"));
  EXPECT_NO_THROW(check_target(folder / (std::string(251, 'a') + ".csv"), false));
  EXPECT_NO_THROW(write_file_atomically(folder / (std::string(251, 'a') + ".csv"), "x", false));
  EXPECT_EQ(folder.count_files(), 2u);
}

TEST(File, ManyThreadsWriteWithoutDisturbingEachOther) {
  const TemporaryFolder folder;
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&, i] {
      for (int k = 0; k < 20; ++k) write_file_atomically(folder / "same.csv", std::string(10'000, char('a' + i)), true);
    });
  }
  for (std::thread& thread : threads) thread.join();
  const std::string bytes = content(folder / "same.csv");
  EXPECT_EQ(bytes, std::string(10'000, bytes.at(0))) << "a whole file of one of the threads";
  EXPECT_EQ(folder.count_files(), 1u);
}

TEST(File, ReadingIsCapped) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a.csv", "12345", false);
  EXPECT_EQ(read_file(folder / "a.csv", 5), "12345");
  EXPECT_THROW(read_file(folder / "a.csv", 4), std::invalid_argument);
  EXPECT_THROW(read_file("/dev/zero", 100'000), std::invalid_argument);
  const std::string missing = message_of<std::system_error>([&] { read_file(folder / "no.csv", 4); });
  EXPECT_TRUE(has(missing, "no.csv: No such file or directory")) << missing;
  EXPECT_THROW(read_file(folder.path(), 4), std::system_error);
}

}  // namespace
}  // namespace tumble::output
