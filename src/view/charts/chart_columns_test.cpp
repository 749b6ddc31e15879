// SPDX-License-Identifier: Apache-2.0
#include "view/charts/chart_columns.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "model/school.h"
#include "view/charts/chart_axes.h"

namespace sonar {
namespace {

// Those of INTERFACES section 3 without its columns of words.
TEST(ChartColumns, AreTheTablesNumbersAndTimes) {
  EXPECT_EQ(chart_columns(ChartTable::school_pings).size(), 100U - 1U);
  EXPECT_EQ(chart_columns(ChartTable::schools).size(), 111U - 9U);
  EXPECT_EQ(chart_column(ChartTable::schools, "species"), nullptr);
  EXPECT_EQ(chart_column(ChartTable::schools, "ping_index"), nullptr);
  EXPECT_TRUE(chart_column(ChartTable::school_pings, "time_utc")->time);
  EXPECT_EQ(chart_column(ChartTable::schools, "time_utc")->name, "first_time_utc");
  EXPECT_TRUE(chart_column(ChartTable::school_pings, "bearing_deg")->degrees);
  EXPECT_TRUE(chart_column(ChartTable::school_pings, "latitude")->degrees);
  EXPECT_TRUE(chart_column(ChartTable::school_pings, "n_voxels")->whole);
}

TEST(ChartColumns, NamesOfBothTablesStandOnce) {
  const ChoiceNames names = chart_column_names();
  for (const ChartTable table : {ChartTable::school_pings, ChartTable::schools}) {
    for (const ChartColumn& column : chart_columns(table)) {
      EXPECT_EQ(std::count(names.begin(), names.end(), column.name), 1) << column.name;
    }
  }
}

TEST(ChartColumns, LabelsHaveUnitsAsPeopleWriteThem) {
  const auto label = [](const char* name, int power = 0) {
    const ChartColumn* column = chart_column(ChartTable::school_pings, name);
    if (column == nullptr) column = chart_column(ChartTable::schools, name);
    return axis_label(*column, power);
  };
  EXPECT_EQ(label("depth_m"), "depth (m)");
  EXPECT_EQ(label("volume_m3"), "volume (m³)");
  EXPECT_EQ(label("sv_mean_db"), "Sv mean (dB re 1 m⁻¹)");
  EXPECT_EQ(label("speed_mps"), "speed (m s⁻¹)");
  EXPECT_EQ(label("backscatter_m2", -6), "backscatter (10⁻⁶ m²)");
  EXPECT_EQ(label("time_utc"), "time (UTC)");
  EXPECT_EQ(label("latitude"), "latitude (degrees north)");
  EXPECT_EQ(label("n_voxels"), "number of voxels");
  EXPECT_EQ(label("snr_db"), "SNR (dB)");
  EXPECT_EQ(label("nasc_m2_nmi2"), "NASC (m² nautical mile⁻²)");
  EXPECT_EQ(label("surface_m2"), "surface (m²)");
  EXPECT_EQ(label("sv_variation"), "Sv variation");
}

TEST(ChartColumns, ValuesAreToldWithTheirUnits) {
  const auto text = [](const char* name, double value) {
    return column_text(*chart_column(ChartTable::school_pings, name), value);
  };
  EXPECT_EQ(text("sv_mean_db", -48.2), "\u221248.2 dB re 1 m⁻¹");
  EXPECT_EQ(text("depth_m", std::nan("")), "unknown");
  EXPECT_EQ(text("ping_index", 17.0), "17");
  EXPECT_EQ(text("latitude", 60.123456), "60.12346 degrees north");
  EXPECT_EQ(text("time_utc", 1'578'124'850.0), "2020-01-04 08:00:50 UTC");
}

TEST(ChartAxes, TicksLieOnTheAxisAtRoundNumbersAndAreWrittenShort) {
  const Theme theme = light_theme({800, 600});
  struct Case {
    const char* column;
    std::vector<double> values;
  };
  const std::vector<Case> cases{{"depth_m", {20.0, 87.3}},
                                {"backscatter_m2", {1.2e-6, 9.4e-5}},
                                {"volume_m3", {1e3, 4.2e7}},
                                {"n_beams", {3.0, 4.0}},
                                {"latitude", {60.00012, 60.0009}},
                                {"bearing_deg", {0.0, 359.0}},
                                {"ping_index", {5.0}},
                                {"time_utc", {1'578'124'850.0, 1'578'125'850.0}},
                                {"sv_mean_db", {-48.2, -48.2}},
                                {"time_utc", {1'578'124'850.0}}};
  for (const Case& one : cases) {
    const ChartAxis axis = chart_axis(*chart_column(ChartTable::school_pings, one.column), one.values);
    for (const double value : one.values) {
      EXPECT_GT(value, axis.low) << one.column;
      EXPECT_LT(value, axis.high) << one.column;
    }
    const auto ticks = ticks_across(axis, 500.0, theme);
    ASSERT_GE(ticks.size(), 1U) << one.column;
    double end = -1e300;
    const double px = 500.0 / (axis.high - axis.low);
    for (const ChartTick& tick : ticks) {
      EXPECT_GE(tick.at, axis.low);
      EXPECT_LE(tick.at, axis.high);
      EXPECT_LE(tick.text.size(), 14U) << tick.text;
      const double half = text_width_px(tick.text.c_str(), theme.text_px) / 2.0;
      const double middle = (tick.at - axis.low) * px;
      EXPECT_GT(middle - half, end) << one.column << ": " << tick.text << " lies on another";
      end = middle + half;
      if (axis.column.whole) {
        EXPECT_EQ(tick.at, std::round(tick.at)) << "no half beams";
      }
    }
  }
}

}  // namespace
}  // namespace sonar
