// SPDX-License-Identifier: Apache-2.0
#include "io/current_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "io/atomic_file.h"
#include "io/cf_time.h"
#include "io/netcdf_file.h"
#include "io/simrad/test_bytes.h"

namespace sonar {
namespace {

using testing::HasSubstr;

/// What a file of two times and three bins is made of; each test changes some of it.
struct Made {
  std::string time_units = "days since 2009-01-01 00:00:00";
  std::string velocity_units = "m s-1";
  std::string east = "u";
  std::string north = "v";
  std::string east_standard_name;
  bool depth_by_time = true;
  bool bins_first = false;
  bool north_turned = false;                 ///< over bins and times where east is over times and bins
  std::vector<double> time = {10.25, 10.5};  // 2009-01-11 06:00 and 12:00
  std::vector<float> u = {0.125F, 0.25F, 1e38F, 0.5F, -0.75F, 0.0F};
  std::vector<float> v = {-0.125F, -0.25F, 1e38F, 0.0F, 0.5F, 0.25F};
  std::vector<float> depth = {20, 28, 36, 20, 28, 36};
  std::vector<double> flags;
};

std::filesystem::path written(const std::filesystem::path& path, const Made& made) {
  netcdf::Writer w(path.string());
  const auto time = w.dimension(w.root(), "time", made.time.size());
  const auto bin = w.dimension(w.root(), "depth_cell", 3);
  const auto grid = made.bins_first ? std::vector{bin, time} : std::vector{time, bin};
  w.variable(w.root(), "time", made.time_units, {time}, made.time);
  const float fill = 1e38F;
  const int u = w.variable(w.root(), made.east, made.velocity_units, grid, made.u, netcdf::Storage::plain, &fill);
  if (!made.east_standard_name.empty()) w.attribute(w.root(), u, "standard_name", made.east_standard_name);
  w.variable(w.root(), made.north, made.velocity_units, made.north_turned ? std::vector{bin, time} : grid, made.v,
             netcdf::Storage::plain, &fill);
  w.variable(w.root(), "depth", "meter", made.depth_by_time ? grid : std::vector{bin}, made.depth);
  w.variable(w.root(), "lat", "degrees_north", {time}, std::vector{60.0, 60.1});
  w.variable(w.root(), "lon", "degrees_east", {time}, std::vector{184.0, -3.5});
  if (!made.flags.empty()) w.variable(w.root(), "pflag", "", grid, made.flags);
  auto file = AtomicFile::create(path);
  EXPECT_TRUE(file && w.close_into(*file) && file->commit());
  return path;
}

class CurrentFile : public testing::Test {
 protected:
  [[nodiscard]] Result<CurrentProfiles> read(const Made& made) const {
    return read_currents(written(folder_.path() / "adcp.nc", made));
  }
  [[nodiscard]] std::string refused(const Made& made) const {
    const auto found = read(made);
    return found ? "" : to_line(found.error());
  }
  test::TemporaryFolder folder_;
};

TEST_F(CurrentFile, AsUhdasWritesIt) {
  const auto found = read({});
  ASSERT_TRUE(found) << to_line(found.error());
  ASSERT_EQ(found->size(), 2U);
  EXPECT_EQ(found->front().time, time_from_calendar(2009, 1, 11, 6.0 * 3600.0));
  EXPECT_EQ(found->back().time, time_from_calendar(2009, 1, 11, 12.0 * 3600.0));
  EXPECT_EQ(found->front().place, (Geographic{60.0, -176.0}));
  EXPECT_EQ(found->front().bins, (std::vector<CurrentAt>{{20, 0.125, -0.125}, {28, 0.25, -0.25}}))
      << "filled: left out";
  EXPECT_EQ(found->back().bins, (std::vector<CurrentAt>{{20, 0.5, 0.0}, {28, -0.75, 0.5}, {36, 0.0, 0.25}}));
}

TEST_F(CurrentFile, ByStandardNameWithOneAxisOfDepthsInCentimetres) {
  Made made;
  made.east = "water_to_the_right";
  made.east_standard_name = "eastward_sea_water_velocity";
  made.north = "VCUR";
  made.velocity_units = "cm/s";
  made.depth_by_time = false;
  made.depth = {20, 28, 36};
  made.u = {12.5F, 25.0F, 1e38F, 50.0F, -75.0F, 0.0F};
  made.v = {-12.5F, -25.0F, 1e38F, 0.0F, 50.0F, 25.0F};
  const auto found = read(made);
  ASSERT_TRUE(found) << to_line(found.error());
  EXPECT_EQ(found->front().bins, (std::vector<CurrentAt>{{20, 0.125, -0.125}, {28, 0.25, -0.25}}));
}

TEST_F(CurrentFile, BinsMayComeBeforeTimes) {
  Made made;
  made.bins_first = true;
  made.depth_by_time = false;
  made.depth = {20, 28, 36};
  made.u = {0.125F, 0.5F, 0.25F, -0.75F, 1e38F, 0.0F};
  made.v = {-0.125F, 0.0F, -0.25F, 0.5F, 1e38F, 0.25F};
  const auto found = read(made);
  ASSERT_TRUE(found) << to_line(found.error());
  EXPECT_EQ(found->back().bins, (std::vector<CurrentAt>{{20, 0.5, 0.0}, {28, -0.75, 0.5}, {36, 0.0, 0.25}}));
}

TEST_F(CurrentFile, FlaggedValuesAreLeftOutAndTimesAreSorted) {
  Made made;
  made.flags = {0, 1, 0, 0, 0, 0};
  made.time = {10.5, 10.25};
  const auto found = read(made);
  ASSERT_TRUE(found) << to_line(found.error());
  EXPECT_EQ(found->back().bins, (std::vector<CurrentAt>{{20, 0.125, -0.125}})) << "the later of the two";
}

TEST_F(CurrentFile, RefusesInOneLineWhatItDoesNotKnow) {
  Made made;
  made.velocity_units = "knots";
  EXPECT_THAT(refused(made), HasSubstr("'u' has the unit 'knots': expected m s-1 or cm s-1"));
  made = {};
  made.time_units = "ticks";
  EXPECT_THAT(refused(made), HasSubstr("'time' has the unit 'ticks': expected days since"));
  made = {};
  made.north = "w";
  EXPECT_THAT(refused(made), HasSubstr("there is no variable of standard name northward_sea_water_velocity"));
  made = {};
  made.u.assign(6, 1e38F);
  EXPECT_THAT(refused(made), HasSubstr("no current is told"));
  EXPECT_THAT(refused(made), HasSubstr("adcp.nc"));
}

// Days that no recipe can tell, and no clock of 64 bits: as fill values that are not declared.
TEST_F(CurrentFile, TimesOutOfAllReasonAreLeftOut) {
  for (const double days : {1e5, -1e4, 9e4, 1e30, -1e30}) {
    Made made;
    made.time_units = "days since 2199-12-01";
    made.time = {10.0, days};
    const auto found = read(made);
    ASSERT_TRUE(found) << to_line(found.error());
    EXPECT_EQ(found->size(), days == -1e4 ? 2U : 1U) << days;
    EXPECT_EQ(found->back().time, time_from_calendar(2199, 12, 11, 0.0));
  }
}

TEST_F(CurrentFile, VelocitiesOverOtherAxesAreRefused) {
  Made made;
  made.north_turned = true;
  EXPECT_THAT(refused(made), HasSubstr("'v': expected values over time, depth_cell"));
}

TEST_F(CurrentFile, SurvivesDamage) {
  const auto path = written(folder_.path() / "adcp.nc", {});
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  EXPECT_FALSE(read_currents(path));
  std::ofstream(path) << "no netCDF at all";
  EXPECT_FALSE(read_currents(path));
  EXPECT_FALSE(read_currents(folder_.path() / "none.nc"));
}

// Days from the calendar by hand: 2000-03-01 is 60 days into a leap year.
TEST(CfTime, ReadsUnits) {
  const auto at = [](const char* units, double value) {
    const auto axis = cf::time_axis(units);
    return axis ? axis->origin + static_cast<TimeNs>(value * axis->unit_s * 1e9) : TimeNs{-1};
  };
  EXPECT_EQ(at("days since 2000-01-01", 60), time_from_calendar(2000, 3, 1, 0));
  EXPECT_EQ(at("hours since 2000-01-01T06:00:00Z", 18), time_from_calendar(2000, 1, 2, 0));
  EXPECT_EQ(at("seconds since 1970-1-1 0:0:0", 86400), time_from_calendar(1970, 1, 2, 0));
  EXPECT_EQ(at("minutes since 2000-01-01 00:30:15.5 UTC", 1), time_from_calendar(2000, 1, 1, 1875.5));
  EXPECT_EQ(at("days since 1950-01-01T00:00:00Z", 7305), time_from_calendar(1970, 1, 1, 0)) << "20 years, 5 leap days";
  for (const char* bad :
       {"", "days", "days since", "years since 2000-01-01", "days since yesterday", "days since 2000-13-01",
        "days since 2000-01-01 00:00:00 +2:00", "days since 2000-01-01 25:xx", "days since 2000-01-01 25:00",
        "days since 2001-02-29", "days since 2000-400-01"}) {
    EXPECT_FALSE(cf::time_axis(bad)) << bad;
  }
}

}  // namespace
}  // namespace sonar
