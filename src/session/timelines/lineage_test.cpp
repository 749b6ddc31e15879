// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "session/test_app.h"
#include "session/timelines/lineage_data.h"
#include "session/timelines/lineage_model.h"

namespace sonar {
namespace {

using testing::HasSubstr;

/// School 1 in pings 2 to 8, school 2 in pings 1 to 6, both by hand.
class LineageAtWork : public testing::Test, protected TestApp {
 protected:
  void SetUp() override {
    begin();
    paint(2, 8, 5, 5, 200);
    paint(1, 6, 12, 12, 300);
    settle();
    ASSERT_TRUE(workspace().views.set("lineage", true));
    model().resize({800, 400}, 1.0);
    model().set_seen(true);
    settle();
    ASSERT_TRUE(model().sight()) << model().problem();
  }
  LineageModel& model() { return dynamic_cast<LineageModel&>(*app_->picture("lineage")); }
  void settle() {
    do {
      document().settle();
      model().wait();
    } while (queue_.drain() > 0);
  }
  /// In the middle of a ping's part of a school's bar.
  [[nodiscard]] PixelPoint at(std::int64_t school, std::int64_t ping) {
    const LineageSight& seen = *model().sight();
    const PixelPoint from = seen.place_of(school, ping);
    return {0.5 * (from.x + seen.place_of(school, ping + 1).x), from.y};
  }
  [[nodiscard]] PixelPoint free_lane(std::int64_t ping) {
    const LineageSight& seen = *model().sight();
    return {at(1, ping).x, seen.drawn.plot.at(0.0, static_cast<double>(seen.drawn.lanes.size()) + 0.5).y};
  }
  void drag(PixelPoint from, PixelPoint to, bool shift = false) {
    model().pointer({.action = PointerAction::press, .button = PointerButton::left, .at = from, .shift = shift});
    model().pointer({.action = PointerAction::move, .button = PointerButton::left, .at = to, .shift = shift});
    model().pointer({.action = PointerAction::release, .button = PointerButton::left, .at = to, .shift = shift});
    settle();
  }
  /// "1:2-8 2:1-6 ": schools and their first and last pings, with how many they have.
  [[nodiscard]] std::string tracks() {
    std::string text;
    for (const auto& school : document().state().schools) {
      const auto& pings = school->masks.pings;
      text += std::to_string(school->number) + ":" + std::to_string(pings.front().ping_index) + "-" +
              std::to_string(pings.back().ping_index) + "(" + std::to_string(pings.size()) + ") ";
    }
    return text;
  }
  /// [ping] voxels of all schools.
  [[nodiscard]] std::map<std::int64_t, std::size_t> voxels() {
    std::map<std::int64_t, std::size_t> sum;
    for (const auto& school : document().state().schools) {
      for (const auto& there : school->masks.pings) sum[there.ping_index] += there.mask.voxels();
    }
    return sum;
  }
  /// [ping] backscatter of all schools, m^2.
  [[nodiscard]] std::map<std::int64_t, double> backscatter() {
    std::map<std::int64_t, double> sum;
    for (const SchoolPingRow& row : document().product(0)->school_pings) sum[row.ping_index] += row.backscatter_m2;
    return sum;
  }
};

TEST_F(LineageAtWork, APressSelectsTheSchoolAndGoesToThePing) {
  drag(at(2, 4), at(2, 4));
  EXPECT_EQ(workspace().school(), (SchoolName{0, 2}));
  EXPECT_EQ(document().ping(), 4);
  EXPECT_EQ(model().sight()->data.selected, 2);
  drag(at(1, 3), at(1, 6));
  EXPECT_EQ(document().ping(), 6) << "dragging along its lane goes on";
  EXPECT_EQ(tracks(), "1:2-8(7) 2:1-6(6) ");
  EXPECT_THAT(model().hint(at(1, 8)), HasSubstr("school 1"));
  EXPECT_THAT(model().hint(at(1, 8)), HasSubstr("first seen in ping 2"));
  EXPECT_THAT(model().hint(at(1, 8)), HasSubstr("lost after ping 8"));
  EXPECT_THAT(model().hint(at(1, 9)), HasSubstr("not seen"));
}

TEST_F(LineageAtWork, CutAndJoinedItIsWhatItWas) {
  const auto before = voxels();
  drag(at(1, 5), free_lane(5));
  EXPECT_EQ(last_line().command, "split");
  EXPECT_EQ(tracks(), "1:2-4(3) 2:1-6(6) 3:5-8(4) ");
  EXPECT_EQ(voxels(), before);
  ASSERT_EQ(model().sight()->drawn.lanes.size(), 3U);
  drag(at(3, 6), at(1, 6));
  EXPECT_EQ(last_line().command, "merge");
  EXPECT_EQ(tracks(), "1:2-8(7) 2:1-6(6) ");
  EXPECT_EQ(voxels(), before);
  EXPECT_EQ(workspace().school(), (SchoolName{0, 1}));
}

TEST_F(LineageAtWork, OutOfTheMarkedIntervalAPieceIsHandedOverAndUndone) {
  const auto before = voxels();
  const auto echo = backscatter();
  drag(at(1, 3), at(1, 5), true);
  ASSERT_EQ(workspace().marked_interval(), (MarkedInterval{0, 3, 5}));
  drag(at(1, 4), at(2, 4));
  EXPECT_EQ(last_line().command, "hand_over");
  EXPECT_EQ(document().choices().failure, "");
  EXPECT_EQ(tracks(), "1:2-8(4) 2:1-6(6) ");
  EXPECT_EQ(voxels(), before);
  for (const auto& [ping, m2] : backscatter()) EXPECT_NEAR(m2, echo.at(ping), 1e-9 * std::abs(m2)) << ping;
  EXPECT_EQ(document().choices().undo_text, "Undo hand over pings of school 1");
  EXPECT_FALSE(workspace().marked_interval());
  const auto& edges = model().sight()->data.edges;
  EXPECT_TRUE(std::ranges::find(edges, TrackEdge{1, TrackEdgeKind::lost, 2, 0}) != edges.end());
  EXPECT_TRUE(std::ranges::find(edges, TrackEdge{1, TrackEdgeKind::refound, 6, 0}) != edges.end());
  press("edit.undo");
  settle();
  EXPECT_EQ(tracks(), "1:2-8(7) 2:1-6(6) ");
}

TEST_F(LineageAtWork, AMarkedPieceOnTheFreeLaneIsASchoolOfItsOwn) {
  const auto before = voxels();
  drag(at(1, 3), at(1, 5), true);
  drag(at(1, 4), free_lane(4));
  EXPECT_EQ(tracks(), "1:2-8(4) 2:1-6(6) 3:3-5(3) ");
  EXPECT_EQ(voxels(), before);
}

TEST_F(LineageAtWork, WithoutSchoolsNothingIsSaidOfThoseThatWere) {
  const PixelPoint was = at(1, 4);
  for (int i = 0; i < 20 && !document().state().schools.empty(); ++i) {
    press("edit.undo");
    settle();
  }
  EXPECT_TRUE(model().image().pixels.empty());
  EXPECT_FALSE(model().sight());
  EXPECT_EQ(model().hint(was), "");
  EXPECT_TRUE(model().overlays().empty());
}

TEST_F(LineageAtWork, NothingHappensOutsideOrOnItsOwnLane) {
  const auto lines = document().choices().lines->size();
  drag(at(1, 4), {1.0, 1.0});
  drag(at(1, 4), at(1, 5));
  drag(at(1, 10), at(2, 4));
  EXPECT_EQ(document().choices().lines->size(), lines) << "the last began where the school is not seen";
}

TEST_F(LineageAtWork, EscapeEndsADragThatThenDoesNothing) {
  const auto lines = document().choices().lines->size();
  const auto pointer = [&](PointerAction action, PointerButton button, PixelPoint place) {
    model().pointer({.action = action, .button = button, .at = place});
  };
  for (const PixelPoint to : {at(2, 5), free_lane(5), at(1, 7)}) {
    pointer(PointerAction::press, PointerButton::left, at(1, 5));
    pointer(PointerAction::move, PointerButton::left, to);
    const std::size_t drawn = model().overlays().size();
    press("tool.cancel");
    EXPECT_TRUE(workspace().school()) << "Escape ended the drag, not the selection";
    EXPECT_LE(model().overlays().size(), drawn);
    pointer(PointerAction::move, PointerButton::left, to);
    const std::int64_t ping = document().ping();
    pointer(PointerAction::move, PointerButton::left, at(2, 2));
    EXPECT_EQ(document().ping(), ping) << "nothing follows the pointer any more";
    pointer(PointerAction::release, PointerButton::left, at(2, 2));
    settle();
  }
  EXPECT_EQ(document().choices().lines->size(), lines);
  EXPECT_EQ(tracks(), "1:2-8(7) 2:1-6(6) ");
  press("tool.cancel");
  EXPECT_FALSE(workspace().school()) << "without a drag it selects nothing";
  drag(at(1, 5), at(2, 5));
  EXPECT_EQ(tracks(), "2:1-8(8) ") << "the next drag is a drag again";
}

TEST_F(LineageAtWork, TheSameJournalGivesTheSameTracks) {
  drag(at(1, 5), free_lane(5));
  drag(at(2, 2), at(2, 3), true);
  drag(at(2, 2), at(1, 2));
  const std::string after = tracks();
  const auto held = voxels();
  ASSERT_EQ(after, "1:2-4(3) 2:1-6(4) 3:5-8(4) ");
  begin();
  document().settle();
  EXPECT_EQ(tracks(), after);
  EXPECT_EQ(voxels(), held);
}

TEST_F(LineageAtWork, TheWheelZoomsTimeAndLanesFollow) {
  const auto all = model().sight()->places.all;
  model().pointer({.action = PointerAction::wheel, .at = at(2, 1), .wheel_steps = 4.0});
  settle();
  const PlotAxis x = model().sight()->drawn.plot.x;
  EXPECT_LT((x.last - x.first) * 1e9, static_cast<double>(all.last - all.first));
  press("map.all");
  settle();
  EXPECT_NEAR(model().sight()->drawn.plot.x.last * 1e9, static_cast<double>(all.last - all.first), 1.0);
}

}  // namespace
}  // namespace sonar
