// SPDX-License-Identifier: Apache-2.0
#include "view/refused_marks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>

#include "view/maps/map_example.h"
#include "view/maps/observation_map.h"
#include "view/slices/slice_example.h"
#include "view/timelines/timeline.h"

namespace sonar {
namespace {

using slice_example::hand_sector;
using slice_example::LitVolume;
using slice_example::texts_of;

constexpr PixelSize kSize{640, 480};
const Voxel kLoudest{4, 3, 20};

/// The hand sector's grid: 8 fans x 7 beams, channels in the order of its rows, from 100.
BeamGrid grid() {
  BeamGrid grid;
  grid.elevation_deg = slice_example::even_deg(-70, 10, 8);
  grid.azimuth_deg = slice_example::even_deg(240, 10, 7);
  for (int row = 0; row < 56; ++row) grid.channel.push_back(100 + row);
  return grid;
}

/// Three fans high, two beams wide, 20 m = 4 samples along range.
RefusedEcho echo(std::int64_t ping_index = 7, std::int64_t id = 5) {
  RefusedEcho row;
  row.ping_index = ping_index;
  row.echo_id = id;
  row.channel = 100 + kLoudest.fan * 7 + kLoudest.beam;
  row.sample = kLoudest.sample;
  row.n_fans = 3;
  row.n_beams = 2;
  row.range_extent_m = 20.0;
  return row;
}

std::optional<PixelPoint> placed(const Slice& slice) {
  const std::vector<RefusedEcho> rows{echo()};
  const auto marks = refused_marks(rows, 7, grid(), hand_sector());
  return place_of(SliceMap(hand_sector(), {slice}, {-200, -200, 200, 200}, {400, 400}), marks.at(0));
}

TEST(RefusedMarks, AreOfOnePingAndOfWhatTheSectorHas) {
  std::vector<RefusedEcho> rows{echo(6), echo(7), echo(7, 6), echo(7, 7), echo(7, 8)};
  rows[2].channel = 99;
  rows[3].sample = 41;
  rows[4].channel = 1'000'000;
  const auto marks = refused_marks(rows, 7, grid(), hand_sector(), 5);
  ASSERT_EQ(marks.size(), 1U);
  EXPECT_EQ(marks[0].echo_id, 5);
  EXPECT_EQ(marks[0].loudest, kLoudest);
  EXPECT_EQ(marks[0].fans, 3);
  EXPECT_EQ(marks[0].samples, 4);
  EXPECT_TRUE(marks[0].chosen);
}

// Half of three fans is one, half of two beams is one, half of four samples is two.
TEST(RefusedMarks, LieAtTheirLoudestVoxelAndInSlicesAsFarAsHalfTheirBox) {
  const SliceMap top(hand_sector(), {TopSlice{4}}, {-200, -200, 200, 200}, {400, 400});
  EXPECT_EQ(placed(TopSlice{4}), top.place_of(kLoudest));
  EXPECT_TRUE(placed(TopSlice{3}) && placed(TopSlice{5}));
  EXPECT_FALSE(placed(TopSlice{2}) || placed(TopSlice{6}));
  EXPECT_TRUE(placed(SideSlice{2}) && placed(SideSlice{3}) && placed(SideSlice{4}));
  EXPECT_FALSE(placed(SideSlice{1}) || placed(SideSlice{5}));
  EXPECT_TRUE(placed(RangeSlice{18}) && placed(RangeSlice{22}));
  EXPECT_FALSE(placed(RangeSlice{17}) || placed(RangeSlice{23}));
}

TEST(RefusedMarks, TheNearestWithinReachIsMeant) {
  const std::vector<PlacedMark> marks{{{100.0, 100.0}, 1}, {{110.0, 100.0}, 2}};
  EXPECT_EQ(mark_at(marks, {104.0, 100.0}, 8.0), 1);
  EXPECT_EQ(mark_at(marks, {106.0, 100.0}, 8.0), 2);
  EXPECT_EQ(mark_at(marks, {105.0, 120.0}, 8.0), std::nullopt);
}

// Shape and colour are the marks' own: a closed ring of four corners in the colour of words.
bool is_mark(const PathItem& item, const Theme& theme) {
  return item.parts.size() == 1 && item.parts[0].closed && item.parts[0].points.size() == 4 &&
         item.stroke.colour == theme.text && item.fill.a == 0;
}
std::vector<PixelPoint> marks_in(const FrameDescription& frame, const Theme& theme) {
  std::vector<PixelPoint> middles;
  for (const auto& item : frame.items) {
    const auto* path = std::get_if<PathItem>(&item);
    if (path == nullptr || !is_mark(*path, theme)) continue;
    const auto& points = path->parts[0].points;
    middles.push_back({points[0].x, points[1].y});
  }
  return middles;
}

SlicePicture slice(std::vector<RefusedMark> marks, bool key) {
  const LitVolume volume(hand_sector(), kLoudest, -30.0, -80.0);
  SliceData data = volume.data();
  data.refused = std::move(marks);
  SliceStyle style;
  if (key) style.key.emplace();
  auto picture = slice_picture(hand_sector(), data, {}, {TopSlice{4}}, style, light_theme(kSize), kSize);
  EXPECT_TRUE(picture.has_value());
  return std::move(*picture);
}

TEST(RefusedMarks, StandInSlicesWithTheirKey) {
  const Theme theme = light_theme(kSize);
  const std::vector<RefusedEcho> rows{echo()};
  const auto marks = refused_marks(rows, 7, grid(), hand_sector());
  const SlicePicture bare = slice({}, true);
  EXPECT_TRUE(marks_in(bare.frame, theme).empty());
  EXPECT_EQ(std::ranges::count(texts_of(bare), std::string(kRefusedWords)), 0);

  const SlicePicture window = slice(marks, false);
  ASSERT_EQ(window.refused.size(), 1U);
  EXPECT_EQ(window.refused[0].echo_id, 5);
  EXPECT_EQ(window.refused[0].at, window.place_of(kLoudest));
  const auto drawn = marks_in(window.frame, theme);
  ASSERT_EQ(drawn.size(), 1U);
  EXPECT_NEAR(drawn[0].x, window.refused[0].at.x, 1e-9);
  EXPECT_NEAR(drawn[0].y, window.refused[0].at.y, 1e-9);

  const SlicePicture file = slice(marks, true);
  EXPECT_EQ(std::ranges::count(texts_of(file), std::string(kRefusedWords)), 1);
  EXPECT_EQ(marks_in(file.frame, theme).size(), 2U) << "the key's, too";
}

/// Echo 1 in pings 2 and 3, loudest in ping 3, and echo 2, of which no place is known.
ObservationProduct product_with_refused() {
  ObservationProduct product = map_example::product("obs-0001", 8);
  for (const std::int64_t ping : {2, 3}) {
    RefusedEcho row = echo(ping, 1);
    const Geographic there = destination(product.pings[static_cast<std::size_t>(ping)].transducer, 60.0, 270.0);
    row.latitude = there.latitude_deg;
    row.longitude = there.longitude_deg;
    row.range_m = 60.0;
    row.level_db = ping == 3 ? -40.0 : -50.0;
    product.rejected.push_back(row);
  }
  product.rejected.push_back(echo(4, 2));
  return product;
}

TEST(RefusedMarks, StandInMapsOnceAnEchoWhereItWasLoudest) {
  const Theme theme = light_theme(kSize);
  const ObservationProduct product = product_with_refused();
  auto base = observation_map_base(product, kSize, theme, {}, true, true);
  ASSERT_TRUE(base.has_value());
  FrameDescription frame = observation_map(*base, product, mask_mosaic(*base, product), 0, {});
  const std::size_t before = marks_in(frame, theme).size();
  const auto marks = add_map_refused(frame, *base, product.rejected);
  ASSERT_EQ(marks.size(), 1U);
  EXPECT_EQ(marks[0].echo_id, 1);
  const PixelPoint loudest = *base->map.at(Geographic{product.rejected[1].latitude, product.rejected[1].longitude});
  EXPECT_NEAR(marks[0].at.x, loudest.x, 1e-9);
  EXPECT_NEAR(marks[0].at.y, loudest.y, 1e-9);
  EXPECT_EQ(marks_in(frame, theme).size(), before + 1);
  EXPECT_TRUE(map_example::says(frame, kRefusedWords));
  auto plain = observation_map_base(map_example::product("obs-0001", 8), kSize, theme, {}, true, true);
  EXPECT_EQ(plain->key.size() + 1, base->key.size()) << "nothing refused, nothing to explain";
}

TEST(RefusedMarks, StandInTimelinesAtTheirPingAndRange) {
  const Theme theme = light_theme(kSize);
  const ObservationProduct product = product_with_refused();
  TimelineObservation observation{&product};
  observation.refused = std::span(product.rejected).first(2);
  const auto frame = timeline({&observation, 1}, {}, kSize, theme);
  ASSERT_TRUE(frame.has_value());
  const auto plot = timeline_plot({&observation, 1}, {}, kSize, theme);
  // Ping 3 is 15 s after the first.
  const PixelPoint there = plot->plot.at(15.0, 60.0);
  const auto drawn = marks_in(*frame, theme);
  ASSERT_EQ(drawn.size(), 2U) << "and the key's";
  EXPECT_NEAR(drawn[0].x, there.x, 1e-6);
  EXPECT_NEAR(drawn[0].y, there.y, 1e-6);
  EXPECT_TRUE(map_example::says(*frame, kRefusedWords));
}

}  // namespace
}  // namespace sonar
