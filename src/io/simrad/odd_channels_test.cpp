// SPDX-License-Identifier: Apache-2.0
#include "io/simrad/odd_channels.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "io/byte_source.h"
#include "io/ping_source.h"
#include "io/simrad/test_bytes.h"

namespace sonar {
namespace {

using test::Bytes;
using test::kStart;

constexpr int kChannels = 20;

/// Two fans of ten beams, each fan with a frequency of its own.
test::Con0Spec sounder() {
  test::Con0Spec spec;
  for (int i = 0; i < kChannels; ++i) {
    const bool upper = i >= kChannels / 2;
    spec.beams.push_back(
        {upper ? 90'000.0F : 100'000.0F, upper ? 0.0F : -10.0F, 2.5F * static_cast<float>(i % (kChannels / 2)), 20.0F});
  }
  return spec;
}

struct Sent {
  TimeNs time = 0;
  test::Raw0Spec spec;
};
using Damage = std::function<void(Sent& sent, int ping)>;

/// Four pings, a second apart; `damage` may change what any channel says.
RawIndex damaged(const Damage& damage, std::vector<std::byte>* bytes = nullptr) {
  Bytes file = test::con0(sounder());
  for (int ping = 0; ping < 4; ++ping) {
    for (int channel = 1; channel <= kChannels; ++channel) {
      Sent sent{kStart + ping * kSecondNs, {}};
      sent.spec.channel = channel;
      sent.spec.frequency_hz = channel > kChannels / 2 ? 90'000.0F : 100'000.0F;
      damage(sent, ping);
      file.add(test::raw0(sent.time, sent.spec, {1, 2, 3, 4}));
    }
  }
  if (bytes != nullptr) *bytes = file.data;
  const MemorySource source("damaged.raw", file.data);
  return *index_raw(source);
}

std::vector<DiagnosticCode> codes(const RawIndex& index) {
  std::vector<DiagnosticCode> all;
  for (const Diagnostic& d : index.diagnostics) all.push_back(d.code);
  return all;
}

bool is_hit(const Sent& sent, int ping) { return ping == 2 && sent.spec.channel == 7; }

TEST(OddChannels, OneOfManyThatIsSentOtherwiseIsLeftOutAndTheRestStaysTogether) {
  const std::vector<std::function<void(test::Raw0Spec&)>> hits = {
      [](test::Raw0Spec& s) { s.interval_s *= 4.0F; },        [](test::Raw0Spec& s) { s.pulse_s *= 2.0F; },
      [](test::Raw0Spec& s) { s.sound_speed_mps = 1510.0F; }, [](test::Raw0Spec& s) { s.frequency_hz = 25'000.0F; },
      [](test::Raw0Spec& s) { s.power_w *= 256.0F; },         [](test::Raw0Spec& s) { s.offset = 1 << 17; },
  };
  for (std::size_t i = 0; i < hits.size(); ++i) {
    std::vector<std::byte> bytes;
    const RawIndex index = damaged(
        [&](Sent& sent, int ping) {
          if (is_hit(sent, ping)) hits[i](sent.spec);
        },
        &bytes);
    EXPECT_EQ(codes(index), std::vector{DiagnosticCode::bad_value}) << i;
    EXPECT_NE(index.diagnostics.at(0).text.find("channel 7"), std::string::npos) << index.diagnostics[0].text;
    EXPECT_EQ(index.transmits.size(), 1U) << i;
    ASSERT_EQ(index.pings.size(), 4U) << i;
    EXPECT_EQ(index.pings[1].channels, kChannels);
    EXPECT_EQ(index.pings[2].channels, kChannels - 1);
    EXPECT_EQ((*index.transmits[0])[6].max_samples, 4) << i;
    // The samples' reader leaves it out as well.
    const auto ping = read_ping(MemorySource("damaged.raw", bytes), index.pings[2]);
    ASSERT_TRUE(ping);
    ASSERT_EQ(ping->channels.size(), std::size_t{kChannels - 1});
    for (const ChannelPing& channel : ping->channels) EXPECT_NE(channel.channel, 6);
  }
}

TEST(OddChannels, OneThatIsAlwaysSentOtherwiseIsNoDamage) {
  const RawIndex index = damaged([](Sent& sent, int) {
    if (sent.spec.channel == 20) sent.spec.frequency_hz = 38'000.0F;
  });
  ASSERT_EQ(index.pings.size(), 4U);
  EXPECT_EQ(index.transmits.size(), 1U);
  EXPECT_EQ(index.pings[0].channels, kChannels - 1);
  for (std::size_t ping = 1; ping < 4; ++ping) EXPECT_EQ(index.pings[ping].channels, kChannels);
  EXPECT_EQ(codes(index).size(), 1U);
}

// Of a reduced ping few channels are left, and of a fan perhaps one.
TEST(OddChannels, WhatIsLeftOfAFanIsNotOdd) {
  Bytes file = test::con0(sounder());
  for (int channel = 1; channel <= 11; ++channel) {
    test::Raw0Spec spec;
    spec.channel = channel;
    spec.frequency_hz = channel > kChannels / 2 ? 90'000.0F : 100'000.0F;
    file.add(test::raw0(kStart, spec, {1, 2, 3, 4}));
  }
  const RawIndex index = *index_raw(MemorySource("reduced.raw", file.data));
  EXPECT_TRUE(index.diagnostics.empty());
  EXPECT_EQ(index.pings.at(0).channels, 11);
}

TEST(OddChannels, AFrequencyForEachBeamIsNotOdd) {
  const RawIndex index = damaged(
      [](Sent& sent, int) { sent.spec.frequency_hz = 70'000.0F + 100.0F * static_cast<float>(sent.spec.channel); });
  EXPECT_TRUE(index.diagnostics.empty());
  for (const PingEntry& ping : index.pings) EXPECT_EQ(ping.channels, kChannels);
}

TEST(OddChannels, ASettingThatAllChangeBeginsAnother) {
  const RawIndex index = damaged([](Sent& sent, int ping) {
    if (ping >= 2) sent.spec.pulse_s = 0.004F;
  });
  EXPECT_TRUE(index.diagnostics.empty());
  EXPECT_EQ(index.transmits.size(), 2U);
}

TEST(OddChannels, RowsThatAllLieFarAwayAreAsRecorded) {
  const RawIndex index = damaged([](Sent& sent, int) { sent.spec.offset = 40'000; });
  EXPECT_TRUE(index.diagnostics.empty());
  EXPECT_EQ(index.pings.at(3).channels, kChannels);
}

// A time stamp that is hit makes no ping of its own, wherever in its ping it stands and wherever it points.
TEST(OddChannels, OneTimeStampThatIsHitDoesNotPartThePing) {
  for (const int channel : {1, 7, 20}) {
    for (const TimeNs by : {-kSecondNs * 7000, -kSecondNs * 3, kSecondNs * 100, kSecondNs * 100'000}) {
      const RawIndex index = damaged([&](Sent& sent, int ping) {
        if (ping == 2 && sent.spec.channel == channel) sent.time += by;
      });
      EXPECT_EQ(codes(index), std::vector{DiagnosticCode::bad_time}) << channel << " " << by;
      ASSERT_EQ(index.pings.size(), 4U) << channel << " " << by;
      EXPECT_EQ(index.pings[2].channels, kChannels - 1);
      EXPECT_EQ(index.pings[3].channels, kChannels);
    }
  }
}

TEST(OddChannels, PingsOfOneChannelEachStayPings) {
  const RawIndex index =
      damaged([](Sent& sent, int ping) { sent.time = kStart + (ping * kChannels + sent.spec.channel) * kSecondNs; });
  EXPECT_EQ(index.pings.size(), 4U * kChannels);
  EXPECT_TRUE(index.diagnostics.empty());
}

}  // namespace
}  // namespace sonar
