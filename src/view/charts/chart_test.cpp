// SPDX-License-Identifier: Apache-2.0
#include "view/charts/chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "view/charts/chart_marks.h"

namespace sonar {
namespace {

constexpr PixelSize kSize{640, 480};
constexpr TimeNs kStart = 1'578'124'800 * kSecondNs;  // 2020-01-04 08:00

/// Schools of an observation: rows are added ping by ping.
struct Table {
  explicit Table(std::string name = "obs-0001") {
    product.observation = name;
    product.title = "SYNTHETIC survey " + name;
  }
  SchoolPingRow& row(std::int64_t school, std::int64_t ping) {
    if (product.schools.empty() || product.schools.back().school_id != school) {
      product.schools.emplace_back();
      product.schools.back().school_id = school;
    }
    SchoolPingRow& one = product.school_pings.emplace_back();
    one.school_id = school;
    one.ping_index = ping;
    one.time_utc = kStart + 2 * ping * kSecondNs;
    one.depth_m = 50.0 + static_cast<double>(ping);
    one.sv_mean_db = -50.0 + static_cast<double>(school);
    one.volume_m3 = 1000.0;
    return one;
  }
  ObservationProduct product;
};

ChartData data_of(const ObservationProduct& product, const std::string& x, const std::string& y) {
  auto data = chart_data(std::span(&product, 1), {ChartTable::school_pings, x, y});
  EXPECT_TRUE(data) << to_line(data.error());
  return std::move(*data);
}

Chart drawn(const ChartData& data, const ChartStyle& style = {}, PixelSize size = kSize) {
  auto made = chart(data, style, size, light_theme(size));
  EXPECT_TRUE(made) << to_line(made.error());
  return std::move(*made);
}

std::vector<std::string> texts(const FrameDescription& frame) {
  std::vector<std::string> out;
  for (const auto& item : frame.items) {
    if (const auto* text = std::get_if<TextItem>(&item)) out.push_back(text->text);
  }
  return out;
}

std::vector<PathItem> paths(const FrameDescription& frame) {
  std::vector<PathItem> out;
  for (const auto& item : frame.items) {
    if (const auto* path = std::get_if<PathItem>(&item)) out.push_back(*path);
  }
  return out;
}

/// Many rows at random places.
ObservationProduct scattered(int rows, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  Table table;
  for (int i = 0; i < rows; ++i) {
    SchoolPingRow& row = table.row(1 + i * 20 / rows, i);
    row.depth_m = i % 23 == 0 ? std::nan("") : 20.0 + 200.0 * any(random);
    row.volume_m3 = i % 31 == 0 ? std::nan("") : 1e5 * any(random);
  }
  return table.product;
}

// What lies inside is told by the values at the rectangle's corners, not by the places of points.
TEST(Chart, ABrushHasExactlyTheRowsInsideIt) {
  const ChartData data = data_of(scattered(700, 3), "volume_m3", "depth_m");
  const Chart made = drawn(data);
  const PlotFrame& plot = made.places.plot;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> across(plot.place.x, plot.place.x + plot.place.width);
  std::uniform_real_distribution<double> down(plot.place.y, plot.place.y + plot.place.height);
  std::size_t found = 0;
  for (int i = 0; i < 100; ++i) {
    const PixelPoint a{across(random), down(random)};
    const PixelPoint b{across(random), down(random)};
    const auto [x_low, x_high] = std::minmax({plot.x_at(a.x), plot.x_at(b.x)});
    const auto [y_low, y_high] = std::minmax({plot.y_at(a.y), plot.y_at(b.y)});
    std::vector<std::size_t> inside;
    for (std::size_t row = 0; row < data.rows.size(); ++row) {
      const double x = data.x_values[row];
      const double y = data.y_values[row];
      if (x >= x_low && x <= x_high && y >= y_low && y <= y_high) inside.push_back(row);
    }
    EXPECT_EQ(rows_within(made.places, a, b), inside);
    found += inside.size();
  }
  EXPECT_GT(found, 1000U);
}

TEST(Chart, ThePointerFindsTheNearestPointWithinItsReach) {
  const ChartData data = data_of(scattered(200, 5), "volume_m3", "depth_m");
  const Chart made = drawn(data, {.reach_px = 6.0});
  for (std::size_t row = 0; row < data.rows.size(); ++row) {
    const PixelPoint at = made.places.points[row];
    EXPECT_EQ(std::isnan(at.x), !data.known(row));
    if (std::isnan(at.x)) continue;
    const auto found = row_at(made.places, {at.x + 0.01, at.y});
    ASSERT_TRUE(found);
    EXPECT_LE(std::hypot(made.places.points[*found].x - at.x, made.places.points[*found].y - at.y), 0.02);
  }
  EXPECT_FALSE(row_at(made.places, {-20.0, -20.0}));
}

TEST(Chart, BarsHoldEveryRowOnceAndAreAsHighAsTheyAreMany) {
  const ChartData data = data_of(scattered(700, 4), "depth_m", "");
  const Chart made = drawn(data);
  std::vector<int> seen(data.rows.size());
  for (const ChartPlaces::Bar& bar : made.places.bars) {
    for (const std::size_t row : bar.rows) {
      ++seen[row];
      EXPECT_GE(data.x_values[row], bar.from);
      EXPECT_LT(data.x_values[row], bar.to);
    }
    const double top = made.places.plot.y_at(bar.place.y);
    EXPECT_NEAR(top, static_cast<double>(bar.rows.size()), 1e-6);
    const PixelPoint middle{bar.place.x + 0.5 * bar.place.width, bar.place.y + 0.5 * bar.place.height};
    EXPECT_EQ(bar_at(made.places, middle), &bar);
    EXPECT_EQ(rows_within(made.places, middle, middle), bar.rows);
  }
  for (std::size_t row = 0; row < seen.size(); ++row) EXPECT_EQ(seen[row], data.known(row) ? 1 : 0);
}

// Pings 0 1 2 | 4 5, of 5 the depth is unknown, and another school's 6.
TEST(Chart, PointsOfASchoolAreJoinedOverPingsThatFollowOneAnother) {
  Table table;
  for (const std::int64_t ping : {0, 1, 2, 4, 5, 6}) table.row(1, ping);
  table.product.school_pings[4].depth_m = kUnknown;
  table.row(2, 7);
  table.row(2, 8);
  const auto joined = [&](const char* x, const char* y) {
    const ChartData data = data_of(table.product, x, y);
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < data.rows.size(); ++row) {
      if (joins_previous(data, row)) rows.push_back(row);
    }
    return rows;
  };
  EXPECT_EQ(joined("ping_index", "depth_m"), (std::vector<std::size_t>{1, 2, 7}));
  EXPECT_EQ(joined("time_utc", "depth_m"), (std::vector<std::size_t>{1, 2, 7}));
  EXPECT_EQ(joined("volume_m3", "depth_m"), std::vector<std::size_t>{}) << "no order";
  EXPECT_EQ(joined("ping_index", ""), std::vector<std::size_t>{});
  const Chart made = drawn(data_of(table.product, "time_utc", "depth_m"));
  std::vector<std::size_t> lengths;
  for (const PathItem& path : paths(made.frame)) {
    for (const auto& part : path.parts) {
      if (!part.closed && (path.stroke.colour == school_colour(1) || path.stroke.colour == school_colour(2))) {
        lengths.push_back(part.points.size());
      }
    }
  }
  EXPECT_EQ(lengths, (std::vector<std::size_t>{3, 2}));
}

TEST(Chart, PointsHaveTheirSchoolsColoursAndTheSelectedStandOut) {
  Table table;
  table.row(1, 0).depth_m = 20.0;
  table.row(2, 1).depth_m = 30.0;
  table.row(3, 2).depth_m = 40.0;
  table.product.schools[2].status = "rejected";
  const ChartData data = data_of(table.product, "volume_m3", "depth_m");
  const auto filled = [](const Chart& made, Rgba8 colour) {
    std::size_t count = 0;
    for (const PathItem& path : paths(made.frame)) count += path.fill == colour ? 1U : 0U;
    return count;
  };
  const Chart plain = drawn(data);
  EXPECT_EQ(filled(plain, school_colour(1)), 2U) << "its point, and in the key";
  EXPECT_EQ(filled(plain, school_colour(2)), 2U);
  EXPECT_EQ(filled(plain, school_colour(3)), 0U) << "rejected: hollow and grey";
  EXPECT_THAT(texts(plain.frame), testing::IsSupersetOf({"school 1", "school 2", "school 3, rejected"}));
  const Chart one = drawn(data, {.selected = {{0, 2}}});
  EXPECT_EQ(filled(one, school_colour(1)), 1U) << "in the key alone";
  EXPECT_EQ(filled(one, school_colour(2)), 2U);
}

TEST(Chart, TheTitleCountsRowsAndThoseThatAreUnknown) {
  Table table;
  for (int ping = 0; ping < 5; ++ping) table.row(1, ping);
  table.product.school_pings[3].volume_m3 = kUnknown;
  table.product.school_pings[4].volume_m3 = kUnknown;
  const Chart made = drawn(data_of(table.product, "volume_m3", "depth_m"));
  EXPECT_THAT(texts(made.frame), testing::Contains(testing::HasSubstr("3 school pings · 2 left out: unknown")));
  EXPECT_THAT(texts(made.frame), testing::Contains(testing::HasSubstr("SYNTHETIC")));
  const Chart histogram = drawn(data_of(table.product, "depth_m", ""));
  EXPECT_THAT(texts(histogram.frame), testing::Contains(testing::HasSubstr("5 school pings")));
  EXPECT_THAT(texts(histogram.frame), testing::Contains("number of school pings"));
}

TEST(Chart, DepthsRunDownwards) {
  Table table;
  table.row(1, 0);
  table.row(1, 9);
  const Chart made = drawn(data_of(table.product, "ping_index", "depth_m"));
  EXPECT_LT(made.places.points[0].y, made.places.points[1].y);
  const Chart other = drawn(data_of(table.product, "depth_m", "ping_index"));
  EXPECT_GT(other.places.points[0].y, other.places.points[1].y);
}

TEST(Chart, EveryColumnOverEveryOrderHasAPicture) {
  Table table;
  for (int ping = 0; ping < 8; ++ping) {
    SchoolPingRow& row = table.row(1 + ping / 4, ping);
    row.latitude = 60.0 + 1e-4 * ping;
    row.bearing_deg = 40.0 * ping;
  }
  for (const ChartColumn& column : chart_columns(ChartTable::school_pings)) {
    const ChartData over = data_of(table.product, "time_utc", std::string(column.name));
    if (over.known_rows() == 0) continue;
    for (const PixelSize size : {PixelSize{320, 240}, PixelSize{1600, 1200}}) {
      const Chart made = drawn(over, {}, size);
      for (const PixelPoint at : made.places.points) EXPECT_TRUE(inside(made.places.plot.place, at)) << column.name;
      EXPECT_FALSE(drawn(data_of(table.product, std::string(column.name), ""), {}, size).places.bars.empty());
    }
  }
}

TEST(Chart, WhatCannotBeDrawnIsSaid) {
  Table table;
  table.row(1, 0).snr_db = kUnknown;
  const auto unknown = chart_data(std::span(&table.product, 1), {ChartTable::school_pings, "depth", "sv_mean_db"});
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::usage);
  EXPECT_THAT(unknown.error().text,
              testing::HasSubstr("no column depth of numbers or times; it has school_id, ping_index"));
  EXPECT_THAT(unknown.error().text, testing::HasSubstr("depth_m"));
  const auto words = chart_data(std::span(&table.product, 1), {ChartTable::schools, "species", ""});
  ASSERT_FALSE(words);
  const Theme theme = light_theme(kSize);
  const auto nothing = chart(data_of(table.product, "snr_db", ""), {}, kSize, theme);
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().code, ErrorCode::not_found);
  EXPECT_THAT(nothing.error().text, testing::HasSubstr("snr_db is unknown in every row"));
  const auto empty = chart(data_of({}, "depth_m", ""), {}, kSize, theme);
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().text, "there are no schools to chart");
  EXPECT_EQ(chart(data_of(table.product, "depth_m", ""), {}, {60, 30}, theme).error().code, ErrorCode::bad_parameter);
}

TEST(Chart, ManyRowsAreDrawnAsOftenAsTheyCanBeToldApart) {
  const ChartData data = data_of(scattered(100'000, 9), "volume_m3", "depth_m");
  const Chart made = drawn(data, {}, {1200, 900});
  EXPECT_GT(made.frame.items.size(), 1000U);
  EXPECT_LE(made.frame.items.size(), data.known_rows() + 100U);
  Table table;
  for (int ping = 0; ping < 5000; ++ping) table.row(1, ping);
  EXPECT_LT(drawn(data_of(table.product, "volume_m3", "sv_mean_db")).frame.items.size(), 60U) << "one place, one point";
}

}  // namespace
}  // namespace sonar
