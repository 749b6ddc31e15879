// SPDX-License-Identifier: Apache-2.0
#include "io/file_ends.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <vector>

#include "io/ping_source.h"
#include "io/simrad/test_bytes.h"

namespace sonar {
namespace {

using test::Bytes;
using test::kStart;

constexpr TimeNs kPingEvery_ns = 4 * kSecondNs;

Bytes fix(TimeNs time, int minute) {
  return test::nme0(time,
                    test::with_checksum(fmt::format("GPGGA,000000,60{:02d}.0000,N,00500.0000,E,1,,,,,,,,", minute)));
}

/// Pings of `samples` a channel, a fix before every `fix_every`th.
Bytes recording(int pings, int samples, int fix_every) {
  Bytes bytes = test::con0(test::small_ms70());
  const std::vector<std::int16_t> counts(static_cast<std::size_t>(samples), 7);
  for (int i = 0; i < pings; ++i) {
    const TimeNs time = kStart + i * kPingEvery_ns;
    if (i % fix_every == 0) bytes.add(fix(time, i % 60));
    for (int channel = 1; channel <= 6; ++channel) bytes.add(test::raw0(time, {.channel = channel}, counts));
  }
  return bytes;
}

/// Counts what is read of it.
class Counted final : public ByteSource {
 public:
  explicit Counted(const Bytes& bytes) : bytes_("counted.raw", bytes.data) {}
  [[nodiscard]] const std::string& name() const override { return bytes_.name(); }
  [[nodiscard]] Result<std::uint64_t> size() const override { return bytes_.size(); }
  [[nodiscard]] Result<std::size_t> read(std::uint64_t offset, std::span<std::byte> out) const override {
    auto got = bytes_.read(offset, out);
    if (got) read_ += *got;
    return got;
  }
  [[nodiscard]] std::uint64_t bytes_read() const { return read_; }

 private:
  MemorySource bytes_;
  mutable std::atomic<std::uint64_t> read_{0};
};

const NavSeries& positions(const RawIndex& index) {
  return *std::find_if(index.navigation.begin(), index.navigation.end(),
                       [](const NavSeries& s) { return s.quantity == NavQuantity::position; });
}

void expect_same_ends(const Bytes& bytes) {
  const Counted source(bytes);
  const auto whole = index_raw(source);
  const auto ends = index_ends(source);
  ASSERT_TRUE(whole && ends);
  EXPECT_EQ(ends->format, whole->format);
  EXPECT_EQ(ends->size, whole->size);
  ASSERT_EQ(ends->configs.size(), whole->configs.size());
  EXPECT_EQ(ends->configs.front()->beams.size(), whole->configs.front()->beams.size());
  EXPECT_EQ(ends->configs.front()->sounder_name, whole->configs.front()->sounder_name);
  ASSERT_FALSE(ends->pings.empty());
  EXPECT_EQ(ends->pings.front().time, whole->pings.front().time);
  EXPECT_EQ(ends->pings.back().time, whole->pings.back().time);
  EXPECT_EQ(positions(*ends).samples.front(), positions(*whole).samples.front());
  EXPECT_EQ(positions(*ends).samples.back(), positions(*whole).samples.back());
  EXPECT_TRUE(ends->diagnostics.empty());
}

TEST(FileEnds, TellWhatTheWholeFileTells) {
  expect_same_ends(recording(3, 10, 1));        // all of it is read
  expect_same_ends(recording(60, 10'000, 1));   // 7 MB
  expect_same_ends(recording(40, 60'000, 3));   // a ping is 720 kB: the last fix lies three of them before the end
  Bytes late = test::con0(test::small_ms70());  // 2 MB of what nobody knows before the first ping
  late.add(test::datagram("TAG0", kStart, Bytes().zeros(2'000'000))).add(recording(60, 10'000, 1));
  expect_same_ends(late);
}

TEST(FileEnds, AreReadAndNothingElse) {
  Bytes bytes = recording(200, 10'000, 1);  // 24 MB
  const Counted source(bytes);
  const auto ends = index_ends(source);
  ASSERT_TRUE(ends);
  EXPECT_LT(source.bytes_read(), 1'500'000U);
  // Whatever stands between them.
  std::fill(bytes.data.begin() + 1'000'000, bytes.data.end() - 1'000'000, std::byte{0x5A});
  const auto holed = index_ends(MemorySource("holed.raw", bytes.data));
  ASSERT_TRUE(holed);
  EXPECT_EQ(holed->pings.back().time, kStart + 199 * kPingEvery_ns);
}

TEST(FileEnds, AFileThatWasCutOffInWritingEndsWithItsLastWholeDatagram) {
  Bytes bytes = recording(200, 10'000, 1);
  bytes.data.resize(bytes.data.size() - 777);
  const auto ends = index_ends(MemorySource("cut.raw", bytes.data));
  ASSERT_TRUE(ends);
  EXPECT_EQ(ends->pings.back().time, kStart + 199 * kPingEvery_ns);
}

// A ping is 720 kB: no fix stands in what lies behind the last one.
TEST(FileEnds, OfAFileThatWasCutOffTheLastPositionIsToldToo) {
  const Bytes whole = recording(40, 60'000, 1);
  for (const std::size_t cut : {1U, 777U, 100'000U}) {
    Bytes bytes = whole;
    bytes.data.resize(bytes.data.size() - cut);
    const Counted source(bytes);
    const auto ends = index_ends(source);
    ASSERT_TRUE(ends);
    EXPECT_EQ(ends->pings.back().time, kStart + 39 * kPingEvery_ns);
    EXPECT_EQ(positions(*ends).samples.back(),
              positions(*index_raw(MemorySource("cut.raw", bytes.data))).samples.back());
    EXPECT_LT(source.bytes_read(), 8'000'000U) << cut;  // every pair of equal counts may be a length
  }
}

TEST(FileEnds, ASecondReceiverThatSpeaksLastIsNotTheOnlyOneHeard) {
  Bytes bytes = recording(200, 10'000, 1);
  bytes.add(
      test::nme0(kStart + 800 * kSecondNs, test::with_checksum("INGGA,000000,6100.0000,N,00500.0000,E,1,,,,,,,,")));
  const auto ends = index_ends(MemorySource("two.raw", bytes.data));
  ASSERT_TRUE(ends);
  const auto whole = index_raw(MemorySource("two.raw", bytes.data));
  EXPECT_EQ(positions(*ends).talker, "GP");
  EXPECT_EQ(positions(*ends).samples.back(), positions(*whole).samples.back());
}

TEST(FileEnds, WhereNobodyTellsPositionsLittleMoreIsRead) {
  const Bytes bytes = recording(200, 10'000, 1000);
  Bytes silent = test::con0(test::small_ms70());
  silent.data.insert(silent.data.end(), bytes.data.end() - 20'000'000, bytes.data.end());
  const Counted source(silent);
  ASSERT_TRUE(index_ends(source));
  EXPECT_LT(source.bytes_read(), 6'000'000U);
}

TEST(FileEnds, LyingLengthWordsAtTheEndCostNothing) {
  Bytes bytes = recording(200, 10'000, 1);
  for (const std::int32_t lie : {-1, 0, 11, 12, 13, 1 << 26, 0x7FFFFFFF, 120'000}) {
    Bytes lying = bytes;
    lying.put(lie);
    const Counted source(lying);
    const auto ends = index_ends(source);
    ASSERT_TRUE(ends) << lie;
    EXPECT_EQ(ends->pings.back().time, kStart + 199 * kPingEvery_ns) << lie;
    EXPECT_LT(source.bytes_read(), 3'000'000U) << lie;
  }
}

TEST(FileEnds, OfWhatIsNoRecordingAreToldAsSuch) {
  const auto text = index_ends(MemorySource("notes.raw", Bytes().text("Dear diary", 40).data));
  ASSERT_TRUE(text);
  EXPECT_EQ(text->format, RawFormat::unknown);
  EXPECT_EQ(text->diagnostics.size(), 1U);
  const auto nothing = index_ends(MemorySource("empty.raw", {}));
  ASSERT_TRUE(nothing);
  EXPECT_EQ(nothing->format, RawFormat::unknown);
}

}  // namespace
}  // namespace sonar
