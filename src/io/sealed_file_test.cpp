// SPDX-License-Identifier: Apache-2.0
#include "io/sealed_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "io/simrad/test_bytes.h"

namespace sonar {
namespace {

using Blocks = std::vector<std::vector<std::byte>>;

Blocks three_blocks() { return {std::vector(5, std::byte{7}), {}, std::vector(1000, std::byte{9})}; }

std::string content(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

bool whole(const std::filesystem::path& path) {
  const auto file = SealedFile::open(path, "key");
  if (!file || file->blocks() != 3) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (file->block(i) != three_blocks()[i]) return false;
  }
  return true;
}

TEST(SealedFile, GivesBackWhatWasStored) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "cache" / "a.echogram";
  EXPECT_FALSE(SealedFile::open(path, "key"));
  SealedFile::store(path, "key", three_blocks());
  EXPECT_TRUE(whole(path));
  EXPECT_FALSE(SealedFile::open(path, "key")->block(3));
  EXPECT_FALSE(SealedFile::open(path, "another key"));
  SealedFile::store(path, "another key", Blocks{});
  EXPECT_EQ(SealedFile::open(path, "another key")->blocks(), 0U);
  EXPECT_FALSE(SealedFile::open(path, "key"));
}

TEST(SealedFile, EveryChangedByteAndEveryCutIsNoticed) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "a";
  SealedFile::store(path, "key", three_blocks());
  const std::string bytes = content(path);
  for (std::size_t i = 0; i < bytes.size(); i += i < 150 ? 1 : 97) {
    std::string broken = bytes;
    broken[i] = static_cast<char>(broken[i] ^ 1);
    write(path, broken);
    EXPECT_FALSE(whole(path)) << i;
    write(path, bytes.substr(0, i));
    EXPECT_FALSE(whole(path)) << i;
  }
  write(path, bytes + "more");
  EXPECT_FALSE(whole(path));
  write(path, bytes);
  EXPECT_TRUE(whole(path));
}

TEST(SealedFile, APlaceThatCannotBeWrittenToIsNoError) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "file";
  write(file, "x");
  SealedFile::store(file / "not" / "possible", "key", three_blocks());
  EXPECT_FALSE(SealedFile::open(file / "not" / "possible", "key"));
}

}  // namespace
}  // namespace sonar
