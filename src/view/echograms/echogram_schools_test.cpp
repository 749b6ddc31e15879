// SPDX-License-Identifier: Apache-2.0
#include "view/echograms/echogram_schools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <span>
#include <variant>
#include <vector>

#include "view/echograms/stacked_timelines.h"
#include "view/maps/map_example.h"
#include "view/school_look.h"
#include "view/timelines/timeline.h"

namespace sonar {
namespace {

using map_example::says;

/// Whether rings hold a place: even-odd, by a ray to the right.
bool holds(const std::vector<PathItem::Part>& rings, double x, double y) {
  bool in = false;
  for (const PathItem::Part& ring : rings) {
    for (std::size_t i = 0; i < ring.points.size(); ++i) {
      const PixelPoint& a = ring.points[i];
      const PixelPoint& b = ring.points[(i + 1) % ring.points.size()];
      if ((a.y > y) == (b.y > y)) continue;
      if (x < a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)) in = !in;
    }
  }
  return in;
}

TEST(OutlineOfColumns, HoldsExactlyTheCells) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    constexpr int kColumns = 9;
    constexpr int kCells = 8;
    std::vector<std::vector<bool>> in(kColumns, std::vector<bool>(kCells));
    std::vector<OutlinedColumn> columns;
    double x = 3.0;
    std::vector<double> from;
    for (auto& column : in) {
      from.push_back(x);
      for (int c = 0; c < kCells; ++c) column[static_cast<std::size_t>(c)] = random() % 100 < 45;
      OutlinedColumn one{x, x + 2.5, {}};
      for (int c = 0; c < kCells; ++c) {
        if (!column[static_cast<std::size_t>(c)]) continue;
        const int first = c;
        while (c < kCells && column[static_cast<std::size_t>(c)]) ++c;
        one.stretches.emplace_back(1.5 * first, 1.5 * c);
      }
      if (!one.stretches.empty()) columns.push_back(one);
      x += random() % 5 == 0 ? 4.0 : 2.5;  // a gap now and then
    }
    const auto rings = outline_of_columns(columns);
    for (int i = 0; i < kColumns; ++i) {
      for (int c = 0; c < kCells; ++c) {
        const double at_x = from[static_cast<std::size_t>(i)] + 1.2;
        EXPECT_EQ(holds(rings, at_x, 1.5 * c + 0.7), in[static_cast<std::size_t>(i)][static_cast<std::size_t>(c)]);
      }
      EXPECT_FALSE(holds(rings, from[static_cast<std::size_t>(i)] + 1.2, 1.5 * kCells + 0.5));
    }
    EXPECT_FALSE(holds(rings, x + 1.0, 0.7));
  }
}

TEST(OutlineOfColumns, ABlockIsOneRingOfFourCorners) {
  const std::vector<OutlinedColumn> columns{
      {0.0, 1.0, {{2.0, 5.0}}}, {1.0, 2.0, {{2.0, 5.0}}}, {2.0, 3.0, {{2.0, 5.0}}}};
  const auto rings = outline_of_columns(columns);
  ASSERT_EQ(rings.size(), 1U);
  EXPECT_TRUE(rings[0].closed);
  EXPECT_EQ(rings[0].points.size(), 4U);
}

/// A product of 20 pings whose school 3 lies in beams 1 and 2 of fan 1, samples 24 .. 26, pings 5 .. 15.
struct Example {
  ObservationProduct product = map_example::product("obs-0001", 20);
  Sector sector = map_example::grid().grid.sector(map_example::grid().range);
  Example() {
    map_example::add_school(product, 3, product.pings[0].transducer, 5, 15, map_example::block(1, 1, 2, 24, 3));
  }
  [[nodiscard]] RowsOfPing rows(const EchogramOf& of) const {
    return [this, of](std::int64_t ping) {
      return echogram_rows(sector, product.pings[static_cast<std::size_t>(ping)].placement(), of);
    };
  }
};

TEST(EchogramSchools, HaveTheCellsOfTheirSamplesInTheBeamAlone) {
  const Example example;
  const EchogramOf beam{1, 2, EchogramHeight::range};
  const EchogramRange range = echogram_range(example.sector, {}, beam);
  const auto schools = echogram_schools(example.product, example.rows(beam), range, 2, 10);
  ASSERT_EQ(schools.size(), 1U);
  EXPECT_EQ(schools[0].school_id, 3);
  ASSERT_EQ(schools[0].stretches.size(), 7U) << "pings 5 .. 11 of 2 .. 11";
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(schools[0].stretches[i].ping, i + 3);
    EXPECT_DOUBLE_EQ(schools[0].stretches[i].from_m, -1.0 + 2.0 * 24 - 1.0);
    EXPECT_DOUBLE_EQ(schools[0].stretches[i].to_m, -1.0 + 2.0 * 26 + 1.0);
  }
  for (const EchogramOf& other : {EchogramOf{1, 0, EchogramHeight::range}, EchogramOf{2, 2, EchogramHeight::range}}) {
    EXPECT_TRUE(echogram_schools(example.product, example.rows(other), range, 0, 20).empty());
  }
  const EchogramOf fan{1, std::nullopt, EchogramHeight::range};
  EXPECT_EQ(echogram_schools(example.product, example.rows(fan), range, 0, 20).at(0).stretches.size(), 11U);
}

TEST(EchogramSchools, RefusedEchoesAreMarkedInTheirBeam) {
  Example example;
  RefusedEcho echo;
  echo.ping_index = 6;
  echo.echo_id = 1;
  echo.channel = 6;  // fan 1, beam 2
  echo.sample = 10;
  example.product.rejected = {echo};
  const EchogramOf beam{1, 2, EchogramHeight::depth};
  const auto here = echogram_refused(example.product.rejected, example.product.grid->grid, example.rows(beam), 4, 10);
  ASSERT_EQ(here.size(), 1U);
  EXPECT_EQ(here[0].ping_index, 2);
  EXPECT_NEAR(here[0].range_m, 7.0 + 19.0 * std::sin(rad_from_deg(15.0)), 1e-9);
  const EchogramOf other{1, 1, EchogramHeight::depth};
  EXPECT_TRUE(
      echogram_refused(example.product.rejected, example.product.grid->grid, example.rows(other), 0, 20).empty());
}

// Beam 2 of fan 1 has lost half from sample 30 on (3.01 dB); of its fan's four beams' mean that is an eighth (0.58 dB), and
// with three quarters of beam 0 from sample 40 on five sixteenths (1.63 dB). Sample 30 lies at 59 m, its cell begins at 58 m.
TEST(EchogramShadow, LiesWhereTheMeanOfTheBeamsLosesSoMuch) {
  const Example example;
  ASSERT_EQ(example.sector.beams(), 4);
  const int samples = example.sector.range().count;
  std::vector<std::vector<double>> shadow(static_cast<std::size_t>(example.sector.fans() * 4));
  const auto lose = [&](std::size_t row, int from, double factor) {
    shadow[row].assign(static_cast<std::size_t>(samples), 1.0);
    std::fill(shadow[row].begin() + from, shadow[row].end(), factor);
  };
  lose(6, 30, 2.0);
  const EchogramOf beam{1, 2, EchogramHeight::range};
  const EchogramOf fan{1, std::nullopt, EchogramHeight::range};
  const EchogramRange range = echogram_range(example.sector, {}, beam);
  const auto from = [&](const EchogramOf& of, double least_db) {
    const auto found = echogram_shadow(shadow, example.rows(of)(5), range, samples, least_db, 5);
    EXPECT_LE(found.size(), 1U);
    if (found.empty()) return -1.0;
    EXPECT_EQ(found[0].ping, 5U);
    EXPECT_DOUBLE_EQ(found[0].to_m, heights_of(range).last_m);
    return found[0].from_m;
  };
  EXPECT_DOUBLE_EQ(from(beam, 3.0), 58.0);
  EXPECT_EQ(from(beam, 3.1), -1.0);
  EXPECT_EQ(from({1, 1, EchogramHeight::range}, 0.1), -1.0) << "another beam is not in its shadow";
  EXPECT_DOUBLE_EQ(from(fan, 0.5), 58.0);
  EXPECT_EQ(from(fan, 1.0), -1.0);
  lose(4, 40, 4.0);
  EXPECT_DOUBLE_EQ(from(fan, 1.0), 78.0);
  // Below the sonar: the beam goes down by sin 15 deg.
  const EchogramOf depth{1, 2, EchogramHeight::depth};
  const std::vector<Placement> ping{example.product.pings[5].placement()};
  const EchogramRange depths = echogram_range(example.sector, ping, depth);
  const auto deep = echogram_shadow(shadow, example.rows(depth)(5), depths, samples, 3.0, 5);
  ASSERT_EQ(deep.size(), 1U);
  EXPECT_NEAR(deep[0].from_m, 7.0 + 59.0 * std::sin(rad_from_deg(15.0)), depths.bin_m);
}

/// The picture of one beam with its school.
struct Picture {
  Example example;
  std::vector<EchogramSchool> schools;
  TimelineObservation observation;
  TimelineStyle style;
  Picture() {
    const EchogramOf beam{1, 2, EchogramHeight::range};
    const EchogramRange range = echogram_range(example.sector, {}, beam);
    schools = echogram_schools(example.product, example.rows(beam), range, 0, 20);
    observation.product = &example.product;
    observation.schools = schools;
    style.of = "beam 2 of fan 1";
    style.outlined = style.by_school = true;
    style.shown_heights = TimelineHeights{0.0, 118.0};
  }
};

TEST(Echogram, OutlinesItsSchoolsWithTheirNumbers) {
  const Picture picture;
  constexpr PixelSize kWide{900, 500};
  const Theme theme = light_theme(kWide);
  const auto frame = timeline(std::span(&picture.observation, 1), picture.style, kWide, theme);
  const auto plot = timeline_plot(std::span(&picture.observation, 1), picture.style, kWide, theme);
  ASSERT_TRUE(frame && plot);
  for (const char* words : {"beam 2 of fan 1", "school, unreviewed", "range (m)"}) EXPECT_TRUE(says(*frame, words));
  EXPECT_FALSE(says(*frame, "track"));
  const auto number = std::find_if(frame->items.begin(), frame->items.end(), [](const auto& item) {
    const auto* text = std::get_if<TextItem>(&item);
    return text != nullptr && text->text == "3" && text->bold;
  });
  EXPECT_NE(number, frame->items.end());
  const auto outline = std::find_if(frame->items.begin(), frame->items.end(), [](const auto& item) {
    const auto* path = std::get_if<PathItem>(&item);
    return path != nullptr && path->stroke.colour == school_colour(3) && path->parts[0].closed;
  });
  ASSERT_NE(outline, frame->items.end());
  const auto& rings = std::get<PathItem>(*outline).parts;
  const auto in = [&](double seconds, double metres) {
    const PixelPoint at = plot->plot.at(seconds, metres);
    return holds(rings, at.x, at.y);
  };
  // Ping 5 begins at 25 s, ping 16 at 80 s; samples 24 .. 26 lie at 47 .. 51 m.
  EXPECT_TRUE(in(25.2, 46.2) && in(79.8, 51.8));
  EXPECT_FALSE(in(24.8, 49.0) || in(80.2, 49.0) || in(50.0, 45.8) || in(50.0, 52.2));
}

// Stripes of the slices' hatch from 60 m on in pings 5 to 7 (25 to 40 s), nowhere else, and a word for them.
TEST(Echogram, ShadowIsHatchedWhereItLies) {
  Picture picture;
  constexpr PixelSize kWide{900, 500};
  const Theme theme = light_theme(kWide);
  const auto images = [](const FrameDescription& frame) {
    std::vector<ImageItem> out;
    for (const auto& item : frame.items) {
      if (const auto* image = std::get_if<ImageItem>(&item)) out.push_back(*image);
    }
    return out;
  };
  const auto plain = timeline(std::span(&picture.observation, 1), picture.style, kWide, theme);
  ASSERT_TRUE(plain);
  EXPECT_FALSE(says(*plain, "in the shadow of schools"));
  const std::vector<EchogramStretch> shadow{{5, 60.0, 118.0}, {6, 60.0, 118.0}, {7, 60.0, 118.0}};
  picture.observation.shadow = shadow;
  const auto frame = timeline(std::span(&picture.observation, 1), picture.style, kWide, theme);
  const auto plot = timeline_plot(std::span(&picture.observation, 1), picture.style, kWide, theme);
  ASSERT_TRUE(frame && plot);
  EXPECT_TRUE(says(*frame, "in the shadow of schools"));
  const std::vector<ImageItem> drawn = images(*frame);
  ASSERT_GT(drawn.size(), images(*plain).size());
  const ImageItem& hatch = drawn[0];
  const PixelPoint top = plot->plot.at(25.0, 60.0);
  const PixelPoint bottom = plot->plot.at(40.0, 118.0);
  int striped = 0;
  for (int y = 0; y < hatch.image->size.height; ++y) {
    for (int x = 0; x < hatch.image->size.width; ++x) {
      if (hatch.image->at(x, y).a == 0) continue;
      ++striped;
      EXPECT_EQ(hatch.image->at(x, y), theme.hatch);
      const PixelPoint middle{hatch.place.x + x + 0.5, hatch.place.y + y + 0.5};
      ASSERT_TRUE(middle.x > top.x && middle.x < bottom.x && middle.y > top.y && middle.y < bottom.y);
    }
  }
  EXPECT_NEAR(striped * 6.0, (bottom.x - top.x) * (bottom.y - top.y), 0.1 * striped * 6.0) << "one line in six";
}

TEST(Echogram, APartOfBothAxesCanBeShown) {
  Picture picture;
  constexpr PixelSize kWide{900, 500};
  picture.style.shown_heights = TimelineHeights{40.0, 60.0};
  picture.style.height = EchogramHeight::depth;
  picture.style.shown = TimelineInterval{picture.example.product.pings[4].time, picture.example.product.pings[8].time};
  const auto plot = timeline_plot(std::span(&picture.observation, 1), picture.style, kWide, light_theme(kWide));
  ASSERT_TRUE(plot);
  EXPECT_DOUBLE_EQ(plot->plot.y.first, 40.0);
  EXPECT_DOUBLE_EQ(plot->plot.y.last, 60.0);
  EXPECT_EQ(plot->plot.y.label, "depth (m)");
  EXPECT_DOUBLE_EQ(plot->plot.x.first, 20.0);
}

TEST(StackedTimelines, HaveOneTimeAxis) {
  const Picture picture;
  ObservationProduct other =
      map_example::product("obs-0009", 60, {60.0, 5.0}, 0.0, map_example::kStart + 30 * kSecondNs);
  other.grid.reset();
  TimelinePanel below;
  below.observation.product = &other;
  below.observation.label = "obs-0009, channel 1 of 2: 38 kHz";
  constexpr PixelSize kWide{900, 700};
  const Theme theme = light_theme(kWide);
  const TimelinePanel above{picture.observation, picture.style};
  const auto frame = stacked_timelines(above, below, kWide, theme);
  const auto plots = stacked_plots(above, below, kWide, theme);
  ASSERT_TRUE(frame && plots);
  EXPECT_EQ(frame->size, kWide);
  EXPECT_TRUE(says(*frame, "obs-0009, channel 1 of 2: 38 kHz"));
  const auto x = [](const TimelinePlot& plot, TimeNs time) {
    return plot.plot.at(static_cast<double>(time - plot.zero) / 1e9, 0.0).x;
  };
  for (const int ping : {6, 12, 19}) {
    const TimeNs time = picture.example.product.pings[static_cast<std::size_t>(ping)].time;
    EXPECT_NEAR(x(plots->above, time), x(plots->below, time), 1e-6);
  }
  EXPECT_GT(plots->below.plot.place.y, plots->above.plot.place.y + plots->above.plot.place.height);
  TimelinePanel along_log = above;
  along_log.style.axis = TimelineAxis::log;
  EXPECT_FALSE(stacked_timelines(along_log, below, kWide, theme));
}

// From 10 m at ping 2 to 18 m at ping 10, unknown at ping 12, then 30 m from ping 14 on to beyond the last ping.
TEST(Echogram, ALineIsDrawnFromPingToPing) {
  const ObservationProduct p = map_example::product("obs-0001", 24);
  const auto at_ping = [&](std::size_t i) { return p.pings[i].time; };
  const std::vector<TimelinePoint> line{{at_ping(2), 10.0},
                                        {at_ping(10), 18.0},
                                        {at_ping(12), std::nan("")},
                                        {at_ping(14), 30.0},
                                        {at_ping(23) + 3600 * kSecondNs, 30.0}};
  TimelineObservation one{&p, nullptr};
  one.line = line;
  one.line_name = "seabed.evl";
  TimelineStyle style;
  style.height = EchogramHeight::depth;
  style.shown_heights = TimelineHeights{0.0, 50.0};
  constexpr PixelSize kSize{900, 400};
  const Theme theme = light_theme(kSize);
  const auto frame = timeline(std::span(&one, 1), style, kSize, theme);
  const auto plot = timeline_plot(std::span(&one, 1), style, kSize, theme);
  ASSERT_TRUE(frame && plot);
  EXPECT_TRUE(says(*frame, "seabed.evl"));
  const PathItem* drawn = nullptr;
  for (const auto& item : frame->items) {
    const auto* path = std::get_if<PathItem>(&item);
    if (path != nullptr && path->stroke.colour == theme.accent && path->parts.size() == 2) drawn = path;
  }
  ASSERT_NE(drawn, nullptr);
  const auto expect = [&](const PixelPoint& point, std::size_t ping, double depth_m) {
    const double seconds = static_cast<double>(at_ping(ping) - plot->zero) / 1e9;
    const PixelPoint expected = plot->plot.at(seconds, depth_m);
    EXPECT_NEAR(point.x, expected.x, 1e-6);
    EXPECT_NEAR(point.y, expected.y, 1e-6);
  };
  ASSERT_EQ(drawn->parts[0].points.size(), 9U) << "pings 2 to 10";
  for (std::size_t i = 0; i < 9; ++i) expect(drawn->parts[0].points[i], i + 2, 10.0 + static_cast<double>(i));
  ASSERT_EQ(drawn->parts[1].points.size(), 10U) << "pings 14 to 23";
  expect(drawn->parts[1].points.front(), 14, 30.0);
  expect(drawn->parts[1].points.back(), 23, 30.0);
}

}  // namespace
}  // namespace sonar
