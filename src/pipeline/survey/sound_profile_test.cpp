// SPDX-License-Identifier: Apache-2.0
#include "pipeline/survey/sound_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "pipeline/survey/test_opened.h"

namespace sonar {
namespace {

constexpr const char* kTable = "depth_m,sound_speed_mps\n0,1500\n100,1480\n";

Result<SoundProfile> read(const std::string& csv) {
  const auto table = parse_csv(csv, "svp.csv");
  if (!table) return pass_on(table);
  return profile_from_table(*table);
}

// By hand: of 1500 falling to 1480 over 100 m the time is 100 / 20 x ln(1500 / 1480); below, 1480 holds.
TEST(SoundProfile, TheMeanIsThatOfTravelTimes) {
  const SoundProfile profile = read(kTable).value();
  EXPECT_NEAR(harmonic_mean_mps(profile, 0.0, 100.0), 20.0 / std::log(1500.0 / 1480.0), 1e-9);
  EXPECT_NEAR(harmonic_mean_mps(profile, 200.0, 0.0),
              200.0 / (100.0 / 20.0 * std::log(1500.0 / 1480.0) + 100.0 / 1480.0), 1e-9);
  EXPECT_DOUBLE_EQ(harmonic_mean_mps(profile, 25.0, 25.0), 1495.0) << "a sonar that looks level";
  EXPECT_DOUBLE_EQ(harmonic_mean_mps(profile, 300.0, 400.0), 1480.0);
  EXPECT_DOUBLE_EQ(harmonic_mean_mps({{10.0, 1490.0}}, 0.0, 100.0), 1490.0);
}

TEST(SoundProfile, TablesThatMakeNoSenseAreRefused) {
  for (const char* wrong : {"depth_m,sound_speed_mps\n", "depth_m,speed\n0,1500\n", "depth_m,sound_speed_mps\n0,1.5\n",
                            "depth_m,sound_speed_mps\n10,1500\n10,1490\n", "depth_m,sound_speed_mps\n-1,1500\n",
                            "depth_m,sound_speed_mps\n,1500\n", "depth_m,sound_speed_mps\n5,\n"}) {
    EXPECT_FALSE(read(wrong)) << wrong;
  }
  EXPECT_EQ(profile_from_json(to_json(read(kTable).value())).value(), read(kTable).value());
  EXPECT_FALSE(profile_from_json(nlohmann::json::parse("[[0]]")));
  EXPECT_FALSE(profile_from_json(nlohmann::json::parse("[[0, 15]]")));
}

TEST(SoundProfile, RaysBendOnlyInAProfile) {
  const test::TemporaryFolder folder;
  folder.write("a.raw", test::small_file(3));
  SurveyParams params;
  params.bend_rays = true;
  Work work(1);
  const std::filesystem::path path = folder.path();
  const auto refused = open_survey({&path, 1}, params, {}, IndexCache{}, work);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::bad_parameter);
  params.sound_speed_profile = {{0.0, 1500.0}};
  EXPECT_TRUE(open_survey({&path, 1}, params, {}, IndexCache{}, work));
}

// The law: ranges go as sound speed, spacing and what is taken off alike.
TEST(SoundProfile, AGivenSoundSpeedStandsForTheFiles) {
  const test::TemporaryFolder folder;
  folder.write("a.raw", test::small_file(3));
  const ObservationFiles recorded = test::opened(folder).observations.at(0);
  SurveyParams params;
  params.sound_speed_mps = recorded.sound_speed_mps * 1.01;
  const ObservationFiles given = test::opened(folder, params).observations.at(0);
  EXPECT_FALSE(recorded.sound_speed_given);
  EXPECT_TRUE(given.sound_speed_given);
  EXPECT_EQ(given.sound_speed_mps, params.sound_speed_mps);
  EXPECT_NEAR(given.range.spacing_m, 1.01 * recorded.range.spacing_m, 1e-12);
  EXPECT_NEAR(given.range.first_m, 1.01 * recorded.range.first_m, 1e-12);
  params.sound_speed_mps = 0.0;
  params.sound_speed_profile = {{0.0, 1600.0}};
  EXPECT_EQ(test::opened(folder, params).observations.at(0).sound_speed_mps, 1600.0);
}

}  // namespace
}  // namespace sonar
