// SPDX-License-Identifier: Apache-2.0
#include "session/tools/measurement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/units.h"

namespace sonar {
namespace {

MeasuredEnd place(double x, double y, double z) {
  MeasuredEnd end;
  end.place = Point<Sonar>{x, y, z};
  return end;
}

TEST(LineFigures, TurnWithTheShip) {
  // 30 m ahead and 40 m to starboard, 120 m deeper: 50 m horizontal, 130 m slant, 53.13 degrees from the bow.
  for (const double heading_deg : {0.0, 90.0, 310.0}) {
    Placement placement;
    placement.heading_rad = rad_from_deg(heading_deg);
    const LineFigures line = line_figures(place(10, 5, 20), place(40, 45, 140), placement, true);
    EXPECT_NEAR(line.horizontal_m, 50.0, 1e-12);
    EXPECT_NEAR(line.slant_m, 130.0, 1e-12);
    EXPECT_NEAR(line.deeper_m, 120.0, 1e-12);
    EXPECT_NEAR(line.bearing_deg, std::fmod(heading_deg + 53.13010235415598, 360.0), 1e-9);
    EXPECT_FALSE(line.from_bow);
  }
  const LineFigures unheaded = line_figures(place(40, 45, 140), place(10, 5, 20), {}, false);
  EXPECT_TRUE(unheaded.from_bow);
  EXPECT_NEAR(unheaded.bearing_deg, 53.13010235415598 - 180.0, 1e-9);
  EXPECT_NEAR(unheaded.deeper_m, -120.0, 1e-12);
}

TEST(LineFigures, OfBeamsFixedToTheHullAreThoseOfTheLevelWater) {
  Placement rolled;
  rolled.roll_rad = rad_from_deg(90.0);  // port up: what was to starboard is below
  const LineFigures line = line_figures(place(0, 0, 0), place(0, 100, 0), rolled, true);
  EXPECT_NEAR(line.slant_m, 100.0, 1e-9);
  EXPECT_NEAR(line.horizontal_m, 0.0, 1e-9);
  EXPECT_NEAR(line.deeper_m, 100.0, 1e-9);
  EXPECT_TRUE(std::isnan(line.bearing_deg)) << "upright: no bearing";
}

TEST(MeasurementText, SaysOnlyWhatIsKnown) {
  Measurement measured;
  measured.shape = Measurement::Shape::box;
  measured.slice = TopSlice{7};
  EXPECT_EQ(whole_text(measured), "box: 0 voxels in fan 7 alone");
  EchoStatistics& echo = measured.area.statistics.echo;
  echo.voxels = 1204;
  echo.heard = 1200;
  echo.volume_m3 = 31250.0;
  measured.area.never = 3;
  measured.area.statistics.extents.depth_min_m = 12.04;
  measured.area.statistics.extents.depth_max_m = 40.26;
  EXPECT_EQ(brief_text(measured),
            "1 204 voxels in fan 7 alone\n3.12e+04 m\u00B3\nno echo above the noise\ndepth 12.0 to 40.3 m\n"
            "4 faulty left out\n3 near transducer, surface or seabed left out");
  echo.sv_mean_db = -48.24;
  echo.sv_max_db = -40.06;
  echo.backscatter_m2 = 0.012345;
  measured.area.fans = 20;
  EXPECT_THAT(whole_text(measured),
              testing::HasSubstr("in all 20 fans, 3.12e+04 m\u00B3, mean Sv -48.2 dB, max -40.1 dB, "
                                 "\u03C3_bs 0.0123 m\u00B2, depth 12.0"));
}

TEST(MeasurementText, ABearingJustBelowNorthIsNorth) {
  Measurement measured;
  measured.on = Measurement::On::map;
  measured.line.horizontal_m = 1852.0;
  measured.line.bearing_deg = 359.97;
  EXPECT_EQ(brief_text(measured), "1 852 m, 1.000 nmi\nbearing 000.0\u00B0");
}

}  // namespace
}  // namespace sonar
