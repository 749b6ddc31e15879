// SPDX-License-Identifier: Apache-2.0
#include "pipeline/survey/cast_files.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/survey/sound_profile.h"

namespace sonar {
namespace {

constexpr const char* kHeader =
    "* Sea-Bird SBE 9 Data File:\n# name 0 = prDM: Pressure, Digiquartz [db]\n"
    "# name 1 = t090C: Temperature [ITS-90, deg C]\n# name 2 = t190C: Temperature, 2 [ITS-90, deg C]\n"
    "# name 3 = sal00: Salinity, Practical [PSU]\n";

// Published: 25 degrees, 35 psu and 1000 m make 1550.744 m/s (Mackenzie), and 1000 dbar at 45 degrees are 989.26 m (Saunders:
// (1 - 0.00592 - 0.00525 / 2) 1000 - 2.21). Lines that go up again, and bad ones, are left out.
TEST(CastFiles, SeaBirdsCast) {
  const auto made = profile_from_bytes(std::string(kHeader) +
                                           "*END*\n     10.0   8.0 99 35.0\r\n 1000.0  25.0 99  35.0\n\n 900 8 99 35\n"
                                           " 1100 -9.990e-29 99 35\n",
                                       "a.cnv");
  ASSERT_TRUE(made) << made.error().text;
  ASSERT_EQ(made->size(), 2U);
  EXPECT_NEAR((*made)[1].depth_m, 989.245, 1e-6);
  EXPECT_NEAR((*made)[1].sound_speed_mps, 1550.744 - 0.0163 * (1000.0 - 989.245), 0.01);
  const auto measured = profile_from_bytes(
      "* Sea-Bird\n# name 0 = depSM: Depth [salt water, m]\n# name 1 = svCM: Sound Velocity [Chen-Millero, m/s]\n"
      "*END*\n 5 1490\n 20 1485.5\n",
      "b.cnv");
  ASSERT_TRUE(measured) << measured.error().text;
  EXPECT_EQ(*measured, (SoundProfile{{5.0, 1490.0}, {20.0, 1485.5}}));
}

// Of a cast without its way down all lines are taken; a pressure in another unit is none.
TEST(CastFiles, OnlyTheWayUp) {
  const std::string header =
      "* Sea-Bird\n# name 0 = depSM: Depth [salt water, m]\n# name 1 = svCM: Sound Velocity [Chen-Millero, m/s]\n";
  const auto up = profile_from_bytes(header + "*END*\n 80 1485\n 81 1484\n 40 1488\n 5 1490\n", "up.cnv");
  ASSERT_TRUE(up) << up.error().text;
  EXPECT_EQ(*up, (SoundProfile{{5.0, 1490.0}, {40.0, 1488.0}, {81.0, 1484.0}}));
  EXPECT_FALSE(
      profile_from_bytes("* Sea-Bird\n# name 0 = prdE: Pressure, Strain Gauge [psi]\n"
                         "# name 1 = svCM: Sound Velocity [Chen-Millero, m/s]\n*END*\n 10 1490\n",
                         "psi.cnv"));
}

TEST(CastFiles, RefusalsNameTheFileAndThePlace) {
  for (const std::string& wrong :
       {std::string(kHeader) + "*END*\n 10 8 x 35\n", std::string("* Sea-Bird\n# name 0 = flag\n*END*\n0\n"),
        std::string("%TSD\0\0\x40\x41", 8), std::string("depth_m,speed\n")}) {
    const auto refused = profile_from_bytes(wrong, "wrong.ctd");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().where.file, "wrong.ctd");
  }
  EXPECT_NE(profile_from_bytes(std::string(kHeader) + "*END*\n 10 8 x 35\n", "a").error().text.find("line 7"),
            std::string::npos);
}

// A real cast of the Barents Sea's edge: 254 lines from 5 to 258 dbar. Its measured speeds are those that Mackenzie makes of its
// temperatures and salinities at these depths within 0.2 m/s, so the depths are right.
TEST(CastFiles, ARealCast) {
  const std::filesystem::path cast = "../shared/data/sta0219.ctd";
  const char* source = std::getenv("SONAR_SOURCE");
  const std::filesystem::path path = std::filesystem::path(source == nullptr ? "." : source) / cast;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  const auto made = read_sound_profile(path);
  ASSERT_TRUE(made) << made.error().text;
  EXPECT_EQ(made->size(), 254U);
  EXPECT_NEAR(made->front().depth_m, 4.95, 0.02);
  EXPECT_NEAR(made->front().sound_speed_mps, 1472.91, 0.001);
  EXPECT_NEAR(made->back().depth_m, 255.3, 0.2);
  EXPECT_NEAR(made->back().sound_speed_mps, 1483.16, 0.001);
}

}  // namespace
}  // namespace sonar
