// SPDX-License-Identifier: Apache-2.0
#include "view/colour_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "base/units.h"
#include "view/sv_scale.h"

namespace sonar {
namespace {

int distance(Rgba8 a, Rgba8 b) { return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}); }

TEST(ColourMap, NamesLeadBackToTheirMaps) {
  ASSERT_EQ(colour_map_names().size(), static_cast<std::size_t>(kColourMaps));
  for (int i = 0; i < kColourMaps; ++i) {
    const auto name = static_cast<ColourMapName>(i);
    EXPECT_EQ(colour_map_named(colour_map_names()[static_cast<std::size_t>(i)]), name);
  }
  EXPECT_FALSE(colour_map_named("jet").has_value());
}

// The published tables of EK500 colours, weakest to strongest.
TEST(ColourMap, Ek500HasTheTwelveColours) {
  const std::vector<Rgba8> expected = {{159, 159, 159, 255}, {95, 95, 95, 255}, {0, 0, 255, 255},   {0, 0, 127, 255},
                                       {0, 191, 0, 255},     {0, 127, 0, 255},  {255, 255, 0, 255}, {255, 127, 0, 255},
                                       {255, 0, 191, 255},   {255, 0, 0, 255},  {166, 83, 60, 255}, {120, 60, 40, 255}};
  EXPECT_EQ(colour_map(ColourMapName::ek500).knots, expected);
}

// Known values: white 100, black 0, red 53.24, green 87.73, blue 32.30 (sRGB, D65).
TEST(ColourMap, LightnessOfKnownColours) {
  EXPECT_NEAR(lightness({255, 255, 255, 255}), 100.0, 0.01);
  EXPECT_NEAR(lightness({0, 0, 0, 255}), 0.0, 0.01);
  EXPECT_NEAR(lightness({255, 0, 0, 255}), 53.24, 0.01);
  EXPECT_NEAR(lightness({0, 255, 0, 255}), 87.73, 0.01);
  EXPECT_NEAR(lightness({0, 0, 255, 255}), 32.30, 0.01);
}

TEST(ColourMap, EvenMapsAreMonotoneInLightness) {
  for (int i = static_cast<int>(ColourMapName::viridis); i < kColourMaps; ++i) {
    const ColourMap& map = colour_map(static_cast<ColourMapName>(i));
    const double sign = lightness(map.at(1.0)) > lightness(map.at(0.0)) ? 1.0 : -1.0;
    EXPECT_GT(sign * (lightness(map.at(1.0)) - lightness(map.at(0.0))), 55.0);
    for (int k = 1; k <= 100; ++k) {
      // Rounding to 8 bits may take 0.3 of lightness from a step.
      EXPECT_GT(sign * (lightness(map.at(k / 100.0)) - lightness(map.at((k - 1) / 100.0))), -0.3)
          << colour_map_names()[static_cast<std::size_t>(i)] << " at " << k;
    }
  }
}

// Rows 7, 100 and 200 of the 256 in the published tables; none is one of the knots but 100 and 200.
TEST(ColourMap, InterpolationKeepsToThePublishedTables) {
  struct Row {
    ColourMapName map;
    std::array<Rgba8, 3> at_7_100_200;
    int error;
  };
  const std::vector<Row> rows = {
      {ColourMapName::viridis, {{{70, 11, 94, 255}, {42, 118, 142, 255}, {112, 207, 87, 255}}}, 1},
      {ColourMapName::cividis, {{{0, 40, 89, 255}, {101, 104, 112, 255}, {196, 180, 104, 255}}}, 4},
      {ColourMapName::thermal, {{{5, 40, 65, 255}, {136, 82, 141, 255}, {251, 159, 61, 255}}}, 1},
      {ColourMapName::haline, {{{45, 26, 125, 255}, {43, 123, 137, 255}, {139, 209, 96, 255}}}, 1},
      {ColourMapName::dense, {{{218, 235, 236, 255}, {115, 147, 227, 255}, {106, 39, 119, 255}}}, 1},
      {ColourMapName::deep, {{{239, 248, 196, 255}, {83, 170, 163, 255}, {65, 68, 129, 255}}}, 1},
  };
  for (const Row& row : rows) {
    const std::array<int, 3> places = {7, 100, 200};
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LE(distance(colour_map(row.map).at(places[i] / 255.0), row.at_7_100_200[i]), row.error)
          << static_cast<int>(row.map) << " row " << places[i];
    }
  }
}

TEST(SvScale, Ek500StepsBeginAtTheirLimits) {
  SvScale scale;
  scale.map = ColourMapName::ek500;
  scale.low_db = -70.0;
  const SvColours colours = sv_colours(scale);
  const auto& knots = colour_map(ColourMapName::ek500).knots;
  for (int count = -32767; count <= 32767; ++count) {
    const double sv_db = db_from_counts(count);
    Rgba8 expected{0, 0, 0, 0};
    for (int k = 0; k < 12; ++k) {
      if (sv_db >= -70.0 + 3.0 * k) expected = knots[static_cast<std::size_t>(k)];
    }
    ASSERT_EQ(colours[static_cast<std::int16_t>(count)], expected) << sv_db;
  }
  EXPECT_EQ(colours.bar, knots);
  EXPECT_DOUBLE_EQ(colours.step_db, 3.0);
  EXPECT_DOUBLE_EQ(colours.high_db, -34.0);
}

TEST(SvScale, ThresholdAndLimitsAreTwoThings) {
  SvScale scale;
  scale.map = ColourMapName::viridis;
  const SvColours open = sv_colours(scale);
  scale.threshold_db = -50.0;
  const SvColours cut = sv_colours(scale);
  EXPECT_EQ(open.bar, cut.bar);
  for (int count = -32767; count <= 32767; ++count) {
    const auto c = static_cast<std::int16_t>(count);
    // Nothing is drawn below the lower limit; above the upper one the last colour goes on.
    ASSERT_EQ(open[c].a, db_from_counts(count) < scale.low_db ? 0 : 255);
    ASSERT_EQ(cut[c], db_from_counts(count) < -50.0 ? (Rgba8{0, 0, 0, 0}) : open[c]);
  }
  scale.no_data = {1, 2, 3, 255};
  EXPECT_EQ(sv_colours(scale)[kNoData], (Rgba8{1, 2, 3, 255}));
}

TEST(SvScale, TheTransferFunctionHasTheSameColours) {
  for (const ColourMapName map : {ColourMapName::ek500, ColourMapName::ek500_smooth, ColourMapName::haline}) {
    SvScale scale;
    scale.map = map;
    scale.threshold_db = -55.5;
    const auto transfer = transfer_function(scale, 0.6, 10.0);
    ASSERT_TRUE(transfer.has_value());
    const SvColours by_scale = sv_colours(scale);
    for (double sv_db = -54.995; sv_db < -20.0; sv_db += 0.0117) {
      const auto count = static_cast<std::int16_t>(std::lround(counts_from_db(sv_db)));
      const Rgba8 expected = by_scale[count];
      const auto rgb = transfer->colour(db_from_counts(count));
      ASSERT_NEAR(255.0 * rgb[0], expected.r, 1.01) << sv_db;
      ASSERT_NEAR(255.0 * rgb[1], expected.g, 1.01) << sv_db;
      ASSERT_NEAR(255.0 * rgb[2], expected.b, 1.01) << sv_db;
    }
    EXPECT_EQ(transfer->opacity(-55.6), 0.0);
    EXPECT_NEAR(transfer->opacity(-24.0), 0.6, 1e-6);
    EXPECT_NEAR(transfer->opacity((-55.5 - 24.0) / 2), 0.3, 1e-6);
    const SvScale back = sv_scale(*transfer, map);
    EXPECT_NEAR(back.low_db, -60.0, 1e-5);
    EXPECT_NEAR(back.span_db, 36.0, 1e-5);
  }
}

TEST(SvScale, AThresholdAboveTheLimitsHasNoTransferFunction) {
  SvScale scale;
  scale.threshold_db = scale.high_db();
  EXPECT_EQ(transfer_function(scale).error().code, ErrorCode::bad_parameter);
  EXPECT_EQ(transfer_function(SvScale{}, 1.5).error().code, ErrorCode::bad_parameter);
}

TEST(SvScale, ATransferFunctionColoursSlicesByItsOpacity) {
  const auto transfer = TransferFunction::make({{-60.0, 0.0, {1, 0, 0}}, {-40.0, 1.0, {0, 0, 1}}}, 10.0);
  const SvColours colours = sv_colours(*transfer, -58.0);
  const auto middle = static_cast<std::int16_t>(std::lround(counts_from_db(-50.0)));
  EXPECT_NEAR(colours[middle].a, 127.5, 1.0);
  EXPECT_NEAR(colours[middle].r, 127.5, 1.0);
  EXPECT_NEAR(colours[middle].b, 127.5, 1.0);
  EXPECT_EQ(colours[static_cast<std::int16_t>(counts_from_db(-59.0))].a, 0);
  EXPECT_DOUBLE_EQ(colours.low_db, -60.0);
  EXPECT_DOUBLE_EQ(colours.high_db, -40.0);
}

}  // namespace
}  // namespace sonar
