// SPDX-License-Identifier: Apache-2.0
#include "session/tools/brush_tool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "session/slices/test_slices.h"

namespace sonar {
namespace {

class BrushAtWork : public testing::Test {
 protected:
  void SetUp() override {
    app_.look_at_bright();
    app_.workspace().tool.set(ToolName::brush);
    app_.workspace().brush_px.set(8);
  }
  void drag(const Voxel& from, const Voxel& to, bool release = true) {
    SliceModel& top = app_.top();
    top.pointer(app_.at(top, from, PointerAction::press, PointerButton::left));
    top.pointer(app_.at(top, to, PointerAction::move, PointerButton::left));
    if (release) top.pointer(app_.at(top, to, PointerAction::release, PointerButton::left));
  }
  std::vector<std::string> journal() {
    std::vector<std::string> commands;
    const auto read = read_journal(app_.document().journal_path().string());
    if (read) {
      for (const JournalLine& line : read->lines) commands.push_back(line.command);
    }
    return commands;
  }
  const PingMask& mask() {
    static const PingMask none;
    const auto& schools = app_.document().state().schools;
    const auto* there = schools.empty() ? nullptr : in_ping(schools[0]->masks, app_.document().ping());
    return there == nullptr ? none : there->mask;
  }

  SlicesApp app_;
  Voxel from_ = SlicesApp::bright().voxel;
  Voxel to_{from_.fan, from_.beam, from_.sample + 120};
};

TEST_F(BrushAtWork, RunsUnderADiscAreThePixelsVoxelsAndWhatLiesBetweenThem) {
  const SliceMap& map = *app_.top().picture()->map;
  const PixelPoint at = *map.place_of(from_);
  const double radius_px = 9.0;
  const auto runs = runs_under(map, at, at, radius_px);
  // Every voxel whose pixel's centre lies in the disc, by the map alone.
  std::set<std::pair<int, int>> covered;
  for (const sonar::Run& run : runs) {
    for (int s = run.first_sample; s < run.end(); ++s) covered.insert({run.row, s});
  }
  std::size_t pixels = 0;
  for (int y = 0; y < map.size().height; ++y) {
    for (int x = 0; x < map.size().width; ++x) {
      const double dx = x + 0.5 - at.x;
      const double dy = y + 0.5 - at.y;
      const auto voxel = map.voxel_at({x + 0.5, y + 0.5});
      if (!voxel || dx * dx + dy * dy > radius_px * radius_px) continue;
      ++pixels;
      EXPECT_TRUE(covered.contains({voxel->fan * map.sector().beams() + voxel->beam, voxel->sample}));
    }
  }
  EXPECT_GT(pixels, 150U);
  // Several samples a pixel: one run a beam, no holes, all in the disc's fan and near its middle.
  std::set<int> rows;
  for (const sonar::Run& run : runs) {
    EXPECT_TRUE(rows.insert(run.row).second) << "a beam in two pieces";
    EXPECT_EQ(run.row / map.sector().beams(), from_.fan);
    for (const int sample : {run.first_sample, run.end() - 1}) {
      const auto place = map.place_of({from_.fan, run.row % map.sector().beams(), sample});
      ASSERT_TRUE(place);
      EXPECT_LT(std::abs(place->y - at.y), 60.0);
    }
  }
}

TEST_F(BrushAtWork, ADragPaintsOneActWhatWasPreviewed) {
  drag(from_, to_, false);
  ASSERT_TRUE(app_.workspace().preview().mask);
  const PingMask previewed = *app_.workspace().preview().mask;
  EXPECT_GT(confidence_at(previewed, from_.fan * 25 + from_.beam, from_.sample), 0);
  EXPECT_GT(confidence_at(previewed, to_.fan * 25 + to_.beam, to_.sample - 60), 0) << "what lies between too";
  EXPECT_TRUE(journal().empty());
  app_.top().pointer(app_.at(app_.top(), to_, PointerAction::release, PointerButton::left));
  app_.settle();
  EXPECT_EQ(journal(), (std::vector<std::string>{"brush"}));
  EXPECT_EQ(mask(), previewed);
  EXPECT_FALSE(app_.workspace().preview().mask);
  EXPECT_EQ(app_.workspace().school(), (SchoolName{0, 1}));
  drag(to_, {to_.fan, to_.beam, to_.sample + 60});
  app_.settle();
  EXPECT_EQ(app_.document().state().schools.size(), 1U) << "more of the selected school";
  EXPECT_GT(mask().voxels(), previewed.voxels());
}

TEST_F(BrushAtWork, TheEraserTakesAwayAndEscapeMakesItNeverHaveBeen) {
  drag(from_, to_);
  app_.settle();
  const std::size_t painted = mask().voxels();
  app_.workspace().tool.set(ToolName::eraser);
  drag(from_, from_, false);
  EXPECT_TRUE(app_.app.brush_tool->drawing());
  app_.ask("tool.cancel");
  app_.top().pointer(app_.at(app_.top(), from_, PointerAction::release, PointerButton::left));
  app_.settle();
  EXPECT_EQ(mask().voxels(), painted);
  EXPECT_EQ(journal().size(), 1U);
  drag(from_, from_);
  app_.settle();
  EXPECT_EQ(journal().back(), "erase");
  EXPECT_LT(mask().voxels(), painted);
  EXPECT_EQ(confidence_at(mask(), from_.fan * 25 + from_.beam, from_.sample), 0);
}

TEST_F(BrushAtWork, ADiscHalfOutsideThePictureIsCutNotRead) {
  const SliceMap& map = *app_.top().picture()->map;
  for (const PixelPoint at : {PixelPoint{-5.0, -5.0}, PixelPoint{1e6, 1e6}, PixelPoint{map.size().width - 1.0, 0.0}}) {
    for (const sonar::Run& run : runs_under(map, at, at, 20.0)) EXPECT_GE(run.count, 1);
  }
}

}  // namespace
}  // namespace sonar
