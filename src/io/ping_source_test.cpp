// SPDX-License-Identifier: Apache-2.0
#include "io/ping_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <memory>

#include "io/simrad/test_bytes.h"

namespace sonar {
namespace {

using test::Bytes;
using test::kStart;

/// A file in memory and its pings, to be written on.
struct Growing {
  std::shared_ptr<MemorySource> bytes = std::make_shared<MemorySource>("grows.raw");
  std::unique_ptr<PingSource> pings = ping_source(bytes);

  std::size_t add(const Bytes& more) {
    bytes->append(more.data);
    return pings->refresh().value();
  }
};

TEST(PingSource, PublishesAPingWithItsLastByte) {
  Growing file;
  file.add(test::con0(test::small_ms70()));
  Bytes ping = test::small_ping(kStart);
  Bytes last;
  last.put(static_cast<std::uint8_t>(ping.data.back()));
  ping.data.pop_back();
  EXPECT_EQ(file.add(ping), 0U);
  EXPECT_EQ(file.add(last), 1U);
  EXPECT_EQ(file.pings->header(0).time, kStart);
  BlockPool pool(0);
  const auto read = file.pings->read(0, pool);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->channels.size(), file.pings->index().configs.front()->beams.size());
  EXPECT_FALSE(file.pings->final());
}

TEST(PingSource, PublishesAPingThatLacksChannelsWhenTheNextBegins) {
  Growing file;
  file.add(test::con0(test::small_ms70()));
  EXPECT_EQ(file.add(test::raw0(kStart, {.channel = 1}, {1, 2, 3})), 0U);
  EXPECT_EQ(file.add(test::raw0(kStart + kSecondNs, {.channel = 1}, {1, 2, 3})), 1U);
  ASSERT_TRUE(file.pings->finish());
  EXPECT_EQ(file.pings->count(), 2U);
}

TEST(PingSource, APublishedPingDoesNotChangeWhenItsChannelsComeAgain) {
  Growing file;
  file.add(test::con0(test::small_ms70()));
  file.add(test::small_ping(kStart));
  const PingEntry before = file.pings->header(0);
  EXPECT_EQ(file.add(test::small_ping(kStart)), 0U);
  EXPECT_EQ(file.pings->header(0).end, before.end);
  EXPECT_EQ(file.pings->header(0).channels, before.channels);
  ASSERT_TRUE(file.pings->finish());
  EXPECT_EQ(file.pings->count(), 1U);
  EXPECT_FALSE(file.pings->index().diagnostics.empty());
}

TEST(GrowingFile, GoesOnWhenItIsThereAgain) {
  const test::TemporaryFolder folder;
  Bytes whole = test::con0(test::small_ms70());
  whole.add(test::small_ping(kStart));
  const auto path = folder.write("a.raw", whole);
  const auto pings = ping_source(growing_file(path));
  EXPECT_EQ(pings->refresh().value(), 1U);
  std::filesystem::rename(path, folder.path() / "away");
  EXPECT_EQ(pings->refresh().error().code, ErrorCode::not_found);
  EXPECT_EQ(pings->count(), 1U);
  std::filesystem::rename(folder.path() / "away", path);
  whole.add(test::small_ping(kStart + kSecondNs));
  (void)folder.write("a.raw", whole);
  EXPECT_EQ(pings->refresh().value(), 1U);
  EXPECT_EQ(pings->count(), 2U);
}

TEST(GrowingFile, ThatBecameShorterIsAnotherFile) {
  const test::TemporaryFolder folder;
  Bytes whole = test::con0(test::small_ms70());
  const auto path = folder.write("a.raw", whole.add(test::small_ping(kStart)));
  const auto pings = ping_source(growing_file(path));
  EXPECT_EQ(pings->refresh().value(), 1U);
  (void)folder.write("a.raw", test::con0(test::small_ms70()));
  EXPECT_EQ(pings->refresh().error().code, ErrorCode::mismatch);
}

}  // namespace
}  // namespace sonar
