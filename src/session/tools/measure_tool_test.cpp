// SPDX-License-Identifier: Apache-2.0
#include "session/tools/measure_tool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/units.h"
#include "geo/geodesic.h"
#include "session/slices/test_slices.h"
#include "session/tools/test_sphere.h"

namespace sonar {
namespace {

using testing::HasSubstr;

class MeasureAtWork : public testing::Test {
 protected:
  void SetUp() override {
    app_.look_at_bright();
    workspace().tool.set(ToolName::measure);
  }
  Workspace& workspace() { return app_.workspace(); }
  Document& document() { return app_.document(); }
  const Voxel& bright() { return SlicesApp::bright().voxel; }
  const std::optional<Measurement>& measured() { return workspace().measurement(); }
  const Sector& sector() { return document().shown()->sector(); }

  PixelPoint at(SliceModel& slice, const Voxel& voxel) { return *slice.picture()->place_of(voxel); }
  void drag(SliceModel& slice, const std::vector<PixelPoint>& way, bool shift = false, bool control = false) {
    PointerEvent event{PointerAction::press, PointerButton::left, way.front()};
    event.shift = shift;
    event.control = control;
    slice.pointer(event);
    event.action = PointerAction::move;
    for (const PixelPoint& p : way) {
      event.at = p;
      slice.pointer(event);
    }
    event.action = PointerAction::release;
    slice.pointer(event);
  }

  /// Sums over all voxels whose place in the picture the test finds within.
  template <class Within>
  void expect_sums(SliceModel& slice, Within within, bool all_fans = false) {
    const StagedPing& ping = *document().staged();
    std::int64_t voxels = 0;
    std::int64_t never = 0;
    std::int64_t faulty = 0;
    double volume_m3 = 0.0;
    double heard_m3 = 0.0;
    double sum = 0.0;
    double loudest = -1.0;
    for (int f = 0; f < sector().fans(); ++f) {
      for (int b = 0; b < sector().beams(); ++b) {
        const int row = f * sector().beams() + b;
        const AngleBounds e = sector().elevation_bounds(f);
        const AngleBounds a = sector().azimuth_bounds(b);
        const double sr = (a.upper - a.lower) * (std::sin(e.upper) - std::sin(e.lower));
        for (int s = 0; s < sector().range().count; ++s) {
          const auto pixel = slice.picture()->place_of({f, b, s});
          if (!all_fans && (!pixel || !within(*pixel))) continue;
          if (all_fans && !within_from_above(slice, {f, b, s}, within)) continue;
          if (any(ping.filtered->flags(f, b, s) & kNeverMember)) {
            ++never;
            continue;
          }
          ++voxels;
          const double half = 0.5 * sector().range().spacing_m;
          const double r = sector().range().range_m(s);
          const double cell = sr * (std::pow(r + half, 3) - std::pow(r - half, 3)) / 3.0;
          volume_m3 += cell;
          const std::int16_t count = ping.sv.counts(f, b, s);
          if (any(ping.sv.flags(f, b, s) & kFault) || count == kNoData) {
            ++faulty;
            continue;
          }
          // The noise of a beam is told as power; what makes power Sv makes it Sv too.
          const double noise_db =
              ping.background_db.empty() ? kUnknown : ping.background_db[static_cast<std::size_t>(row)];
          const double noise = std::isnan(noise_db)
                                   ? 0.0
                                   : std::pow(10.0, (noise_db + (*ping.calibration)(f, b, s) * kDbPerCount) / 10.0);
          const double sv = std::pow(10.0, count * kDbPerCount / 10.0) - noise;
          heard_m3 += cell;
          sum += sv * cell;
          loudest = std::max(loudest, sv);
        }
      }
    }
    ASSERT_TRUE(measured());
    const EchoStatistics& echo = measured()->area.statistics.echo;
    ASSERT_GT(voxels, 50);
    EXPECT_EQ(echo.voxels, voxels);
    EXPECT_EQ(measured()->area.never, never);
    EXPECT_EQ(echo.voxels - echo.heard, faulty);
    EXPECT_NEAR(echo.volume_m3 / volume_m3, 1.0, 1e-9);
    EXPECT_NEAR(echo.sv_mean_db, 10.0 * std::log10(sum / heard_m3), 1e-6);
    EXPECT_NEAR(echo.backscatter_m2 / (sum / heard_m3 * volume_m3), 1.0, 1e-6);
    EXPECT_NEAR(echo.sv_max_db, 10.0 * std::log10(loudest), 1e-6);
  }
  /// The same place from above, seen on the fan that is on show.
  template <class Within>
  bool within_from_above(SliceModel& slice, const Voxel& voxel, Within within) {
    const double range = sector().range().range_m(voxel.sample);
    if (!(range > 0.0)) return false;
    const double level = range * std::cos(sector().elevation_rad(voxel.fan));
    const double azimuth = sector().azimuth_rad(voxel.beam);
    const SliceMap& map = *slice.picture()->map;
    const PixelPoint p = map.pixel_of(level * std::sin(azimuth), -level * std::cos(azimuth));
    return within({p.x + slice.picture()->plot.place.x, p.y + slice.picture()->plot.place.y});
  }

  SlicesApp app_;
};

TEST_F(MeasureAtWork, ALineFromAboveIsThatBetweenItsVoxels) {
  const Voxel from{bright().fan, 2, bright().sample - 60};
  const Voxel to{bright().fan, sector().beams() - 3, bright().sample};
  drag(app_.top(), {at(app_.top(), from), at(app_.top(), to)});
  ASSERT_TRUE(measured());
  EXPECT_EQ(measured()->shape, Measurement::Shape::line);
  EXPECT_FALSE(measured()->drawing);
  const Point<Sonar> a = sector().centre(from.fan, from.beam, from.sample);
  const Point<Sonar> b = sector().centre(to.fan, to.beam, to.sample);
  const LineFigures& line = measured()->line;
  EXPECT_NEAR(line.slant_m, std::sqrt(std::pow(b.x - a.x, 2) + std::pow(b.y - a.y, 2) + std::pow(b.z - a.z, 2)), 1e-6);
  EXPECT_NEAR(line.horizontal_m, std::hypot(b.x - a.x, b.y - a.y), 1e-6);
  EXPECT_NEAR(line.deeper_m, b.z - a.z, 1e-6);
  const double heading_deg =
      document().shown()->files().navigation[static_cast<std::size_t>(document().ping())].heading_deg;
  const double bow_deg = deg_from_rad(std::atan2(b.y - a.y, b.x - a.x));
  EXPECT_NEAR(wrap_180(line.bearing_deg - heading_deg - bow_deg), 0.0, 1e-6);
  // The ends' own positions say the same.
  const auto& ends = *measured()->ends;
  ASSERT_TRUE(ends[0].where && ends[1].where);
  EXPECT_NEAR(sphere_m(*ends[0].where, *ends[1].where) / line.horizontal_m, 1.0, 0.006);
  EXPECT_NEAR(wrap_180(geodesic(*ends[0].where, *ends[1].where).bearing_deg - line.bearing_deg), 0.0, 0.02);
  // The voxel that the pixel shows, which need not be the one whose centre lies in it.
  EXPECT_EQ(ends[1].voxel, app_.top().picture()->voxel_at(at(app_.top(), to)));
  EXPECT_EQ(read_out(workspace(), *ends[1].voxel).sv, fmt::format("Sv {:.1f} dB", ends[1].sv_db));
  EXPECT_THAT(measured_text(workspace()), HasSubstr(fmt::format("{:.1f} m slant", line.slant_m)));
}

TEST_F(MeasureAtWork, FromTheSideALineGoesDown) {
  const Voxel from{0, bright().beam, 300};
  const Voxel to{sector().fans() - 1, bright().beam, 300};
  drag(app_.side(), {at(app_.side(), from), at(app_.side(), to)});
  ASSERT_TRUE(measured());
  const Point<Sonar> a = sector().centre(from.fan, from.beam, from.sample);
  const Point<Sonar> b = sector().centre(to.fan, to.beam, to.sample);
  EXPECT_NEAR(measured()->line.deeper_m, b.z - a.z, 1e-6);
  const double depth_m = document().shown()->placement(document().ping()).transducer_depth_m;
  EXPECT_NEAR(measured()->ends->back().depth_m, b.z + depth_m, 1e-6);
}

TEST_F(MeasureAtWork, ABoxSumsTheVoxelsOfItsSlice) {
  for (SliceModel* slice : {&app_.top(), &app_.side()}) {
    const PixelPoint middle = at(*slice, bright());
    const PixelPoint low{middle.x - 40.0, middle.y - 30.0};
    const PixelPoint high{middle.x + 35.0, middle.y + 45.0};
    drag(*slice, {low, high}, true);
    expect_sums(*slice, [&](PixelPoint p) { return p.x > low.x && p.x < high.x && p.y > low.y && p.y < high.y; });
    EXPECT_EQ(measured()->shape, Measurement::Shape::box);
  }
  EXPECT_THAT(measured_text(workspace()), HasSubstr(fmt::format("in beam {} of each fan alone", bright().beam)));
}

TEST_F(MeasureAtWork, ALassoSumsWhatItEnclosesOnce) {
  // Two triangles that meet in the middle, drawn in one stroke.
  // The crossing lies beside every voxel's centre.
  const PixelPoint m{at(app_.top(), bright()).x + 0.37, at(app_.top(), bright()).y + 0.11};
  std::vector<PixelPoint> way{{m.x - 50, m.y - 40}, {m.x + 50, m.y + 40}, {m.x + 50, m.y - 40}, {m.x - 50, m.y + 40}};
  drag(app_.top(), way, false, true);
  ASSERT_TRUE(measured());
  EXPECT_EQ(measured()->shape, Measurement::Shape::lasso);
  expect_sums(app_.top(), [&](PixelPoint p) {
    const double x = std::abs(p.x - m.x) / 50.0;
    const double y = std::abs(p.y - m.y) / 40.0;
    return x < 1.0 && y < x;
  });
  EXPECT_THAT(measured_text(workspace()), HasSubstr(fmt::format("in fan {} alone", bright().fan)));
}

TEST_F(MeasureAtWork, TheSwitchTakesAnAreaFromAboveThroughAllFans) {
  const PixelPoint m = at(app_.top(), bright());
  drag(app_.top(), {{m.x - 30, m.y - 20}, {m.x + 20, m.y + 20}}, true);
  const auto alone = measured()->area.statistics.echo.voxels;
  app_.ask("measure.all_fans");
  EXPECT_GT(measured()->area.statistics.echo.voxels, alone);
  expect_sums(
      app_.top(), [&](PixelPoint p) { return std::abs(p.x - m.x + 5) < 25.0 && std::abs(p.y - m.y) < 20.0; }, true);
  EXPECT_THAT(measured_text(workspace()), HasSubstr(fmt::format("in all {} fans", sector().fans())));
}

TEST_F(MeasureAtWork, StatisticsOfASchoolsMaskAreThoseOfItsRow) {
  workspace().tool.set(ToolName::seed);
  app_.click(app_.side(), bright());
  app_.settle();
  const PingMask mask = document().state().schools.at(0)->masks.pings.front().mask;
  const ProductPtr product = document().product(0);
  ASSERT_TRUE(product);
  const SchoolPingRow& row = product->school_pings.at(0);
  const auto& shown = *document().shown();
  const VoxelStatistics of_mask =
      statistics_of(mask, *document().staged(), shown.sector(), shown.placement(document().ping()));
  EXPECT_NEAR(of_mask.echo.sv_mean_db, row.sv_mean_db, 1e-9);
  EXPECT_NEAR(of_mask.echo.backscatter_m2 / row.backscatter_m2, 1.0, 1e-9);
  EXPECT_NEAR(of_mask.extents.depth_max_m, row.depth_max_m, 1e-9);
  EXPECT_NEAR(of_mask.extents.length_m, row.length_m, 1e-9);
}

TEST_F(MeasureAtWork, EscapeEndsADragAndForgetsWhatWasMeasured) {
  const PixelPoint from = at(app_.top(), bright());
  app_.top().pointer({PointerAction::press, PointerButton::left, from});
  app_.top().pointer({PointerAction::move, PointerButton::left, {from.x + 30, from.y}});
  EXPECT_TRUE(app_.app.measure_tool->drawing());
  app_.ask("tool.cancel");
  EXPECT_FALSE(measured());
  app_.top().pointer({PointerAction::move, PointerButton::left, {from.x + 40, from.y}});
  app_.top().pointer({PointerAction::release, PointerButton::left, {from.x + 40, from.y}});
  EXPECT_FALSE(measured()) << "the drag has never been";
  drag(app_.top(), {from, {from.x + 30, from.y}});
  EXPECT_TRUE(measured());
  workspace().tool.set(ToolName::seed);
  EXPECT_TRUE(measured()) << "it stays under another tool";
  app_.ask("tool.cancel");
  EXPECT_FALSE(measured());
}

TEST_F(MeasureAtWork, APressThatGoesNowhereForgetsItAndNothingIsWritten) {
  const PixelPoint from = at(app_.top(), bright());
  drag(app_.top(), {from, {from.x + 30, from.y}});
  ASSERT_TRUE(measured());
  app_.click(app_.top(), bright());
  EXPECT_FALSE(measured());
  EXPECT_TRUE(document().state().schools.empty()) << "the tool grows nothing";
  EXPECT_FALSE(workspace().preview().mask);
}

TEST_F(MeasureAtWork, ItBelongsToItsPingAndItsSlice) {
  const PixelPoint from = at(app_.top(), bright());
  drag(app_.top(), {from, {from.x + 40, from.y + 10}});
  const auto lines = [&] {
    int count = 0;
    for (const Overlay& overlay : app_.top().overlays()) count += overlay.text.empty() ? 0 : 1;
    return count;
  };
  EXPECT_EQ(lines(), 1);
  document().look_at(SlicesApp::bright().ping + 1);
  app_.settle();
  EXPECT_EQ(lines(), 0);
  EXPECT_EQ(measured_text(workspace()), "");
  app_.look_at_bright();
  EXPECT_EQ(lines(), 1);
  workspace().slices.set({bright().fan == 0 ? 1 : bright().fan - 1, bright().beam});
  app_.settle();
  EXPECT_EQ(lines(), 0) << "another fan";
}

TEST_F(MeasureAtWork, TheLineStaysOnItsVoxelsWhenZoomedAndTurned) {
  const int beam = bright().beam + (bright().beam < sector().beams() / 2 ? 2 : -2);
  const Voxel to{bright().fan, beam, bright().sample};
  drag(app_.top(), {at(app_.top(), bright()), at(app_.top(), to)});
  const auto end = [&]() -> PixelPoint {
    for (const Overlay& overlay : app_.top().overlays()) {
      if (!overlay.text.empty()) return overlay.line.back();
    }
    return {};
  };
  PointerEvent wheel{PointerAction::wheel, PointerButton::none, at(app_.top(), bright())};
  wheel.control = true;
  wheel.wheel_steps = 3.0;
  app_.top().pointer(wheel);
  app_.settle();
  EXPECT_NEAR(end().x, at(app_.top(), to).x, 1e-6);
  EXPECT_NEAR(end().y, at(app_.top(), to).y, 1e-6);
  app_.ask("display.all");
  app_.ask("display.north_up");
  app_.settle();
  EXPECT_NE(app_.top().picture()->map->view().up_rad, 0.0);
  EXPECT_NEAR(end().x, at(app_.top(), to).x, 1e-6);
  EXPECT_NEAR(end().y, at(app_.top(), to).y, 1e-6);
}

TEST_F(MeasureAtWork, FiguresAreCopiedWithTheirUnits) {
  std::string copied;
  app_.app.dialogs.copy = [&](const std::string& text) { copied = text; };
  app_.ask("measure.copy");
  EXPECT_EQ(copied, "") << "nothing is measured";
  const PixelPoint m = at(app_.top(), bright());
  drag(app_.top(), {{m.x - 30, m.y - 20}, {m.x + 20, m.y + 20}}, true);
  app_.ask("list.copy");
  const auto end = copied.find('\n');
  ASSERT_NE(end, std::string::npos);
  const std::string names = copied.substr(0, end);
  const std::string values = copied.substr(end + 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), '\t'), std::count(values.begin(), values.end(), '\t'));
  EXPECT_THAT(names, HasSubstr("\tsigma_bs total (m2)\t"));
  EXPECT_THAT(values, HasSubstr(fmt::format("{:.3f}", measured()->area.statistics.echo.sv_mean_db)));
  EXPECT_EQ(document().notices(), std::vector<std::string>{});
}

// 30.48 m are 100 ft, 60.96 m 200 ft, 15.24 m 50 ft.
TEST(MeasuredText, IsInTheUnitsThatAreRead) {
  Measurement measured;
  measured.line = {.horizontal_m = 30.48, .slant_m = 60.96, .deeper_m = 15.24};
  const Units feet{LengthUnit::feet, SpeedUnit::usual};
  EXPECT_EQ(whole_text(measured, feet), "line: 100.0 ft horizontal, 200.0 ft slant, 50.0 ft deeper");
  EXPECT_EQ(brief_text(measured), "30.5 m horizontal\n61.0 m slant\n15.2 m deeper");
  EXPECT_THAT(table_text(measured, feet), HasSubstr("\tslant distance (ft)\t"));
  EXPECT_THAT(table_text(measured, feet), HasSubstr("\t200.00\t"));
  EXPECT_THAT(table_text(measured), HasSubstr("\t60.96\t"));
  measured.on = Measurement::On::map;
  measured.line.horizontal_m = 1852.0;
  EXPECT_THAT(whole_text(measured, feet), HasSubstr("6 076 ft, 1.000 nmi")) << "1852 / 0.3048 = 6076.1";
  EXPECT_THAT(whole_text(measured), HasSubstr("1 852 m, 1.000 nmi"));
}

}  // namespace
}  // namespace sonar
