// SPDX-License-Identifier: Apache-2.0
#include "io/raw_index.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "io/index_cache.h"
#include "io/ping_source.h"
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

TEST(RawIndex, CountsWhatASoundFileHolds) {
  const Bytes bytes = test::small_file(3);
  const RawIndex index = index_of(bytes);
  EXPECT_EQ(index.format, RawFormat::simrad);
  EXPECT_EQ(index.size, bytes.size());
  EXPECT_EQ(codes(index), Codes{});
  EXPECT_EQ(index.datagrams, (std::map<std::string, std::int64_t>{{"CON0", 1}, {"NME0", 6}, {"RAW0", 18}}));
  ASSERT_EQ(index.pings.size(), 3U);
  EXPECT_EQ(index.pings[1].time, kStart + kSecondNs);
  EXPECT_EQ(index.pings[1].channels, 6);
  EXPECT_EQ(index.pings[1].min_samples, 4);
  EXPECT_EQ(index.pings[1].max_samples, 4);
  EXPECT_EQ(index.pings[2].end, bytes.size());
  ASSERT_EQ(index.transmits.size(), 1U);
  ASSERT_EQ(index.transmits[0]->size(), 6U);
  EXPECT_EQ((*index.transmits[0])[5].transmit_power_w, 30.0);
  EXPECT_EQ((*index.transmits[0])[5].max_samples, 4);
  ASSERT_EQ(index.navigation.size(), 3U);  // GGA: position and clock; HDT
  EXPECT_EQ(index.navigation[0].samples.size(), 3U);
}

TEST(RawIndex, NavigationBetweenChannelsDoesNotEndAPing) {
  Bytes bytes = test::con0(test::small_ms70());
  bytes.add(test::raw0(kStart, {.channel = 1}, {1, 2}));
  bytes.add(test::nme0(kStart + kSecondNs, test::with_checksum("INHDT,90.0,T")));
  bytes.add(test::raw0(kStart, {.channel = 2}, {3, 4}));
  const RawIndex index = index_of(bytes);
  ASSERT_EQ(index.pings.size(), 1U);
  EXPECT_EQ(index.pings[0].channels, 2);
  const MemorySource source("memory", bytes.data);
  const auto ping = read_ping(source, index.pings[0]);
  ASSERT_TRUE(ping);
  ASSERT_EQ(ping->channels.size(), 2U);
  EXPECT_EQ(ping->channels[1].power_count[1], 4);
}

TEST(RawIndex, MissingChannelsAndUnequalCountsAreNormal) {
  Bytes bytes = test::con0(test::small_ms70());
  bytes.add(test::raw0(kStart, {.channel = 2}, {1, 2})).add(test::raw0(kStart, {.channel = 5}, {1, 2, 3}));
  bytes.add(test::raw0(kStart + kSecondNs, {.channel = 1}, {1}));
  const RawIndex index = index_of(bytes);
  EXPECT_EQ(codes(index), Codes{});
  ASSERT_EQ(index.pings.size(), 2U);
  EXPECT_EQ(index.pings[0].channels, 2);
  EXPECT_EQ(index.pings[0].min_samples, 2);
  EXPECT_EQ(index.pings[0].max_samples, 3);
}

TEST(RawIndex, RepeatedChannelIsDropped) {
  Bytes bytes = test::con0(test::small_ms70());
  bytes.add(test::raw0(kStart, {.channel = 1}, {1, 2}));
  const std::size_t repeat = bytes.size();
  bytes.add(test::raw0(kStart, {.channel = 1}, {8, 9})).add(test::raw0(kStart, {.channel = 2}, {3, 4}));
  const RawIndex index = index_of(bytes);
  EXPECT_EQ(codes(index), Codes{DiagnosticCode::repeated_channel});
  EXPECT_EQ(index.diagnostics[0].offset, static_cast<std::int64_t>(repeat));
  ASSERT_EQ(index.pings.size(), 1U);
  const MemorySource source("memory", bytes.data);
  const auto ping = read_ping(source, index.pings[0]);
  ASSERT_TRUE(ping);
  ASSERT_EQ(ping->channels.size(), 2U);
  EXPECT_EQ(ping->channels[0].power_count[0], 1);
}

TEST(RawIndex, ChannelsThatComeLateJoinTheirPing) {
  Bytes bytes = test::con0(test::small_ms70());
  bytes.add(test::raw0(kStart, {.channel = 3}, {3})).add(test::raw0(kStart, {.channel = 1}, {1}));
  const RawIndex index = index_of(bytes);
  ASSERT_EQ(index.pings.size(), 1U);
  const MemorySource source("memory", bytes.data);
  const auto ping = read_ping(source, index.pings[0]);
  ASSERT_TRUE(ping);
  EXPECT_EQ(ping->channels[0].channel, 0);
  EXPECT_EQ(ping->channels[1].channel, 2);
}

TEST(RawIndex, SamplesAtOddAddressesAreReadRight) {
  Bytes bytes = test::con0(test::small_ms70());
  bytes.add(test::raw0(kStart, {.channel = 1}, {1, 2}));
  bytes.add(test::datagram("TAG0", kStart, Bytes().text("odd", 3)));
  bytes.add(test::raw0(kStart, {.channel = 2}, {-3, 4}));
  const RawIndex index = index_of(bytes);
  const MemorySource source("memory", bytes.data);
  const auto ping = read_ping(source, index.pings.at(0));
  ASSERT_TRUE(ping);
  EXPECT_EQ(ping->channels.at(1).power_count[0], -3);
  EXPECT_EQ(ping->channels.at(1).power_count[1], 4);
}

TEST(RawIndex, ChangedPowerMakesAnotherTransmitSet) {
  Bytes bytes = test::small_file(2);
  bytes.add(test::small_ping(kStart + 5 * kSecondNs, {.power_w = 10.0F}));
  bytes.add(test::small_ping(kStart + 6 * kSecondNs));
  const RawIndex index = index_of(bytes);
  ASSERT_EQ(index.transmits.size(), 2U);
  EXPECT_EQ(index.pings[2].transmit, 1);
  EXPECT_EQ(index.pings[3].transmit, 0);
}

TEST(RawIndex, RepeatedConfigurationIsNoChange) {
  const RawIndex index = index_of(test::small_file(1).add(test::small_file(1, kStart + 60 * kSecondNs)));
  EXPECT_EQ(codes(index), Codes{});
  EXPECT_EQ(index.configs.size(), 1U);
}

TEST(RawIndex, ChangedConfigurationIsNoted) {
  test::Con0Spec other = test::small_ms70();
  other.beams[0].gain_db = 25.0F;
  Bytes bytes = test::small_file(1);
  bytes.add(test::con0(other)).add(test::small_ping(kStart + 60 * kSecondNs));
  const RawIndex index = index_of(bytes);
  EXPECT_EQ(codes(index), Codes{DiagnosticCode::config_changed});
  ASSERT_EQ(index.configs.size(), 2U);
  EXPECT_EQ(index.pings.at(1).config, 1);
}

TEST(RawIndex, AnglesOfCon1) {
  const auto with_con1 = [](const std::string& xml) {
    Bytes body;
    return index_of(test::con0(test::small_ms70())
                        .add(test::datagram("CON1", kStart, body.text(xml, xml.size() + 3)))
                        .add(test::small_ping(kStart)));
  };
  const RawIndex same = with_con1(R"(<C><BeamArrays SteeringRxX="-10;-10;-10;0;0;0" )"
                                  R"(SteeringRxY="-2.5;0;2.5;-2.5;0;2.55"/></C>)");
  EXPECT_EQ(codes(same), Codes{});
  EXPECT_EQ(same.configs[0]->beams[5].direction_deg[1], 2.55);
  EXPECT_EQ(codes(with_con1(R"(<C><BeamArrays SteeringRxX="-10;-10;-10;0;0;0" )"
                            R"(SteeringRxY="-2.5;0;2.5;-2.5;0;2.7"/></C>)")),
            Codes{DiagnosticCode::con1_differs});
  EXPECT_EQ(codes(with_con1("<C><BeamArrays/></C>")), Codes{DiagnosticCode::con1_unusable});
  EXPECT_EQ(codes(with_con1("<C><Beam")), Codes{DiagnosticCode::con1_unusable});
}

TEST(RawIndex, WrongChecksumsAreCountedOnce) {
  Bytes bytes = test::small_file(1);
  const auto first = static_cast<std::int64_t>(bytes.size());
  bytes.add(test::nme0(kStart, "$INHDT,91.0,T*00")).add(test::nme0(kStart, "$INHDT,91.0,T*01"));
  bytes.add(test::nme0(kStart, "$INHDT,91.0,T"));
  const RawIndex index = index_of(bytes);
  ASSERT_EQ(codes(index), Codes{DiagnosticCode::bad_nmea});
  EXPECT_EQ(index.diagnostics[0].offset, first);
  EXPECT_EQ(index.navigation.at(2).samples.size(), 2U);
}

TEST(RawIndex, OtherFormatsAreNamed) {
  Bytes hdf5;
  hdf5.put(std::uint8_t{0x89}).text("HDF\r\n\x1a\n", 7).zeros(100);
  const RawIndex netcdf = index_of(hdf5);
  EXPECT_EQ(netcdf.format, RawFormat::other_netcdf) << "a product or a depth raster";
  EXPECT_EQ(codes(netcdf), Codes{DiagnosticCode::format_not_read});
  EXPECT_EQ(index_of(Bytes().text("CDF\x01", 4).zeros(40)).format, RawFormat::other_netcdf);
  const RawIndex sonar = index_of(hdf5.text("SONAR-netCDF4", 13));
  EXPECT_EQ(sonar.format, RawFormat::sonar_netcdf4);
  EXPECT_EQ(codes(sonar), Codes{DiagnosticCode::format_not_read});

  Bytes ek80 = test::datagram("XML0", kStart, Bytes().text("<Configuration/>", 16));
  ek80.add(test::datagram("RAW3", kStart, Bytes().zeros(140)));
  const RawIndex recognised = index_of(ek80);
  EXPECT_EQ(recognised.format, RawFormat::ek80);
  EXPECT_EQ(codes(recognised), Codes{DiagnosticCode::format_not_read});
  EXPECT_EQ(recognised.datagrams.at("RAW3"), 1);

  const RawIndex garbage = index_of(Bytes().text("just some text, longer than a head", 34));
  EXPECT_EQ(garbage.format, RawFormat::unknown);
  EXPECT_FALSE(garbage.readable());
  EXPECT_EQ(garbage.diagnostics.back().code, DiagnosticCode::not_recognised);
  EXPECT_EQ(codes(index_of({})), Codes{DiagnosticCode::not_recognised});
}

TEST(PingReader, RefusesAFileThatIsNotTheIndexedOne) {
  const RawIndex index = index_of(test::small_file(3));
  const MemorySource shorter("memory", test::small_file(2).data);
  const auto beyond = read_ping(shorter, index.pings[2]);
  ASSERT_FALSE(beyond);
  EXPECT_EQ(beyond.error().code, ErrorCode::io) << "not damage: it was read to here before";
  const MemorySource other("memory", test::small_file(3, kStart + 1000 * kSecondNs).data);
  EXPECT_FALSE(read_ping(other, index.pings[2]));
}

}  // namespace
}  // namespace sonar
