// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/load_volume.h"

#include <gtest/gtest.h>

#include "base/units.h"
#include "io/simrad/test_bytes.h"

namespace sonar {
namespace {

using test::Bytes;
using test::kStart;

SurveyFiles opened(const test::TemporaryFolder& folder, const Bytes& bytes) {
  folder.write("a.raw", bytes);
  Work work(1);
  const std::vector<std::filesystem::path> paths{folder.path()};
  return open_survey(paths, {}, {}, IndexCache{}, work).value();
}

TEST(LoadVolume, EveryChannelLandsOnItsRow) {
  const test::TemporaryFolder folder;
  const SurveyFiles survey = opened(folder, test::small_file(2));
  const auto ping = load_volume(survey, survey.observations.at(0), 1);
  ASSERT_TRUE(ping);
  EXPECT_EQ(ping->time, kStart + kSecondNs);
  EXPECT_EQ(ping->volume.counts.shape(), (Shape3{2, 3, 4}));
  for (int fan = 0; fan < 2; ++fan) {
    for (int beam = 0; beam < 3; ++beam) {
      for (int s = 0; s < 4; ++s) {
        EXPECT_EQ(ping->volume.counts(fan, beam, s), (fan * 3 + beam + 1) * 10 + s);
        EXPECT_EQ(ping->volume.flags(fan, beam, s), SampleFlags::none);
      }
    }
  }
  ASSERT_EQ(ping->heads.size(), 6U);
  EXPECT_EQ(ping->heads[5].transmit_power_w, 30.0);
  EXPECT_TRUE(ping->heads[5].power_count.empty());
}

TEST(LoadVolume, WhatIsNotThereIsLost) {
  const test::TemporaryFolder folder;
  Bytes bytes = test::con0(test::small_ms70());
  bytes.add(test::raw0(kStart, {.channel = 1}, {1, -20000, 3, 4, 5}));
  bytes.add(test::raw0(kStart, {.channel = 2, .offset = 2}, {7, 8}));
  bytes.add(test::raw0(kStart, {.channel = 3}, {-32768, 32767}));
  const SurveyFiles survey = opened(folder, bytes);
  EXPECT_EQ(survey.observations.at(0).range.count, 5);
  const auto ping = load_volume(survey, survey.observations.at(0), 0);
  ASSERT_TRUE(ping);
  const auto row = [&](int beam) {
    const auto r = ping->volume.counts.row(0, beam);
    return std::vector<std::int16_t>(r.begin(), r.end());
  };
  EXPECT_EQ(row(0), (std::vector<std::int16_t>{1, kNoData, 3, 4, 5}));
  EXPECT_EQ(row(1), (std::vector<std::int16_t>{kNoData, kNoData, 7, 8, kNoData}));
  EXPECT_EQ(row(2), (std::vector<std::int16_t>{kMinCount, kMaxCount, kNoData, kNoData, kNoData}));
  for (int fan = 0; fan < 2; ++fan) {
    for (int beam = 0; beam < 3; ++beam) {
      for (int s = 0; s < 5; ++s) {
        const bool lost = ping->volume.counts(fan, beam, s) == kNoData;
        EXPECT_EQ(ping->volume.flags(fan, beam, s), lost ? SampleFlags::dropout : SampleFlags::none);
      }
    }
  }
  EXPECT_EQ(ping->volume.counts(1, 2, 0), kNoData);
}

TEST(LoadVolume, UsedStorageKeepsNothingOfThePingBefore) {
  const test::TemporaryFolder folder;
  Bytes bytes = test::small_file(1);
  bytes.add(test::raw0(kStart + kSecondNs, {.channel = 4}, {9}));
  const SurveyFiles survey = opened(folder, bytes);
  const ObservationFiles& o = survey.observations.at(0);
  PowerVolume used;
  ASSERT_TRUE(load_volume(survey, o, 0, used));
  ASSERT_TRUE(load_volume(survey, o, 1, used));
  const auto fresh = load_volume(survey, o, 1);
  ASSERT_TRUE(fresh);
  EXPECT_EQ(used.volume.counts, fresh->volume.counts);
  EXPECT_EQ(used.volume.flags, fresh->volume.flags);
}

TEST(LoadVolume, NeedsAGrid) {
  const test::TemporaryFolder folder;
  const SurveyFiles survey =
      opened(folder, test::con0({.sounder = "ER60", .beams = {{}}}).add(test::raw0(kStart, {.channel = 1}, {1, 2})));
  const auto ping = load_volume(survey, survey.observations.at(0), 0);
  ASSERT_FALSE(ping);
  EXPECT_EQ(ping.error().code, ErrorCode::unsupported);
  EXPECT_EQ(load_ping(survey, survey.observations[0].pings[0]).value().channels.size(), 1U);
}

TEST(LoadVolume, FileThatIsGoneIsAnErrorWithItsName) {
  const test::TemporaryFolder folder;
  const SurveyFiles survey = opened(folder, test::small_file(1));
  std::filesystem::remove(folder.path() / "a.raw");
  const auto ping = load_volume(survey, survey.observations.at(0), 0);
  ASSERT_FALSE(ping);
  EXPECT_EQ(ping.error().code, ErrorCode::not_found);
  EXPECT_EQ(ping.error().where.ping, 0);
  EXPECT_NE(ping.error().where.file.find("a.raw"), std::string::npos);
}

}  // namespace
}  // namespace sonar
