#include "tumble/sweep/chunk_file.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "../temporary_folder.hpp"
#include <gtest/gtest.h>

#include "tumble/output/file.hpp"

namespace {

using namespace tumble::sweep;
namespace fs = std::filesystem;

constexpr ChunkId k_id = {77, 5};

class ChunkFile : public testing::Test {
 protected:
  void SetUp() override { write_chunk_file(path, k_id, parts); }

  const tumble::test::TemporaryFolder folder;
  const fs::path path = folder / "0.chunk";
  const std::vector<std::string> parts = {"first", "", std::string(40, 'x')};
};

TEST_F(ChunkFile, GivesBackWhatWasWritten) {
  EXPECT_EQ(fault_of_chunk_file(path, k_id, 3), std::nullopt);
  for (std::size_t k = 0; k < parts.size(); ++k) EXPECT_EQ(read_chunk_part(path, k_id, k), parts[k]);
}

TEST_F(ChunkFile, EveryDamagedByteIsFound) {
  const std::string bytes = tumble::output::read_file(path, 1 << 20);
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    std::string damaged = bytes;
    damaged[k] = static_cast<char>(damaged[k] ^ (1 << k % 8));
    tumble::output::write_file_atomically(path, damaged, true);
    EXPECT_TRUE(fault_of_chunk_file(path, k_id, 3)) << "byte " << k;
  }
}

TEST_F(ChunkFile, EveryLengthButItsOwnIsFound) {
  const std::string bytes = tumble::output::read_file(path, 1 << 20);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    tumble::output::write_file_atomically(path, bytes.substr(0, size), true);
    EXPECT_TRUE(fault_of_chunk_file(path, k_id, 3)) << size;
  }
  tumble::output::write_file_atomically(path, bytes + "x", true);
  EXPECT_TRUE(fault_of_chunk_file(path, k_id, 3));
}

TEST_F(ChunkFile, ThatOfAnotherSweepOrChunkIsFound) {
  const std::string name = path.string();
  EXPECT_EQ(fault_of_chunk_file(path, {78, 5}, 3), name + ": belongs to another sweep");
  EXPECT_EQ(fault_of_chunk_file(path, {77, 6}, 3), name + ": holds chunk 5");
  EXPECT_EQ(fault_of_chunk_file(path, k_id, 2), name + ": has 3 parts, not 2");
  fs::remove(path);
  EXPECT_EQ(fault_of_chunk_file(path, k_id, 3), name + ": cannot be opened");
}

TEST(ChunkBytes, KeepEveryValue) {
  const Column numbers = {"a", "", {0.0, -0.0, 0.1, std::numeric_limits<double>::infinity(), 5e-324}};
  EXPECT_EQ(from_bytes(to_bytes(numbers), false), numbers.values);
  EXPECT_TRUE(std::isnan(from_bytes(to_bytes({"a", "", {std::nan("")}}), false)[0]));
  const Column whole = {"b", "", {-1.0, 0.0, 2147483647.0}, true};
  EXPECT_EQ(to_bytes(whole).size(), 12u);
  EXPECT_EQ(from_bytes(to_bytes(whole), true), whole.values);
}

}  // namespace
