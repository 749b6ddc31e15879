// SPDX-License-Identifier: Apache-2.0
#include "view/timelines/timeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "view/maps/map_example.h"
#include "view/school_look.h"

namespace sonar {
namespace {

EchogramCell cell(double sv, double volume) {
  const auto count = static_cast<std::int16_t>(std::lround(counts_from_db(db_from_linear(sv))));
  return {static_cast<float>(sv * volume), static_cast<float>(volume), count, count};
}

/// Small whole numbers, so that sums in any order are exact.
EchogramCell numbered(std::size_t ping, int bin) {
  const auto v = static_cast<std::int16_t>((ping * 31 + static_cast<std::size_t>(bin) * 17) % 101);
  return {static_cast<float>(v), 2.0F, static_cast<std::int16_t>(v - 5), static_cast<std::int16_t>(v + 5)};
}

TEST(EchogramColumn, IsTheVolumeWeightedLinearMeanOfWhatIsNotFlagged) {
  const Sector sector = map_example::grid().grid.sector(map_example::grid().range);
  Volume volume{Array3<std::int16_t>({3, 4, 60}, kNoData), Array3<SampleFlags>({3, 4, 60}, SampleFlags::none)};
  const auto count = [](double db) { return static_cast<std::int16_t>(std::lround(counts_from_db(db))); };
  volume.counts(0, 0, 20) = count(-60.0);
  volume.counts(2, 3, 20) = count(-40.0);
  volume.counts(1, 1, 20) = count(-10.0);
  volume.flags(1, 1, 20) = SampleFlags::seabed;
  const EchogramRange range{0.0, 2.0, 60};
  const auto column = echogram_column(sector, volume, SampleFlags::seabed, range);
  // Sample 20 lies at 39 m: bin 19. The shell is the same, the fans' solid angles are not.
  const double a = sector.solid_angle_sr(0, 0);
  const double b = sector.solid_angle_sr(2, 3);
  const double mean_db = 10.0 * std::log10((1e-6 * a + 1e-4 * b) / (a + b));
  EXPECT_NEAR(db_from_counts(column[19].mean_count()), mean_db, 0.02);
  EXPECT_EQ(column[19].high, count(-40.0));
  EXPECT_EQ(column[19].low, count(-60.0));
  EXPECT_TRUE(column[18].empty());
  EXPECT_EQ(column[18].mean_count(), kNoData);
}

TEST(EchogramRange, CoversEverySampleAndIsNoFinerThanThem) {
  const EchogramRange r = echogram_range({-1.0, 2.0, 60});
  EXPECT_EQ(r.bins, 59);  // 0 .. 118 m
  EXPECT_DOUBLE_EQ(r.bin_m, 2.0);
  EXPECT_EQ(echogram_range({0.0, 0.4, 2000}, 100).bins, 100);
}

TEST(EchogramPyramid, EveryLevelIsTheDirectReductionOfThePings) {
  for (const int per_column : {1, 3}) {
    const EchogramRange range{0.0, 0.5, 1030};
    EchogramPyramid pyramid(range, per_column);
    constexpr std::size_t kPings = 77;
    for (std::size_t i = 0; i < kPings; ++i) {
      std::vector<EchogramCell> column;
      for (int b = 0; b < range.bins; ++b) column.push_back(numbered(i, b));
      pyramid.add_ping(static_cast<TimeNs>(i) * kSecondNs, i == 13 ? std::span<EchogramCell>() : std::span(column));
    }
    ASSERT_GE(pyramid.levels(), 5);
    EXPECT_EQ(pyramid.columns(pyramid.levels() - 1), 1U);
    EXPECT_EQ(pyramid.bins(0), 1030);
    EXPECT_EQ(pyramid.bins(1), 515);
    EXPECT_EQ(pyramid.bins(2), 258);
    EXPECT_EQ(pyramid.bins(3), 258);  // range stays fine enough to draw
    for (int level = 0; level < pyramid.levels(); ++level) {
      const std::size_t pings = static_cast<std::size_t>(per_column) << static_cast<unsigned>(level);
      const int bins = level == 0 ? 1 : level == 1 ? 2 : 4;
      for (std::size_t c = 0; c < pyramid.columns(level); ++c) {
        for (int b = 0; b < pyramid.bins(level); b += 50) {
          EchogramCell direct;
          for (std::size_t i = c * pings; i < std::min(kPings, (c + 1) * pings); ++i) {
            if (i == 13) continue;
            for (int k = b * bins; k < std::min(range.bins, (b + 1) * bins); ++k) direct.add(numbered(i, k));
          }
          EXPECT_EQ(pyramid.cell(level, c, b), direct) << level << ' ' << c << ' ' << b;
        }
      }
    }
  }
}

PlotFrame plot_of(double seconds, double metres) {
  PlotFrame plot;
  plot.place = {0.0, 0.0, 200.0, 100.0};
  plot.x = {0.0, seconds, "", false};
  plot.y = {0.0, metres, "", false};
  return plot;
}

TEST(EchogramImage, APixelIsTheMeanOfWhatLiesUnderIt) {
  EchogramPyramid pyramid({0.0, 1.0, 100});
  std::vector<double> x;
  for (int i = 0; i < 400; ++i) {
    // Two levels side by side: 1e-6 and 3e-6; their linear mean is 2e-6 = -57 dB, not -57.6 (the mean of the dB).
    std::vector<EchogramCell> column(100, cell(i % 2 == 0 ? 1e-6 : 3e-6, 10.0));
    pyramid.add_ping(i * kSecondNs, column);
    x.push_back(i + 0.5);  // none on a pixel's edge
  }
  SvScale scale;
  scale.map = ColourMapName::viridis;
  const SvColours colours = sv_colours(scale);
  const EchogramImage mean = echogram_image(pyramid, x, 3.0, plot_of(400.0, 100.0), EchogramValue::mean, colours);
  EXPECT_EQ(mean.finest_level, 1);
  const auto expected = static_cast<std::int16_t>(std::lround(counts_from_db(db_from_linear(2e-6))));
  EXPECT_EQ(mean.image.at(100, 50), colours[expected]);
  const EchogramImage most = echogram_image(pyramid, x, 3.0, plot_of(400.0, 100.0), EchogramValue::maximum, colours);
  EXPECT_EQ(most.image.at(100, 50), colours[cell(3e-6, 1.0).high]);
}

TEST(EchogramImage, TheCostIsThatOfThePictureHoweverManyPings) {
  std::uint64_t cost[2] = {};
  int k = 0;
  for (const int pings : {1'000, 30'000}) {
    EchogramPyramid pyramid({0.0, 1.0, 100});
    const std::vector<EchogramCell> column(100, cell(1e-6, 10.0));
    std::vector<double> x;
    for (int i = 0; i < pings; ++i) {
      pyramid.add_ping(i * kSecondNs, column);
      x.push_back(i);
    }
    cost[k++] =
        echogram_image(pyramid, x, 3.0, plot_of(pings, 100.0), EchogramValue::mean, sv_colours(SvScale{})).cells_read;
  }
  EXPECT_LE(cost[0], 3U * 200U * 100U);
  EXPECT_LE(cost[1], 3U * 200U * 100U);
}

TEST(EchogramImage, GapsStayEmptyAndPingsFillUpToTheNext) {
  EchogramPyramid pyramid({0.0, 1.0, 100});
  const std::vector<EchogramCell> column(100, cell(1e-5, 10.0));
  const std::vector<double> x{0.0, 10.0, 20.0, 150.0, 160.0};
  for (const double t : x) pyramid.add_ping(static_cast<TimeNs>(t) * kSecondNs, column);
  const auto image =
      echogram_image(pyramid, x, 30.0, plot_of(200.0, 100.0), EchogramValue::mean, sv_colours(SvScale{})).image;
  EXPECT_EQ(image.at(5, 50).a, 255);
  EXPECT_EQ(image.at(28, 50).a, 255);  // before the gap the ping at 20 s fills one usual step
  EXPECT_EQ(image.at(31, 50).a, 0);
  EXPECT_EQ(image.at(149, 50).a, 0);
  EXPECT_EQ(image.at(155, 50).a, 255);
  EXPECT_EQ(image.at(169, 50).a, 255);  // the last ping fills one usual step
  EXPECT_EQ(image.at(172, 50).a, 0);
}

using map_example::says;

// 12 pings 0.01 nmi apart, then 0.1 nmi without any, then 12 more. The gap is as empty as the plot round the strip.
TEST(Timeline, AGapAlongTheLogIsEmpty) {
  ObservationProduct p = map_example::product("obs-0001", 24);
  const EchogramRange range{0.0, 1.0, 100};
  EchogramPyramid pyramid(range);
  for (std::size_t i = 0; i < p.pings.size(); ++i) {
    p.pings[i].distance_nmi = 10.0 + 0.01 * static_cast<double>(i) + (i < 12 ? 0.0 : 0.1);
    const std::vector<EchogramCell> column(100, cell(1e-4, 1.0));
    pyramid.add_ping(p.pings[i].time, column, p.pings[i].distance_nmi);
  }
  map_example::add_school(p, 1, p.pings[3].transducer, 3, 20, map_example::block(2, 1, 2, 24, 3));
  const TimelineObservation observation{&p, &pyramid};
  TimelineStyle style;
  style.axis = TimelineAxis::log;
  constexpr PixelSize kWide{900, 500};
  const Theme theme = light_theme(kWide);
  const auto frame = timeline(std::span(&observation, 1), style, kWide, theme);
  const auto plot = timeline_plot(std::span(&observation, 1), style, kWide, theme);
  ASSERT_TRUE(frame && plot);
  const double gap_from = plot->plot.at(10.11 + 0.01, 0.0).x;  // the last ping before it takes its own 0.01 nmi
  const double gap_to = plot->plot.at(10.22, 0.0).x;
  ASSERT_GT(gap_to - gap_from, 100.0);
  const Rgba8 track = status_colour("unreviewed", theme);
  int strips = 0;
  for (const auto& item : frame->items) {
    if (const auto* path = std::get_if<PathItem>(&item);
        path != nullptr && path->fill == theme.water &&
        path->parts[0].points[0].x < plot->plot.place.x + plot->plot.place.width) {
      ++strips;
      for (const PixelPoint& point : path->parts[0].points) {
        EXPECT_TRUE(point.x < gap_from + 0.5 || point.x > gap_to - 0.5) << point.x;
      }
    }
    if (const auto* path = std::get_if<PathItem>(&item);
        path != nullptr && path->stroke.colour == track &&
        path->parts[0].points[0].y < plot->plot.place.y + plot->plot.place.height) {
      EXPECT_EQ(path->parts.size(), 2U) << "a track does not cross the gap";
    }
    if (const auto* image = std::get_if<ImageItem>(&item); image != nullptr && image->place.x == plot->plot.place.x) {
      for (int x = 0; x < image->image->size.width; ++x) {
        const double at = image->place.x + x;
        const bool empty = at > gap_from + 1.0 && at + 1.0 < gap_to - 1.0;
        const bool full = at + 1.0 < gap_from - 1.0 || at > gap_to + 1.0;
        if (empty || full) {
          ASSERT_EQ(image->image->at(x, 50).a, full ? 255 : 0) << x;
        }
      }
    }
  }
  EXPECT_EQ(strips, 2);
  EXPECT_EQ(frame->title, "obs-0001 of SYNTHETIC example");
}

// A log in tenths of a mile and pings every hundredth: its own steps are no gaps.
TEST(Timeline, ACoarseLogHasNoGaps) {
  ObservationProduct p = map_example::product("obs-0001", 100);
  EchogramPyramid pyramid(EchogramRange{0.0, 1.0, 100});
  for (std::size_t i = 0; i < p.pings.size(); ++i) {
    p.pings[i].distance_nmi = 10.0 + 0.1 * static_cast<double>(i / 10);
    pyramid.add_ping(p.pings[i].time, std::vector<EchogramCell>(100, cell(1e-4, 1.0)), p.pings[i].distance_nmi);
  }
  const TimelineObservation observation{&p, &pyramid};
  TimelineStyle style;
  style.axis = TimelineAxis::log;
  constexpr PixelSize kWide{900, 500};
  const auto frame = timeline(std::span(&observation, 1), style, kWide, light_theme(kWide));
  ASSERT_TRUE(frame);
  for (const auto& item : frame->items) {
    const auto* image = std::get_if<ImageItem>(&item);
    if (image == nullptr || image->image->size.width < 100) continue;
    for (int x = 0; x + 1 < image->image->size.width; ++x) ASSERT_EQ(image->image->at(x, 50).a, 255) << x;
  }
}

TEST(Timeline, WithoutRawThereAreTheSchoolsAndANote) {
  ObservationProduct p = map_example::product("obs-0001", 40);
  map_example::add_school(p, 9, p.pings[0].transducer, 5, 15, map_example::block(2, 1, 2, 24, 3));
  const TimelineObservation one{&p, nullptr};
  constexpr PixelSize kSize{900, 400};
  TimelineStyle style;
  auto frame = timeline(std::span(&one, 1), style, kSize, light_theme(kSize));
  ASSERT_TRUE(frame) << to_line(frame.error());
  EXPECT_TRUE(says(*frame, "no raw data: schools only"));
  EXPECT_TRUE(says(*frame, "9"));
  EXPECT_TRUE(says(*frame, "obs-0001"));
  EXPECT_TRUE(says(*frame, "12:27"));
  EXPECT_TRUE(says(*frame, "SYNTHETIC"));
  style.axis = TimelineAxis::log;
  frame = timeline(std::span(&one, 1), style, kSize, light_theme(kSize));
  ASSERT_TRUE(frame);
  EXPECT_TRUE(says(*frame, "log (nmi)"));
  for (PingNavigation& n : p.pings) n.distance_nmi = std::nan("");
  const auto none = timeline(std::span(&one, 1), style, kSize, light_theme(kSize));
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().text, "the data have no log (distance run); draw the timeline along time");
  p.pings.clear();
  EXPECT_FALSE(timeline(std::span(&one, 1), TimelineStyle{}, kSize, light_theme(kSize)));
}

// Ping 12 has an empty column: grey and hatched from its own time to the next ping's, and the key says what that is.
TEST(Timeline, APingWithoutDataIsNeitherAGapNorQuietWater) {
  const ObservationProduct p = map_example::product("obs-0001", 40);
  EchogramPyramid pyramid(EchogramRange{0.0, 1.0, 100});
  const std::vector<EchogramCell> column(100, cell(1e-4, 1.0));
  for (std::size_t i = 0; i < p.pings.size(); ++i) {
    pyramid.add_ping(p.pings[i].time, i == 12 ? std::span<const EchogramCell>() : std::span(column));
  }
  const TimelineObservation one{&p, &pyramid};
  constexpr PixelSize kWide{900, 500};
  const Theme theme = light_theme(kWide);
  TimelineStyle style;
  const auto frame = timeline(std::span(&one, 1), style, kWide, theme);
  const auto plot = timeline_plot(std::span(&one, 1), style, kWide, theme);
  ASSERT_TRUE(frame && plot);
  EXPECT_TRUE(says(*frame, "ping without data"));
  int patches = 0;
  for (const auto& item : frame->items) {
    const auto* path = std::get_if<PathItem>(&item);
    if (path == nullptr || path->fill != theme.no_data) continue;
    if (path->parts[0].points[0].y > plot->plot.place.y + 1.0) continue;  // the key's
    ++patches;
    EXPECT_NEAR(path->parts[0].points[0].x, plot->plot.at(60.0, 0.0).x, 1e-6);
    EXPECT_NEAR(path->parts[0].points[1].x, plot->plot.at(65.0, 0.0).x, 1e-6);
  }
  EXPECT_EQ(patches, 1);
  EXPECT_GE(frame->size.height, plot->plot.place.y + plot->plot.place.height);
  style.brief = true;
  EXPECT_FALSE(says(*timeline(std::span(&one, 1), style, kWide, theme), "ping without data"));
}

TEST(Timeline, AKeyNamesItsTracksAndTheTitleHowItWasMade) {
  ObservationProduct p = map_example::product("obs-0001", 40);
  map_example::add_school(p, 9, p.pings[0].transducer, 5, 15, map_example::block(2, 1, 2, 24, 3));
  map_example::add_school(p, 10, p.pings[0].transducer, 5, 15, map_example::block(2, 1, 2, 24, 3));
  p.schools[1].status = "accepted";
  EchogramPyramid pyramid(EchogramRange{0.0, 1.0, 100});
  for (const PingNavigation& n : p.pings) pyramid.add_ping(n.time, std::vector<EchogramCell>(100, cell(1e-4, 1.0)));
  const TimelineObservation one{&p, &pyramid};
  constexpr PixelSize kWide{900, 500};
  TimelineStyle style;
  const auto drawn = [&] { return *timeline(std::span(&one, 1), style, kWide, light_theme(kWide)); };
  EXPECT_TRUE(says(drawn(), "track of a school, unreviewed"));
  EXPECT_TRUE(says(drawn(), "track of a school, accepted"));
  EXPECT_FALSE(says(drawn(), "rejected"));
  EXPECT_FALSE(says(drawn(), "ping without data"));
  EXPECT_TRUE(says(drawn(), "not filtered"));
  EXPECT_FALSE(says(drawn(), "not detected"));
  style.filtered = true;
  style.schools = false;
  style.searched = false;
  EXPECT_TRUE(says(drawn(), "noise removed"));
  EXPECT_FALSE(says(drawn(), "track of a school"));
  EXPECT_TRUE(says(drawn(), "schools not detected"));
}

// However low the picture and however far the sonar reaches: one number alone is no scale.
TEST(Timeline, ALowOneStillHasTwoRanges) {
  for (const double far_m : {90.0, 130.0, 230.0, 430.0, 600.0}) {
    ObservationProduct p = map_example::product("obs-0001", 40);
    p.grid->range.spacing_m = far_m / p.grid->range.count;
    const TimelineObservation one{&p, nullptr};
    TimelineStyle style;
    style.brief = true;
    for (int height = 120; height < 260; height += 10) {
      const PixelSize size{500, height};
      const Theme theme = light_theme(size);
      const auto frame = timeline(std::span(&one, 1), style, size, theme);
      if (!frame) continue;  // too low for any
      const auto where = timeline_plot(std::span(&one, 1), style, size, theme);
      ASSERT_TRUE(where);
      const auto ranges = std::count_if(frame->items.begin(), frame->items.end(), [&](const auto& item) {
        const auto* text = std::get_if<TextItem>(&item);
        return text != nullptr && text->anchor == TextAnchor::right && text->at.x < where->plot.place.x;
      });
      EXPECT_GE(ranges, 2) << far_m << " m, " << height << " pixels";
    }
  }
}

TEST(Timeline, MarksStandAtTheirTimesAndTellWhatHappened) {
  ObservationProduct p = map_example::product("obs-0001", 40);
  map_example::add_school(p, 3, p.pings[0].transducer, 5, 15, map_example::block(2, 1, 2, 24, 3));
  TimelineObservation one{&p, nullptr};
  // Half way between pings 10 and 11, at the last ping, and one that the flag before it leaves no room for words.
  one.marks = {{map_example::kStart + 52'500'000'000, "trawl", "trawl 12"},
               {map_example::kStart + 195 * kSecondNs, "noise", "sweeper"},
               {map_example::kStart + 53 * kSecondNs, "station", "a station with a very long name that fits nowhere"}};
  one.bad = {{p.pings[20].time, p.pings[22].time}};
  constexpr PixelSize kSize{900, 300};
  const Theme theme = light_theme(kSize);
  TimelineStyle style;
  style.brief = true;
  style.by_school = true;
  const auto frame = timeline(std::span(&one, 1), style, kSize, theme);
  ASSERT_TRUE(frame) << to_line(frame.error());
  EXPECT_FALSE(says(*frame, "SYNTHETIC"));
  EXPECT_TRUE(says(*frame, "trawl 12"));
  EXPECT_TRUE(says(*frame, "sweeper"));
  EXPECT_TRUE(says(*frame, "a station with"));
  const auto where = timeline_plot(std::span(&one, 1), style, kSize, theme);
  ASSERT_TRUE(where);
  EXPECT_EQ(where->zero, map_example::kStart);
  for (const auto& item : frame->items) {
    const auto* t = std::get_if<TextItem>(&item);
    if (t == nullptr || t->text != "trawl 12") continue;
    EXPECT_LT(t->at.x + text_width_px("trawl 12", t->size_px), where->plot.at(52.5, 0.0).x) << "the next flag is near";
  }
  const auto lines_at = [&](double seconds) {
    const double x = where->plot.at(seconds, 0.0).x;
    return std::count_if(frame->items.begin(), frame->items.end(), [&](const auto& item) {
      const auto* path = std::get_if<PathItem>(&item);
      return path != nullptr && path->stroke.colour == theme.accent && path->parts[0].points.size() == 2 &&
             std::abs(path->parts[0].points[0].x - x) < 1e-6;
    });
  };
  EXPECT_EQ(lines_at(52.5), 1);
  EXPECT_EQ(lines_at(195.0), 1);
  EXPECT_EQ(lines_at(100.0), 0);
  // Bad pings 20 .. 22 are shaded up to ping 23: 100 s to 115 s.
  const double from = where->plot.at(100.0, 0.0).x;
  const double to = where->plot.at(115.0, 0.0).x;
  EXPECT_TRUE(std::any_of(frame->items.begin(), frame->items.end(), [&](const auto& item) {
    const auto* path = std::get_if<PathItem>(&item);
    if (path == nullptr || path->fill != with_alpha(theme.no_data, 190)) return false;
    const auto& points = path->parts[0].points;
    return std::abs(points[0].x - from) < 1e-6 && std::abs(points[2].x - to) < 1e-6;
  }));
  EXPECT_TRUE(std::any_of(frame->items.begin(), frame->items.end(), [&](const auto& item) {
    const auto* path = std::get_if<PathItem>(&item);
    return path != nullptr && path->stroke.colour == school_colour(3);
  }));
}

TEST(Timeline, TicksStandAtRoundTimes) {
  const TimeNs start = time_from_calendar(2009, 11, 13, 8 * 3600.0 + 11 * 60.0 + 49.0);
  const auto minutes = time_ticks(start, start + 1800 * kSecondNs, 8);
  ASSERT_EQ(minutes.size(), 6U);
  EXPECT_EQ(minutes[0].text, "08:15");
  EXPECT_EQ(minutes[1].text, "08:20");
  const auto days = time_ticks(start, start + 7 * 86'400 * kSecondNs, 8);
  ASSERT_EQ(days.size(), 7U);
  EXPECT_EQ(days[0].text, "2009-11-14");
  EXPECT_EQ(time_ticks(start, start + 10 * kSecondNs, 10)[0].text, "08:11:49");
}

}  // namespace
}  // namespace sonar
