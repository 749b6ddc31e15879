// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/simrad/test_bytes.h"

/// Seven pings of whole numbers: the same on any machine, small, and with something of everything.
namespace sonar::fixed {

inline constexpr int kFans = 8;
inline constexpr int kBeams = 12;
inline constexpr int kSamples = 300;
inline constexpr int kPings = 7;
inline constexpr int kSchoolSample = 130;
// 40 m below the transducer at 20, 17.5, 15 and 12.5 degrees down, 0.75 m a sample; the other fans pass over it.
inline constexpr std::array<int, 4> kSeabedSample{156, 177, 206, 246};

/// Whole numbers only, so that the pings are the same on any machine.
inline std::int16_t speckle(int ping, int channel, int sample) {
  auto x = static_cast<std::uint32_t>(ping * 1'000'003 + channel * 7919 + sample * 104'729 + 12'345);
  for (int i = 0; i < 3; ++i) x = (x ^ (x >> 15U)) * 0x2C1B3C6DU;
  return static_cast<std::int16_t>(static_cast<int>(x % 601U) - 300);  // +- 3.5 dB
}

/// Counts of 10 log10(2)/256 dB re 1 W: noise at -150 dB, a school at -112 dB that comes nearer by two samples a ping,
/// the seabed under the deepest fans, a beam with corrupted packets, interference.
inline std::int16_t power(int ping, int fan, int beam, int sample) {
  int counts = -12'757;
  const int off_beam = beam - 5;
  const int off_fan = 2 * (fan - 4);
  const int off_sample = (sample - kSchoolSample + 2 * ping) / 4;
  if (off_beam * off_beam + off_fan * off_fan + off_sample * off_sample <= 16) counts = -9'525;
  const int seabed = fan < 4 ? kSeabedSample[static_cast<std::size_t>(fan)] : kSamples;
  if (sample >= seabed && sample < seabed + 40) counts = -7'500;
  if (ping == 3 && fan == 4 && beam == 2 && sample > 60) counts = -7'000;
  if (ping == 4 && sample >= 105 && sample < 108) counts = -9'800;
  return static_cast<std::int16_t>(counts + speckle(ping, fan * kBeams + beam, sample));
}

inline test::Bytes file() {
  test::Con0Spec config;
  for (int fan = 0; fan < kFans; ++fan) {
    for (int beam = 0; beam < kBeams; ++beam) {
      config.beams.push_back({100'000.0F, -20.0F + 2.5F * static_cast<float>(fan),
                              -13.75F + 2.5F * static_cast<float>(beam), 20.0F, -20.0F});
    }
  }
  test::Bytes bytes = test::con0(config);
  for (int ping = 0; ping < kPings; ++ping) {
    const TimeNs time = test::kStart + ping * 2 * kSecondNs;
    const double minutes = 0.001 * ping;  // 0.001' of latitude in 2 s: 1.8 knots to the north
    bytes.add(test::nme0(
        time, test::with_checksum(fmt::format("GPGGA,000000,60{:07.4f},N,00500.0000,E,1,8,1,0,M,0,M,,", minutes))));
    bytes.add(test::nme0(time, test::with_checksum("INHDT,10.0,T")));
    for (int channel = 0; channel < kFans * kBeams; ++channel) {
      if (ping == 5 && channel == 17) continue;  // lost
      std::vector<std::int16_t> samples;
      for (int s = 0; s < kSamples; ++s) samples.push_back(power(ping, channel / kBeams, channel % kBeams, s));
      bytes.add(test::raw0(time, {.channel = channel + 1, .interval_s = 0.001F}, samples));
    }
  }
  return bytes;
}

}  // namespace sonar::fixed
