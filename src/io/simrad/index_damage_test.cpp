// SPDX-License-Identifier: Apache-2.0
#include "io/raw_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <string_view>

#include "io/index_cache.h"
#include "io/ping_source.h"
#include "io/simrad/datagram.h"
#include "io/simrad/test_bytes.h"

namespace sonar {
namespace {

using test::Bytes;
using test::kStart;

RawIndex index_of(const Bytes& bytes) {
  const MemorySource source("memory", bytes.data);
  auto index = index_raw(source);
  EXPECT_TRUE(index);
  return index ? std::move(*index) : RawIndex{};
}

std::vector<DiagnosticCode> codes(const RawIndex& index) {
  std::vector<DiagnosticCode> list;
  for (const Diagnostic& note : index.diagnostics) list.push_back(note.code);
  return list;
}

using Codes = std::vector<DiagnosticCode>;

TEST(RawDamage, FileEndsInsideADatagram) {
  Bytes bytes = test::small_file(2);
  const std::size_t last = bytes.size();
  bytes.add(test::small_ping(kStart + 10 * kSecondNs));
  bytes.data.resize(last + 50);
  const RawIndex index = index_of(bytes);
  EXPECT_EQ(codes(index), Codes{DiagnosticCode::file_truncated});
  EXPECT_EQ(index.diagnostics[0].offset, static_cast<std::int64_t>(last));
  EXPECT_EQ(index.pings.size(), 2U);
}

/// Damages the second datagram of the second ping and expects everything else to be read.
RawIndex with_damage(void (*damage)(Bytes&, std::size_t), std::size_t* place = nullptr) {
  Bytes bytes = test::small_file(1);
  const std::size_t at = bytes.size() + test::raw0(kStart, {.channel = 1}, {1}).size();
  bytes.add(test::raw0(kStart + kSecondNs, {.channel = 1}, {1}));
  bytes.add(test::raw0(kStart + kSecondNs, {.channel = 2}, {2}));
  bytes.add(test::raw0(kStart + kSecondNs, {.channel = 3}, {3}));
  damage(bytes, at);
  if (place != nullptr) *place = at;
  return index_of(bytes);
}

// Byte by byte with the whole test of a head, against the quick way past what holds none.
TEST(RawDamage, NoHeadIsPassedOver) {
  std::uint64_t state = 20261125;
  const auto random = [&] { return (state = state * 6364136223846793005ULL + 1442695040888963407ULL) >> 33U; };
  constexpr std::string_view kLetters = "RAWCONME013245";
  for (int trial = 0; trial < 400; ++trial) {
    std::vector<std::byte> bytes(random() % 90);
    for (std::byte& byte : bytes) {
      const auto number = random();
      const char letter = kLetters[(number >> 8U) % kLetters.size()];
      byte = number % 3 == 0 ? static_cast<std::byte>(number >> 8U) : static_cast<std::byte>(letter);
    }
    if (bytes.size() > 20 && trial % 2 == 0) {
      const std::size_t at = random() % (bytes.size() - 8);
      std::memcpy(bytes.data() + at + 4, "RAW0", 4);
      if (trial % 4 == 0) std::memcpy(bytes.data() + at, "\x20\0\0\0", 4);
    }
    std::size_t expected = bytes.size() < 7 ? 0 : bytes.size() - 7;
    for (std::size_t i = 0; i + 8 <= bytes.size(); ++i) {
      const auto head = std::span<const std::byte>(bytes).subspan(i);
      if (!simrad::is_known_type(head.subspan<4, 4>())) continue;
      if (simrad::inspect_length(head) != simrad::Frame::sound) continue;
      expected = i;
      break;
    }
    ASSERT_EQ(simrad::bytes_without_head(bytes), expected) << trial;
  }
}

TEST(RawDamage, ResynchronisesAfterABadLength) {
  for (const std::int32_t length : {0, 11, -1, 100'000'000}) {
    static std::int32_t bad;
    bad = length;
    std::size_t place = 0;
    const RawIndex index = with_damage([](Bytes& b, std::size_t at) { b.patch(at, bad); }, &place);
    ASSERT_EQ(codes(index), Codes{DiagnosticCode::bad_length}) << length;
    EXPECT_EQ(index.diagnostics[0].offset, static_cast<std::int64_t>(place));
    ASSERT_EQ(index.pings.size(), 2U);
    EXPECT_EQ(index.pings[1].channels, 2);
  }
}

TEST(RawDamage, ResynchronisesAfterALengthThatRunsPastTheEnd) {
  const RawIndex index = with_damage([](Bytes& b, std::size_t at) { b.patch(at, std::int32_t{60'000'000}); });
  EXPECT_EQ(codes(index), Codes{DiagnosticCode::bad_length});
  EXPECT_EQ(index.pings.at(1).channels, 2);
}

TEST(RawDamage, ResynchronisesAfterUnequalLengthWords) {
  const RawIndex index = with_damage([](Bytes& b, std::size_t at) { b.patch(at, std::int32_t{40}); });
  EXPECT_EQ(codes(index), Codes{DiagnosticCode::length_mismatch});
  EXPECT_EQ(index.pings.at(1).channels, 2);
}

TEST(RawDamage, DatagramWithAnImpossibleTimeIsSkipped) {
  const RawIndex index = with_damage([](Bytes& b, std::size_t at) { b.patch(at + 8, ~std::uint64_t{0}); });
  EXPECT_EQ(codes(index), Codes{DiagnosticCode::bad_time});
  EXPECT_EQ(index.pings.at(1).channels, 2);
}

TEST(RawDamage, ImpossibleChannelCountsAndValuesAreSkipped) {
  EXPECT_EQ(codes(with_damage([](Bytes& b, std::size_t at) { b.patch(at + 16, std::int16_t{7}); })),
            Codes{DiagnosticCode::bad_channel});
  EXPECT_EQ(codes(with_damage([](Bytes& b, std::size_t at) { b.patch(at + 16, std::int16_t{0}); })),
            Codes{DiagnosticCode::bad_channel});
  EXPECT_EQ(codes(with_damage([](Bytes& b, std::size_t at) { b.patch(at + 16 + 68, std::int32_t{9999}); })),
            Codes{DiagnosticCode::bad_sample_counts});
  EXPECT_EQ(codes(with_damage([](Bytes& b, std::size_t at) { b.patch(at + 16 + 28, 0.0F); })),
            Codes{DiagnosticCode::bad_value});
  EXPECT_EQ(codes(with_damage([](Bytes& b, std::size_t at) { b.patch(at + 16 + 2, std::int16_t{2}); })),
            Codes{DiagnosticCode::no_power});
}

TEST(RawDamage, ImpossibleMotionCountsAsNone) {
  const RawIndex index =
      index_of(test::con0(test::small_ms70())
                   .add(test::raw0(kStart, {.roll_deg = std::numeric_limits<float>::infinity()}, {1})));
  EXPECT_EQ(codes(index), Codes{DiagnosticCode::bad_value});
  EXPECT_EQ(index.pings.at(0).roll_deg, 0.0F);
}

TEST(RawDamage, SamplesWithoutConfiguration) {
  const RawIndex index = index_of(test::small_ping(kStart));
  EXPECT_EQ(codes(index), Codes{DiagnosticCode::no_config});
  EXPECT_EQ(index.pings.size(), 1U);
}

TEST(RawDamage, ShortOrStrangeConfiguration) {
  test::Con0Spec many = test::small_ms70();
  many.stated_beams = 500;
  EXPECT_EQ(codes(index_of(test::con0(many))), Codes{DiagnosticCode::bad_config});
  test::Con0Spec infinite = test::small_ms70();
  infinite.beams[0].frequency_hz = std::numeric_limits<float>::infinity();
  EXPECT_EQ(codes(index_of(test::con0(infinite))), Codes{DiagnosticCode::bad_value});
}

// What is no number of a beam must not go into its Sv: it is unknown, and said to be.
TEST(RawDamage, ImpossibleNumbersOfABeamAreUnknown) {
  constexpr std::size_t kBeam = 16 + 516;
  struct Hit {
    std::size_t at;
    float value;
  };
  for (const Hit& hit : {Hit{132, -5.0F}, Hit{136, 20'620.0F}, Hit{140, -98.0F}, Hit{140, -24'470.0F}, Hit{140, 1e30F},
                         Hit{144, 6000.0F}, Hit{220, 3000.0F}, Hit{248, -25.0F}}) {
    Bytes bytes = test::con0(test::small_ms70());
    bytes.patch(kBeam + hit.at, hit.value);
    const RawIndex index = index_of(bytes);
    EXPECT_EQ(codes(index), Codes{DiagnosticCode::bad_value}) << hit.at << " " << hit.value;
    const BeamConfig& beam = index.configs.at(0)->beams.at(0);
    const bool unknown = std::isnan(beam.frequency_hz) || std::isnan(beam.gain_db) ||
                         std::isnan(beam.equivalent_beam_angle_db) || std::isnan(beam.width_alongship_deg) ||
                         std::isnan(beam.gain_table_db[0]) || std::isnan(beam.sa_correction_table_db[0]);
    EXPECT_TRUE(unknown) << hit.at << " " << hit.value;
  }
}

TEST(RawDamage, ChannelsOfOneTimeFarApartAreDropped) {
  // Sparse: the source claims padding that is never looked at.
  class Sparse final : public ByteSource {
   public:
    Sparse(Bytes head, Bytes tail, std::uint64_t gap) : head_(std::move(head)), tail_(std::move(tail)), gap_(gap) {}
    [[nodiscard]] const std::string& name() const override { return name_; }
    [[nodiscard]] Result<std::uint64_t> size() const override { return head_.size() + gap_ + tail_.size(); }
    [[nodiscard]] Result<std::size_t> read(std::uint64_t offset, std::span<std::byte> out) const override {
      std::size_t n = 0;
      for (; n < out.size() && offset + n < *size(); ++n) out[n] = at(offset + n);
      return n;
    }

   private:
    [[nodiscard]] std::byte at(std::uint64_t i) const {
      if (i < head_.size()) return head_.data[i];
      i -= head_.size();
      if (i < gap_) return filler(i);
      return tail_.data[i - gap_];
    }
    /// Equal TAG0 datagrams of 32 MiB each.
    [[nodiscard]] std::byte filler(std::uint64_t i) const {
      constexpr std::uint64_t kEach = 32 << 20;
      const std::uint64_t in = i % kEach;
      if (in < 16) return tag_.data[in];
      if (in >= kEach - 4) return tag_.data[in - (kEach - 4)];
      return std::byte{0};
    }
    std::string name_ = "sparse";
    Bytes head_, tail_;
    std::uint64_t gap_;
    Bytes tag_ = [] {
      Bytes tag = test::datagram("TAG0", kStart, {});
      tag.patch(0, std::int32_t{(32 << 20) - 8});
      return tag;
    }();
  };
  Bytes head = test::con0(test::small_ms70());
  head.add(test::raw0(kStart, {.channel = 1}, {1}));
  Bytes tail = test::raw0(kStart, {.channel = 2}, {2});
  tail.add(test::raw0(kStart, {.channel = 3}, {3}));
  const Sparse source(head, tail, std::uint64_t{9} * (32 << 20));
  const auto index = index_raw(source);
  ASSERT_TRUE(index);
  EXPECT_EQ(index->datagrams.at("TAG0"), 9);
  EXPECT_EQ(codes(*index), Codes{DiagnosticCode::ping_too_long}) << "once for the ping";
}

TEST(RawDamage, AChannelOfMoreSamplesThanAreReadIsToldAsThat) {
  Bytes bytes = test::small_file(1);
  const std::vector<std::int16_t> many((std::size_t{1} << 20) + 1, 7);
  bytes.add(test::raw0(kStart + kSecondNs, {.channel = 1}, many))
      .add(test::raw0(kStart + kSecondNs, {.channel = 2}, {2}));
  const RawIndex index = index_of(bytes);
  ASSERT_EQ(codes(index), Codes{DiagnosticCode::bad_sample_counts});
  EXPECT_NE(index.diagnostics[0].text.find("channel 1: more samples than"), std::string::npos);
  EXPECT_EQ(index.pings.back().channels, 1);
}

TEST(RawDamage, NotesHaveACeiling) {
  Bytes bytes = test::con0(test::small_ms70());
  for (int i = 0; i < 1000; ++i) bytes.add(test::raw0(kStart + i, {.channel = 99}, {1}));
  const RawIndex index = index_of(bytes);
  EXPECT_EQ(index.diagnostics.size(), 201U);
  EXPECT_EQ(index.diagnostics.back().code, DiagnosticCode::notes_limited);
}

/// A file with every kind of thing in it, damage included.
Bytes eventful_file() {
  Bytes bytes = test::small_file(2);
  bytes.add(test::nme0(kStart, "$INHDT,91.0,T*00"));
  bytes.add(Bytes().text("garbage between datagrams", 25));
  bytes.add(test::datagram("ZZZ9", kStart, Bytes().zeros(3)));
  bytes.add(test::small_ping(kStart + 3 * kSecondNs));
  Bytes broken = test::small_ping(kStart + 4 * kSecondNs);
  broken.patch(100, std::int32_t{70'000'000});
  bytes.add(broken).add(test::small_ping(kStart + 5 * kSecondNs));
  bytes.data.resize(bytes.size() - 30);
  return bytes;
}

TEST(RawDamage, AnyChoppingOfTheBytesGivesTheSameIndex) {
  const Bytes bytes = eventful_file();
  const std::vector<std::byte> whole = encode_index(index_of(bytes));
  for (const std::size_t piece : {std::size_t{1}, std::size_t{7}, std::size_t{4096}}) {
    const auto memory = std::make_shared<MemorySource>("memory");
    const auto source = ping_source(memory);
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      memory->append(std::span(bytes.data).subspan(at, std::min(piece, bytes.size() - at)));
      const std::size_t before = source->count();
      const auto fresh = source->refresh();
      ASSERT_TRUE(fresh);
      ASSERT_EQ(source->count(), before + *fresh);
    }
    ASSERT_TRUE(source->finish());
    EXPECT_TRUE(source->final());
    EXPECT_EQ(encode_index(source->index()), whole) << piece;
  }
}

TEST(RawDamage, RandomDamageNeverCrashes) {
  const Bytes sound = test::small_file(4);
  std::uint64_t state = 1;
  const auto random = [&](std::uint64_t below) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (state >> 33) % below;
  };
  for (int round = 0; round < 3000; ++round) {
    Bytes bytes = sound;
    for (std::uint64_t flips = random(6); flips > 0; --flips) {
      bytes.data[random(bytes.size())] ^= static_cast<std::byte>(1U << random(8));
    }
    if (random(3) == 0) bytes.data.resize(random(bytes.size()));
    const MemorySource source("memory", bytes.data);
    const auto index = index_raw(source);
    ASSERT_TRUE(index);
    for (const PingEntry& entry : index->pings) ASSERT_TRUE(read_ping(source, entry));
  }
}

}  // namespace
}  // namespace sonar
