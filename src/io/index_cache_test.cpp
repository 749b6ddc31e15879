// SPDX-License-Identifier: Apache-2.0
#include "io/index_cache.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "io/ping_source.h"
#include "io/simrad/test_bytes.h"

namespace sonar {
namespace {

Result<RawIndex> opened(const std::filesystem::path& path, const IndexCache& cache) {
  Work work(1);
  return open_index(path, cache, work);
}

namespace fs = std::filesystem;

std::vector<fs::path> entries(const fs::path& folder) {
  std::vector<fs::path> list;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) list.push_back(entry.path());
  return list;
}

TEST(IndexCache, EncodesAndDecodesToTheSame) {
  const MemorySource source("memory", test::small_file(3).data);
  const auto index = index_raw(source);
  ASSERT_TRUE(index);
  const auto bytes = encode_index(*index);
  const auto decoded = decode_index(bytes);
  ASSERT_TRUE(decoded);
  EXPECT_EQ(encode_index(*decoded), bytes);
  EXPECT_EQ(decoded->pings.size(), 3U);
  EXPECT_EQ(decoded->configs.at(0)->beams.at(5).direction_deg[1], 2.5);
  EXPECT_EQ(decoded->navigation, index->navigation);
}

TEST(IndexCache, BrokenBytesAreNoIndex) {
  const MemorySource source("memory", test::small_file(1).data);
  auto bytes = encode_index(index_raw(source).value());
  for (std::size_t size : {std::size_t{0}, std::size_t{5}, std::size_t{30}, bytes.size() - 1}) {
    EXPECT_FALSE(decode_index(std::span(bytes).first(size)));
  }
  for (std::size_t i = 0; i < bytes.size(); i += 7) {
    bytes[i] ^= std::byte{1};
    EXPECT_FALSE(decode_index(bytes)) << i;
    bytes[i] ^= std::byte{1};
  }
  EXPECT_TRUE(decode_index(bytes));
}

TEST(IndexCache, SecondOpeningDoesNotReadTheFile) {
  const test::TemporaryFolder folder;
  const IndexCache cache{folder.path() / "cache"};
  const auto path = folder.write("a.raw", test::small_file(3));
  const auto first = opened(path, cache);
  ASSERT_TRUE(first);
  ASSERT_EQ(entries(cache.folder).size(), 1U);
  // Same size and time of change, other bytes: only a reading of the file could tell.
  const auto changed = fs::last_write_time(path);
  folder.write("a.raw", test::small_file(3, test::kStart + 500 * kSecondNs));
  fs::last_write_time(path, changed);
  const auto second = opened(path, cache);
  ASSERT_TRUE(second);
  EXPECT_EQ(encode_index(*second), encode_index(*first));
  EXPECT_EQ(second->name, path.string());
}

TEST(IndexCache, ChangedFileIsReadAgain) {
  const test::TemporaryFolder folder;
  const IndexCache cache{folder.path() / "cache"};
  const auto path = folder.write("a.raw", test::small_file(1));
  ASSERT_TRUE(opened(path, cache));
  folder.write("a.raw", test::small_file(2));
  EXPECT_EQ(opened(path, cache).value().pings.size(), 2U);
}

TEST(IndexCache, BrokenEntryIsMadeAgain) {
  const test::TemporaryFolder folder;
  const IndexCache cache{folder.path() / "cache"};
  const auto path = folder.write("a.raw", test::small_file(2));
  ASSERT_TRUE(opened(path, cache));
  const fs::path entry = entries(cache.folder).at(0);
  fs::resize_file(entry, fs::file_size(entry) / 2);
  EXPECT_EQ(opened(path, cache).value().pings.size(), 2U);
  std::ofstream(entry) << "nonsense";
  EXPECT_EQ(opened(path, cache).value().pings.size(), 2U);
}

TEST(IndexCache, FolderThatCannotBeMadeIsNoError) {
  const test::TemporaryFolder folder;
  const auto path = folder.write("a.raw", test::small_file(2));
  EXPECT_EQ(opened(path, IndexCache{path / "not" / "possible"}).value().pings.size(), 2U);
  EXPECT_EQ(opened(path, IndexCache{}).value().pings.size(), 2U);
  EXPECT_EQ(entries(folder.path()).size(), 1U);
}

TEST(ContentHash, DoesNotDependOnTheName) {
  const test::TemporaryFolder folder;
  const auto a = opened(folder.write("a.raw", test::small_file(2)), {});
  const auto b = opened(folder.write("b.raw", test::small_file(2)), {});
  const auto c = opened(folder.write("c.raw", test::small_file(2, test::kStart + kSecondNs)), {});
  EXPECT_EQ(a.value().hash, b.value().hash);
  EXPECT_NE(a.value().hash, c.value().hash);
  EXPECT_EQ(a.value().hash.size(), 32U);
}

TEST(ContentHash, SeesAChangeAnywhere) {
  std::vector<std::byte> bytes(5U << 20U);
  const auto hash = [&] { return index_raw(MemorySource("a", bytes))->hash; };
  const std::string before = hash();
  bytes[bytes.size() / 2] = std::byte{1};
  EXPECT_NE(hash(), before);
}
TEST(IndexCache, ReadingStopsWhenItIsAskedTo) {
  const test::TemporaryFolder folder;
  const auto path = folder.write("a.raw", test::small_file(2));
  Work work(1);
  work.cancel();
  EXPECT_EQ(open_index(path, {}, work).error().code, ErrorCode::cancelled);
}

TEST(IndexCache, EqualSettingsAreHeldOnce) {
  const test::TemporaryFolder folder;
  auto a = opened(folder.write("a.raw", test::small_file(2)), {});
  auto b = opened(folder.write("b.raw", test::small_file(3)), {});
  ASSERT_TRUE(a && b);
  SharedSettings settings;
  settings.share(*a);
  settings.share(*b);
  EXPECT_EQ(&*a->configs[0], &*b->configs[0]);
  EXPECT_EQ(&*a->transmits[0], &*b->transmits[0]);
  const std::string name = b->configs[0]->survey_name;
  a->configs[0].edit().survey_name = "another";  // one's own from now on
  EXPECT_EQ(b->configs[0]->survey_name, name);
  auto other = opened(folder.write("c.raw", test::small_file(2)), {});
  other->configs[0].edit().survey_name = "other";
  settings.share(*other);
  EXPECT_NE(&*other->configs[0], &*b->configs[0]);
}

}  // namespace
}  // namespace sonar
