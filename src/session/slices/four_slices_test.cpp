// SPDX-License-Identifier: Apache-2.0
// The range slice and the plane slice, beside the two that a window begins with.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "session/slices/slice_places.h"
#include "session/slices/test_slices.h"

namespace sonar {
namespace {

class FourSlices : public testing::Test {
 protected:
  void SetUp() override {
    app_.look_at_bright();
    app_.show_all_four();
    lay_slices_through(workspace(), bright());
    app_.settle();
  }
  Workspace& workspace() { return app_.workspace(); }
  const Voxel& bright() { return SlicesApp::bright().voxel; }
  const Sector& sector() { return app_.document().shown()->sector(); }
  PlaneSlice plane() { return std::get<PlaneSlice>(live_slice(workspace(), SliceKind::plane, app_.document().ping())); }
  void turn(SliceModel& slice, double steps, bool shift = false) {
    PointerEvent wheel = app_.at(slice, bright(), PointerAction::wheel);
    wheel.wheel_steps = steps;
    wheel.shift = shift;
    slice.pointer(wheel);
  }
  /// What a slice shows at a place: the voxel, or one beside it along the beam, where a pixel is wider than a sample.
  static bool shows(const SliceModel& slice, PixelPoint at, const Voxel& voxel) {
    const auto there = slice.picture()->voxel_at(at);
    return there && there->fan == voxel.fan && there->beam == voxel.beam && std::abs(there->sample - voxel.sample) <= 2;
  }
  static std::optional<PixelPoint> cross_in(SliceModel& slice) {
    for (const Overlay& one : slice.overlays()) {
      if (one.cross) return one.cross;
    }
    return std::nullopt;
  }
  static std::size_t lines_in(SliceModel& slice) {
    const auto over = slice.overlays();
    return static_cast<std::size_t>(std::count_if(over.begin(), over.end(), [](const Overlay& o) { return o.muted; }));
  }

  SlicesApp app_;
};

TEST_F(FourSlices, AllShowTheVoxelThatTheyLieThrough) {
  for (SliceModel* slice : {&app_.top(), &app_.side(), &app_.range(), &app_.plane()}) {
    EXPECT_EQ(slice->problem(), "");
    const auto place = slice->picture()->place_of(bright());
    ASSERT_TRUE(place);
    EXPECT_TRUE(shows(*slice, *place, bright()));
  }
}

TEST_F(FourSlices, TheWheelMovesTheRangeByARoundStepAndWithShiftByASample) {
  const double step_m = slice_step_m(sector());
  const double reach_m = sector().range().range_m(sector().range().count);
  EXPECT_LE(step_m, 0.01 * reach_m);
  EXPECT_GT(step_m, 0.004 * reach_m);
  const int samples = static_cast<int>(std::lround(step_m / sector().range().spacing_m));
  ASSERT_GE(samples, 1);
  turn(app_.range(), 1.0);
  EXPECT_EQ(workspace().slices().sample, bright().sample + samples);
  turn(app_.range(), -1.0);
  turn(app_.range(), 1.0, true);
  EXPECT_EQ(workspace().slices(), (SlicePlaces{bright().fan, bright().beam, bright().sample + 1}));
  turn(app_.range(), -1000.0);
  EXPECT_EQ(workspace().slices().sample, 0);
  app_.ask("slice.range_out");
  EXPECT_EQ(workspace().slices().sample, samples);
  app_.ask("slice.range_in");
  EXPECT_EQ(workspace().slices().sample, 0);
}

TEST_F(FourSlices, TheWheelMovesThePlaneAndWithShiftTurnsIt) {
  const double step_m = slice_step_m(sector());
  const double depth_m = workspace().plane.values().depth_m;
  turn(app_.plane(), 1.0);
  EXPECT_NEAR(workspace().plane.values().depth_m, depth_m - step_m, 1e-9) << "up";
  app_.ask("slice.plane_near");
  EXPECT_NEAR(workspace().plane.values().depth_m, depth_m, 1e-9);
  app_.ask("slice.plane_vertical");
  app_.settle();
  const PlanePlace before = workspace().plane.values();
  turn(app_.plane(), 2.0, true);
  EXPECT_NEAR(std::remainder(workspace().plane.values().bearing_deg - before.bearing_deg, 360.0), 4.0, 1e-9);
  app_.settle();
  EXPECT_EQ(app_.plane().problem(), "");
  EXPECT_EQ(app_.plane().picture()->map->view().slice, Slice(plane()));
}

// The panel and the menu: another kind of plane is of use at once, wherever the one before lay.
TEST_F(FourSlices, AnotherKindOfPlaneLiesThroughTheSelectedSchool) {
  app_.click(app_.top(), bright());
  app_.settle();
  const Voxel middle = *selected_middle(workspace());
  for (const std::size_t kind : {1U, 2U, 0U}) {
    ASSERT_TRUE(!!workspace().plane.set("plane", Choice{kind}));
    app_.settle();
    EXPECT_EQ(app_.plane().problem(), "");
    EXPECT_TRUE(app_.plane().picture()->place_of(middle)) << kind;
  }
}

TEST_F(FourSlices, TheCursorOfOneIsSeenInAllOthers) {
  app_.range().pointer(app_.at(app_.range(), bright(), PointerAction::move));
  ASSERT_EQ(workspace().cursor(), std::optional(bright()));
  for (SliceModel* slice : {&app_.top(), &app_.side(), &app_.plane()}) {
    const auto cross = cross_in(*slice);
    ASSERT_TRUE(cross);
    EXPECT_TRUE(shows(*slice, *cross, bright()));
  }
  EXPECT_FALSE(cross_in(app_.range()));
  app_.range().pointer({PointerAction::leave, PointerButton::none, {}});
  app_.top().pointer(app_.at(app_.top(), bright(), PointerAction::move));
  const auto cross = cross_in(app_.range());
  ASSERT_TRUE(cross);
  EXPECT_EQ(app_.range().picture()->voxel_at(*cross), workspace().cursor());
}

// A cursor elsewhere is shown where it would lie: the range slice keeps its fan and beam.
TEST_F(FourSlices, ACursorBesideASliceIsCarriedIntoIt) {
  const Voxel elsewhere{bright().fan, bright().beam, bright().sample + 60};
  app_.top().pointer(app_.at(app_.top(), elsewhere, PointerAction::move));
  const Voxel pointed = *workspace().cursor();
  const auto cross = cross_in(app_.range());
  ASSERT_TRUE(cross);
  EXPECT_EQ(app_.range().picture()->voxel_at(*cross), (Voxel{pointed.fan, pointed.beam, bright().sample}));
  EXPECT_TRUE(cross_in(app_.plane()));
}

TEST_F(FourSlices, EachShowsWhereTheOthersRunThroughIt) {
  app_.ask("slice.plane_vertical");
  app_.settle();
  // The plane stands along the beam that the slice from the side is of: of these two neither cuts the other.
  for (SliceModel* slice : {&app_.side(), &app_.plane()}) EXPECT_GE(lines_in(*slice), 2U);
  for (SliceModel* slice : {&app_.top(), &app_.range()}) EXPECT_GE(lines_in(*slice), 3U);
  ViewSwitches views = workspace().views.values();
  views.range_slice = views.plane_slice = false;
  workspace().views.assign(views);
  app_.settle();
  EXPECT_EQ(lines_in(app_.top()), 1U) << "of what is switched off nothing is seen";
}

TEST_F(FourSlices, AClickSelectsAsInTheOtherSlices) {
  app_.click(app_.top(), bright());
  app_.settle();
  const auto school = workspace().school();
  ASSERT_TRUE(school);
  for (SliceModel* slice : {&app_.range(), &app_.plane()}) {
    workspace().school.set(std::nullopt);
    app_.settle();
    const SlicePlaces before = workspace().slices();
    const PlanePlace lay = workspace().plane.values();
    app_.click(*slice, bright());
    app_.settle();
    EXPECT_EQ(workspace().school(), school);
    EXPECT_EQ(workspace().slices(), before) << "who clicks in a slice goes on looking at it";
    EXPECT_EQ(workspace().plane.values(), lay);
    EXPECT_THAT(slice->hint(*slice->picture()->place_of(bright())), testing::HasSubstr("school 1"));
  }
}

TEST_F(FourSlices, TheBrushPaintsWhatTheSliceShows) {
  workspace().tool.set(ToolName::brush);
  for (SliceModel* slice : {&app_.range(), &app_.plane()}) {
    const std::size_t schools = app_.document().state().schools.size();
    workspace().school.set(std::nullopt);
    app_.settle();
    const std::set<std::int32_t> shown(slice->picture()->map->voxels().begin(), slice->picture()->map->voxels().end());
    app_.click(*slice, bright());
    app_.settle();
    ASSERT_EQ(app_.document().state().schools.size(), schools + 1);
    const auto* there = in_ping(app_.document().state().schools.back()->masks, app_.document().ping());
    ASSERT_TRUE(there != nullptr);
    EXPECT_GT(confidence_at(there->mask, bright().fan * sector().beams() + bright().beam, bright().sample), 0);
    std::size_t seen = 0;
    for (const sonar::Run& run : there->mask.runs) {
      for (int s = run.first_sample; s < run.end(); ++s)
        seen += shown.contains(run.row * sector().range().count + s) ? 1U : 0U;
    }
    EXPECT_GT(seen, there->mask.voxels() / 3) << "what lies between two pixels is painted too";
  }
}

TEST_F(FourSlices, ASectionStandsAlongTheLineThatIsDrawn) {
  app_.ask("slice.section");
  EXPECT_EQ(workspace().tool(), ToolName::section);
  SliceModel& top = app_.top();
  const Voxel to{bright().fan, bright().beam + 3, bright().sample + 40};
  const PixelPoint a = *top.picture()->place_of(bright());
  const PixelPoint b = *top.picture()->place_of(to);
  top.pointer({PointerAction::press, PointerButton::left, a});
  top.pointer({PointerAction::move, PointerButton::left, b});
  EXPECT_TRUE(std::ranges::any_of(top.overlays(), [](const Overlay& o) { return !o.muted && o.line.size() == 2; }));
  top.pointer({PointerAction::release, PointerButton::left, b});
  app_.settle();
  EXPECT_EQ(workspace().tool(), ToolName::seed) << "one drag";
  EXPECT_TRUE(app_.document().state().schools.empty()) << "and nothing grows";
  const SliceMap& map = *app_.plane().picture()->map;
  EXPECT_EQ(std::get<PlaneSlice>(map.view().slice).kind, PlaneSlice::Kind::vertical);
  for (const Voxel& one : {bright(), to}) {
    const auto place = map.carried(one);
    ASSERT_TRUE(place);
    EXPECT_LT(norm(map.point_at(*place) - sector().centre(one.fan, one.beam, one.sample)), 1.0);
  }
  EXPECT_LT(map.carried(bright())->x, map.carried(to)->x) << "it begins at the left";
  app_.ask("slice.section");
  app_.ask("tool.cancel");
  EXPECT_EQ(workspace().tool(), ToolName::seed);
}

TEST_F(FourSlices, APlaneBesideTheSectorSaysSoAndCanBeHadBack) {
  PlanePlace away = workspace().plane.values();
  away.depth_m = 5000.0;
  workspace().plane.assign(away);
  app_.settle();
  EXPECT_THAT(app_.plane().problem(), testing::HasSubstr("does not meet the sonar's sector"));
  EXPECT_TRUE(app_.plane().overlays().empty());
  lay_plane(workspace());
  app_.settle();
  EXPECT_EQ(app_.plane().problem(), "");
}

}  // namespace
}  // namespace sonar
