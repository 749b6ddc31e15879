// SPDX-License-Identifier: Apache-2.0
// Slices that go with the selected school, the lock that holds them, and the keys of the colours.
#include <gtest/gtest.h>

#include <QCheckBox>
#include <QTreeView>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "clocked_window.h"
#include "session/looks/transfer_editor.h"
#include "session/maps/observation_map_model.h"
#include "session/playing/playback.h"
#include "session/volume/volume_model.h"

namespace sonar {
namespace {

class Following : public ClockedWindow {
 protected:
  /// A school over several pings; the window looks at the first of them, with the slices elsewhere and nothing selected.
  void follow_a_school() {
    target_ = look_at_school();
    double_click("top_slice", place_in("top_slice", target_.voxel));
    ASSERT_GT(masks().size(), 2U);
    masks_ = document().state().schools.front()->masks;
    document().look_at(masks().front().ping_index);
    settle();
    raise("schools");
    key(Qt::Key_Escape);
    ASSERT_FALSE(workspace().school());
    workspace().slices.set({});
    settle_jobs();
    ASSERT_FALSE(both_cut());
  }
  /// A click on the school's row.
  void select() {
    auto& list = *view("schools")->findChild<QTreeView*>("rows");
    const QRect place = list.visualRect(list.model()->index(0, list.columnAt(8)));
    click_on(list.viewport(), {12.0, static_cast<double>(place.center().y())});
    ASSERT_TRUE(workspace().school());
  }
  /// Whether the slices from above and from the side meet a voxel of the school in the ping on show.
  bool both_cut() {
    const auto* there = in_ping(masks_, document().ping());
    if (there == nullptr) return false;
    const int beams = document().shown()->sector().beams();
    const auto& runs = there->mask.runs;
    const auto fan = [&](const sonar::Run& run) { return run.row / beams == workspace().slices().fan; };
    const auto beam = [&](const sonar::Run& run) { return run.row % beams == workspace().slices().beam; };
    return std::ranges::any_of(runs, fan) && std::ranges::any_of(runs, beam);
  }
  /// Pixels of a slice that lie within the only school, three from whatever is not.
  std::vector<PixelPoint> inside_school(const std::string& dock) {
    const auto& picture = *dynamic_cast<SliceModel&>(*app_->picture(dock)).picture();
    const PingMask& mask = in_ping(document().state().schools.front()->masks, document().ping())->mask;
    const int beams = document().shown()->sector().beams();
    const auto member = [&](double x, double y) {
      const auto voxel = picture.voxel_at({x, y});
      return voxel && std::ranges::any_of(mask.runs, [&](const sonar::Run& run) {
               return run.row == voxel->fan * beams + voxel->beam && voxel->sample >= run.first_sample &&
                      voxel->sample < run.end();
             });
    };
    constexpr double kOff = 3.0;
    std::vector<PixelPoint> within;
    const PixelSize size = app_->picture(dock)->image().size;
    for (double x = kOff; x < size.width - kOff; ++x) {
      for (double y = kOff; y < size.height - kOff; ++y) {
        if (member(x, y) && member(x - kOff, y) && member(x + kOff, y) && member(x, y - kOff) && member(x, y + kOff))
          within.push_back({x, y});
      }
    }
    return within;
  }
  Target target_;
  SchoolMasks masks_;
};

TEST_F(Following, SlicesGoToASchoolPickedInTheTableAlsoWhilePingsPlay) {
  ASSERT_NO_FATAL_FAILURE(follow_a_school());
  select();
  EXPECT_TRUE(both_cut());
  const std::int64_t ping = document().ping();
  press(Qt::Key_Space);
  tick(0.0);
  workspace().slices.set({});
  settle_jobs();
  ASSERT_FALSE(both_cut());
  tick(0.55);
  ASSERT_EQ(document().ping(), ping + 1);
  EXPECT_TRUE(both_cut());
  press(Qt::Key_Space);
}

TEST_F(Following, TheLockLeavesThemWhereTheyAre) {
  ASSERT_NO_FATAL_FAILURE(follow_a_school());
  key(Qt::Key_L, Qt::ControlModifier | Qt::ShiftModifier);
  select();
  EXPECT_EQ(workspace().slices(), SlicePlaces{});
  key(Qt::Key_Right);
  EXPECT_EQ(workspace().slices(), SlicePlaces{});
  key(Qt::Key_L, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_TRUE(both_cut()) << "unlocked, they go to what is selected";
}

TEST_F(Following, AlsoToOnePickedOnTheMapOrInTheVolume) {
  ASSERT_NO_FATAL_FAILURE(follow_a_school());
  document().look_at(target_.ping);
  settle();
  raise("observation_map");
  const auto& map = dynamic_cast<ObservationMapModel&>(*app_->picture("observation_map"));
  std::optional<PixelPoint> on_map;
  for (int y = 0; y < map.image().size.height && !on_map; ++y) {
    for (int x = 0; x < map.image().size.width && !on_map; ++x) {
      const PixelPoint at{static_cast<double>(x), static_cast<double>(y)};
      if (map.places()->school_at(at) != 0 && !map.places()->ping_at(at, 12.0)) on_map = at;
    }
  }
  ASSERT_TRUE(on_map);
  click("observation_map", *on_map);
  ASSERT_TRUE(workspace().school());
  EXPECT_TRUE(both_cut()) << "from the map";
  key(Qt::Key_Escape);
  workspace().slices.set({});
  raise("volume");
  ASSERT_FALSE(both_cut());
  const auto& volume = dynamic_cast<VolumeModel&>(*app_->picture("volume"));
  const Sector& sector = document().shown()->sector();
  const auto seen =
      volume.shown()->place_of(sector.centre(target_.voxel.fan, target_.voxel.beam, target_.voxel.sample));
  ASSERT_TRUE(seen);
  click("volume", {std::floor(seen->x), std::floor(seen->y)});
  ASSERT_TRUE(workspace().school());
  EXPECT_EQ(document().state().schools.size(), 1U) << "selected, not grown anew";
  EXPECT_TRUE(both_cut()) << "from the volume";
}

// Only lines lie over the school's echoes: between them each pixel has the colour of Sv that it has without schools. A
// tint, once it is switched on in the controls, changes all of them.
TEST_F(Following, AnOutlineLeavesTheColoursOfSvAndATintDoesNot) {
  const Target target = look_at_school();
  double_click("top_slice", place_in("top_slice", target.voxel));
  wheel("top_slice", place_in("top_slice", target.voxel), 12, Qt::ControlModifier);
  move("controls", {4.0, 4.0});  // the pointer's own lines are not what is looked at
  const auto& slice = dynamic_cast<SliceModel&>(*app_->picture("top_slice"));
  const Image outlined = slice.image();
  const std::vector<PixelPoint> within = inside_school("top_slice");
  ASSERT_GT(within.size(), 2000U);
  view("top_slice")->setFocus();
  key(Qt::Key_M);
  const Image bare = slice.image();
  key(Qt::Key_M);
  ASSERT_EQ(slice.image(), outlined);
  const auto changed = [&](const Image& with) {
    const auto differs = [&](PixelPoint at) {
      const int x = static_cast<int>(at.x);
      const int y = static_cast<int>(at.y);
      return with.at(x, y) != bare.at(x, y);
    };
    return static_cast<double>(std::ranges::count_if(within, differs)) / static_cast<double>(within.size());
  };
  EXPECT_LT(changed(outlined), 0.25) << "the core's line and the school's name";
  QTest::keyClick(&control<QCheckBox>("More of schools", "tint"), Qt::Key_Space);
  settle();
  ASSERT_TRUE(workspace().display.values().tint);
  keep_picture("tinted");
  EXPECT_GT(changed(slice.image()), 0.9);
}

TEST_F(Following, F7TakesTheColoursOfTheEchoSounderAndF5TheUsualOnes) {
  const Target target = look_at_school();
  const DisplayParams usual = workspace().display.values();
  const Image before = app_->picture("top_slice")->image();
  key(Qt::Key_F7);
  EXPECT_EQ(workspace().display.values().scale.map, ColourMapName::ek500);
  EXPECT_EQ(workspace().display.values().scale.low_db, usual.scale.low_db) << "the limits stay";
  EXPECT_NE(app_->picture("top_slice")->image(), before);
  ASSERT_TRUE(workspace().display.set("scale.low_db", usual.scale.low_db - 15.0));
  key(Qt::Key_F5);
  EXPECT_EQ(workspace().display.values().scale.map, usual.scale.map);
  EXPECT_EQ(workspace().display.values().scale.low_db, usual.scale.low_db);
  EXPECT_EQ(app_->picture("top_slice")->image(), before) << "in ping " << target.ping;
}

TEST_F(Following, F5TakesBackACurveThatWasDrawnByHand) {
  look_at_school();
  const std::vector<OpacityPoint> usual = app_->transfer->points();
  ASSERT_GT(usual.size(), 1U);
  auto* editor = window_->findChild<QWidget*>("transfer_editor");
  const PixelPoint corner = app_->transfer->place_of(usual[1]);
  press_on(editor, corner);
  move_on(editor, {corner.x + 12.0, corner.y + 8.0});
  release_on(editor, {corner.x + 12.0, corner.y + 8.0});
  ASSERT_FALSE(workspace().curve_follows_scale());
  EXPECT_NE(app_->transfer->points(), usual);
  key(Qt::Key_F5);
  EXPECT_TRUE(workspace().curve_follows_scale());
  EXPECT_EQ(app_->transfer->points(), usual);
}

}  // namespace
}  // namespace sonar
