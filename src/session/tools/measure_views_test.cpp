// SPDX-License-Identifier: Apache-2.0
// The measure tool on maps and in the volume.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/units.h"
#include "session/maps/test_maps.h"
#include "session/tools/measure_tool.h"
#include "session/tools/test_sphere.h"
#include "session/volume/test_volume.h"

namespace sonar {
namespace {

using testing::HasSubstr;

TEST(MeasureOnMaps, ADragIsTheGeodesicBetweenItsPlacesAndAClickIsStillAClick) {
  TestMaps maps;
  maps.workspace.tool.set(ToolName::measure);
  maps.see(maps.map);
  maps.see(maps.survey);
  for (LivePicture* picture : std::vector<LivePicture*>{&maps.map, &maps.survey}) {
    const auto frame = picture == &maps.map ? maps.map.places()->map : maps.survey.places()->map;
    const PixelPoint from{frame->place.x + 60.0, frame->place.y + 80.0};
    const PixelPoint to{frame->place.x + 200.0, frame->place.y + 130.0};
    const auto pictures = picture->pictures();
    TestMaps::drag(*picture, from, to);
    maps.settle();
    const auto& measured = maps.workspace.measurement();
    ASSERT_TRUE(measured);
    const Geographic a = *frame->geographic(from);
    const Geographic b = *frame->geographic(to);
    EXPECT_NEAR(measured->line.horizontal_m / sphere_m(a, b), 1.0, 0.006);
    const double east =
        (b.longitude_deg - a.longitude_deg) * std::cos(rad_from_deg(0.5 * (a.latitude_deg + b.latitude_deg)));
    const double north = b.latitude_deg - a.latitude_deg;
    EXPECT_NEAR(wrap_180(measured->line.bearing_deg - deg_from_rad(std::atan2(east, north))), 0.0, 0.5);
    EXPECT_THAT(whole_text(*measured), HasSubstr(fmt::format("{:.3f} nmi", measured->line.horizontal_m / 1852.0)));
    EXPECT_EQ(picture->pictures(), pictures) << "the map has not been panned";
    std::vector<PixelPoint> line;
    for (const Overlay& overlay : picture->overlays()) {
      if (!overlay.text.empty()) line = overlay.line;
    }
    ASSERT_EQ(line.size(), 2U);
    EXPECT_NEAR(line[1].x, to.x, 0.01);
    EXPECT_NEAR(line[1].y, to.y, 0.01);
  }
  const auto& track = *maps.map.places()->track;
  TestMaps::click(maps.map, track[7]);
  maps.settle();
  EXPECT_EQ(maps.workspace.document.ping(), 7);
  EXPECT_FALSE(maps.workspace.measurement());
}

class MeasureInVolume : public testing::Test, protected VolumeApp {};

TEST_F(MeasureInVolume, TwoClicksAreALineBetweenTheirVoxels) {
  workspace_.tool.set(ToolName::measure);
  const PixelPoint first = seen_place();
  const auto a = model_->shown()->picked_at(first);
  ASSERT_TRUE(a);
  PixelPoint second = first;
  std::optional<Picked> b;
  for (int step = 1; step < 60 && !b; ++step) {
    second = {first.x + 5.0 * step, first.y + 2.0 * step};
    b = model_->shown()->picked_at(second);
  }
  ASSERT_TRUE(b);
  const auto click = [&](PixelPoint at) {
    point(PointerAction::press, at, PointerButton::left);
    point(PointerAction::release, at, PointerButton::left);
    settle();
  };
  click(first);
  ASSERT_TRUE(workspace_.measurement());
  EXPECT_TRUE(workspace_.measurement()->drawing);
  point(PointerAction::move, second);
  click(second);
  ASSERT_TRUE(workspace_.measurement());
  EXPECT_FALSE(workspace_.measurement()->drawing);
  const Sector& sector = workspace_.document.shown()->sector();
  const Point<Sonar> from = sector.centre(a->fan, a->beam, a->sample);
  const Point<Sonar> to = sector.centre(b->fan, b->beam, b->sample);
  EXPECT_NEAR(workspace_.measurement()->line.slant_m, norm(to - from), 1e-9);
  int texts = 0;
  for (const Overlay& overlay : model_->overlays()) texts += overlay.text.empty() ? 0 : 1;
  EXPECT_EQ(texts, 1);
}

}  // namespace
}  // namespace sonar
