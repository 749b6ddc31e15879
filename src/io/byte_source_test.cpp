// SPDX-License-Identifier: Apache-2.0
#include "io/byte_source.h"

#include <gtest/gtest.h>

#include <array>

#include "io/block_pool.h"
#include "io/simrad/test_bytes.h"

namespace sonar {
namespace {

TEST(ByteSource, MemoryGrowsAndReadsShortOnlyAtItsEnd) {
  MemorySource source("memory", std::as_bytes(std::span("abc", 3)));
  std::array<std::byte, 4> out{};
  EXPECT_EQ(source.read(1, out).value(), 2U);
  EXPECT_EQ(out[0], std::byte{'b'});
  source.append(std::as_bytes(std::span("de", 2)));
  EXPECT_EQ(source.size().value(), 5U);
  EXPECT_EQ(source.read(1, out).value(), 4U);
  EXPECT_EQ(out[3], std::byte{'e'});
  EXPECT_EQ(source.read(99, out).value(), 0U);
}

TEST(ByteSource, FileSeesWhatIsAppendedLater) {
  const test::TemporaryFolder folder;
  test::Bytes bytes;
  const auto path = folder.write("grows.raw", bytes.text("abc", 3));
  const auto source = open_file(path);
  ASSERT_TRUE(source);
  EXPECT_EQ((*source)->size().value(), 3U);
  std::ofstream(path, std::ios::app) << "de";
  std::array<std::byte, 8> out{};
  EXPECT_EQ((*source)->size().value(), 5U);
  EXPECT_EQ((*source)->read(3, out).value(), 2U);
  EXPECT_EQ(out[1], std::byte{'e'});
}

TEST(ByteSource, MissingFileAndFolderAreErrors) {
  const test::TemporaryFolder folder;
  const auto missing = open_file(folder.path() / "none.raw");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::not_found);
  const auto is_folder = open_file(folder.path());
  ASSERT_FALSE(is_folder);
  EXPECT_EQ(is_folder.error().code, ErrorCode::io);
}

TEST(BlockPool, GivesReturnedBlocksOutAgain) {
  BlockPool pool;
  const std::byte* first = pool.take(1000).get();
  EXPECT_EQ(pool.take(2000).get(), first);
}

TEST(BlockPool, BlocksOutliveThePool) {
  std::shared_ptr<std::byte[]> block;
  {
    BlockPool pool;
    block = pool.take(10);
  }
  block[9] = std::byte{1};
  EXPECT_EQ(block[9], std::byte{1});
}

}  // namespace
}  // namespace sonar
