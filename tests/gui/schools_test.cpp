// SPDX-License-Identifier: Apache-2.0
// Schools by mouse and keys: tolerance, propagation and its end, brush and eraser.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QPushButton>
#include <QScrollArea>
#include <QSlider>
#include <QStatusBar>
#include <QStyleOptionSlider>
#include <algorithm>
#include <cmath>

#include "window_at_work.h"

namespace sonar {
namespace {

class Schools : public WindowAtWork {
 protected:
  QSlider* tolerance() {
    auto* slider = window_->findChild<QSlider*>("tolerance_db.slider");
    window_->findChild<QScrollArea*>("controls.view")->ensureWidgetVisible(slider);
    settle();
    return slider;
  }
  /// Middle of the handle where it is now, in the slider.
  static PixelPoint handle(QSlider& slider) {
    QStyleOptionSlider option;
    option.initFrom(&slider);
    option.orientation = Qt::Horizontal;
    option.minimum = slider.minimum();
    option.maximum = slider.maximum();
    option.sliderPosition = option.sliderValue = slider.sliderPosition();
    option.state |= QStyle::State_Horizontal;
    const QPoint middle =
        slider.style()->subControlRect(QStyle::CC_Slider, &option, QStyle::SC_SliderHandle, &slider).center();
    return {static_cast<double>(middle.x()), static_cast<double>(middle.y())};
  }
  double tolerance_db() { return workspace().select.values().tolerance_db; }
  std::vector<std::string> commands() {
    std::vector<std::string> all;
    for (const JournalLine& line : *document().choices().lines) all.push_back(line.command);
    return all;
  }
  int row_of(const Voxel& voxel) { return voxel.fan * document().shown()->sector().beams() + voxel.beam; }
};

TEST_F(Schools, DraggingTheToleranceGrowsWhatWasHoveredOver) {
  const Target target = look_at_school();
  move("top_slice", place_in("top_slice", target.voxel));
  ASSERT_TRUE(workspace().preview().mask);
  const std::size_t before = workspace().preview().mask->voxels();
  QSlider* slider = tolerance();
  const PixelPoint from = handle(*slider);
  press_on(slider, from);
  move_on(slider, {from.x + 12.0, from.y});
  ASSERT_TRUE(workspace().preview().mask);
  const double half_way_db = tolerance_db();
  const std::size_t half_way = workspace().preview().mask->voxels();
  EXPECT_GT(half_way_db, 10.0);
  EXPECT_GT(half_way, before) << "it grows while the slider moves";
  move_on(slider, {from.x - 20.0, from.y});
  EXPECT_LT(tolerance_db(), 10.0);
  EXPECT_LT(workspace().preview().mask->voxels(), before);
  release_on(slider, {from.x - 20.0, from.y});
  EXPECT_THAT(commands(), testing::IsEmpty()) << "nothing was clicked";
}

TEST_F(Schools, TheSliderGrowsTheSelectedSchoolAnewOnceAndArrowsStillStep) {
  const Target target = look_at_school();
  click("top_slice", place_in("top_slice", target.voxel));
  const std::size_t before = masks().at(0).mask.voxels();
  QSlider* slider = tolerance();
  const PixelPoint from = handle(*slider);
  press_on(slider, from);
  for (const double step : {4.0, 8.0, 12.0}) {
    QTest::mouseMove(window_->windowHandle(), in_window(slider, {from.x - step, from.y}));
    QApplication::processEvents();
  }
  release_on(slider, {from.x - 12.0, from.y});
  EXPECT_THAT(commands(), testing::ElementsAre("grow", "undo", "grow")) << "one growth, however long the way";
  EXPECT_LT(masks().at(0).mask.voxels(), before);
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(masks().at(0).mask.voxels(), before) << "one drag, one step back";
  EXPECT_EQ(tolerance_db(), 10.0) << "and the tolerance with it";
  EXPECT_EQ(handle(*slider).x, from.x);
  key(Qt::Key_Y, Qt::ControlModifier);
  EXPECT_LT(masks().at(0).mask.voxels(), before);
  const double db = tolerance_db();
  EXPECT_LT(db, 10.0);
  key(Qt::Key_Right);
  EXPECT_EQ(document().ping(), target.ping + 1) << "a mouse leaves the keys to the pictures";
  EXPECT_EQ(tolerance_db(), db);
}

TEST_F(Schools, KeysMoveTheSliderThatHasThem) {
  QSlider* slider = tolerance();
  slider->setFocus(Qt::TabFocusReason);
  const double before = tolerance_db();
  key(Qt::Key_Right);
  EXPECT_GT(tolerance_db(), before);
  EXPECT_EQ(document().ping(), 0);
  key(Qt::Key_Home);
  EXPECT_EQ(tolerance_db(), 3.0);
  key(Qt::Key_End);
  EXPECT_EQ(tolerance_db(), 25.0);
}

TEST_F(Schools, OneThatGoesOnBeyondTheReachIsContinuedByAButton) {
  const Target target = look_at_school();
  auto* button = window_->findChild<QPushButton*>("continue");
  EXPECT_FALSE(button->isVisible());
  ASSERT_TRUE(workspace().select.set("reach_pings", 1));
  QStringList said;
  const auto heard = QObject::connect(window_->statusBar(), &QStatusBar::messageChanged,
                                      [&said](const QString& text) { said.append(text); });
  double_click("top_slice", place_in("top_slice", target.voxel));
  EXPECT_THAT(commands(), testing::ElementsAre("grow", "propagate"));
  ASSERT_EQ(masks().size(), 3U);
  EXPECT_TRUE(said.contains("school 1 goes on beyond 1 ping: continue? (Ctrl+Shift+P)"))
      << said.join("; ").toStdString();
  ASSERT_TRUE(button->isVisible());
  EXPECT_THAT(button->text().toStdString(), testing::HasSubstr("Continue"));
  QObject::disconnect(heard);
  keep_picture("continue-offered");
  const PixelPoint middle{0.5 * button->width(), 0.5 * button->height()};
  click_on(button, middle);
  EXPECT_EQ(masks().size(), 5U) << "a ping more on either side";
  EXPECT_TRUE(button->isVisible());
  // Nothing selected, nothing to go on with.
  key(Qt::Key_Escape);
  EXPECT_FALSE(button->isVisible());
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(masks().size(), 3U) << "both sides were one step";
  workspace().school.set(SchoolName{document().shown()->index(), 1});
  settle();
  ASSERT_TRUE(button->isVisible());
  ASSERT_TRUE(workspace().select.set("reach_pings", 30));
  click_on(button, middle);
  EXPECT_GT(masks().size(), 5U);
  EXPECT_FALSE(button->isVisible()) << "it was followed to its ends";
}

TEST_F(Schools, PropagationStopsAtEscapeAndIsCarriedOn) {
  const Target target = look_at_school();
  const PixelPoint place = place_in("top_slice", target.voxel);
  click("top_slice", place);
  ASSERT_EQ(masks().size(), 1U);
  gate_.shut();  // whoever follows the school waits after each ping until it is seen
  QTest::mouseDClick(window_->windowHandle(), Qt::LeftButton, {}, in_window(view("top_slice"), place));
  while (document().propagating().empty()) QApplication::processEvents(QEventLoop::WaitForMoreEvents);
  EXPECT_TRUE(document().busy());
  EXPECT_THAT(commands(), testing::ElementsAre("grow")) << "nothing is decided half way";
  QTest::keyClick(window_->windowHandle(), Qt::Key_Escape);
  gate_.open();
  settle();
  EXPECT_THAT(commands(), testing::ElementsAre("grow", "propagate"));
  EXPECT_TRUE(workspace().school()) << "Escape ended what ran, not the selection";
  const std::size_t stopped = masks().size();
  EXPECT_GT(stopped, 1U) << "what was reached stays";
  key(Qt::Key_P, Qt::ControlModifier);
  EXPECT_GT(masks().size(), stopped);
  EXPECT_EQ(document().state().schools.size(), 1U);
  EXPECT_THAT(commands(), testing::ElementsAre("grow", "propagate", "propagate"));
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(masks().size(), stopped);
  key(Qt::Key_Escape);
  EXPECT_FALSE(workspace().school()) << "nothing runs: Escape selects nothing";
}

TEST_F(Schools, TheStripFillsWhileASchoolIsFollowed) {
  const Target target = look_at_school();
  raise("propagation");
  const PixelPoint place = place_in("top_slice", target.voxel);
  click("top_slice", place);
  LivePicture* strip = app_->picture("propagation");
  ASSERT_TRUE(strip->seen());
  const Image before = strip->image();
  gate_.shut();
  QTest::mouseDClick(window_->windowHandle(), Qt::LeftButton, {}, in_window(view("top_slice"), place));
  while (document().propagating().empty()) QApplication::processEvents(QEventLoop::WaitForMoreEvents);
  while (strip->image() == before) QApplication::processEvents(QEventLoop::WaitForMoreEvents);
  EXPECT_TRUE(document().busy()) << "seen before it is done";
  gate_.open();
  settle();
  EXPECT_GT(masks().size(), 2U);
}

TEST_F(Schools, AStrokeIsASchoolUnderTheBrushAndTheEraserTakesItAway) {
  const Target target = look_at_school();
  const PixelPoint from = place_in("top_slice", target.voxel);
  const PixelPoint to{from.x + 30.0, from.y};
  key(Qt::Key_B);
  drag("top_slice", from, to);
  ASSERT_EQ(document().state().schools.size(), 1U);
  const PingMask painted = masks().at(0).mask;
  EXPECT_EQ(confidence_at(painted, row_of(target.voxel), target.voxel.sample), 255);
  // No voxel lies farther from the stroke than the brush reaches; half a cell is the cell's own.
  const double reach_px = workspace().brush_px() + 6.0;
  const int beams = document().shown()->sector().beams();
  for (const sonar::Run& run : painted.runs) {
    EXPECT_EQ(run.row / beams, target.voxel.fan) << "a slice from above is one fan";
    for (int sample = run.first_sample; sample < run.end(); ++sample) {
      const PixelPoint at = place_in("top_slice", {run.row / beams, run.row % beams, sample});
      const double along = std::clamp(at.x, from.x, to.x);
      // A cell far out is wider than the brush; its middle may lie beyond it, the brush has met its edge.
      const double beam_px = 0.5 * std::abs(place_in("top_slice", {target.voxel.fan, target.voxel.beam + 1, sample}).x -
                                            place_in("top_slice", {target.voxel.fan, target.voxel.beam, sample}).x) +
                             0.5 * std::abs(place_in("top_slice", {target.voxel.fan, target.voxel.beam + 1, sample}).y -
                                            place_in("top_slice", {target.voxel.fan, target.voxel.beam, sample}).y);
      EXPECT_LE(std::hypot(at.x - along, at.y - from.y), reach_px + beam_px);
    }
  }
  key(Qt::Key_E);
  drag("top_slice", from, {from.x + 2.0, from.y});
  ASSERT_EQ(document().state().schools.size(), 1U);
  const auto& told = document().notices();
  EXPECT_THAT(told, testing::IsEmpty()) << told.back();
  EXPECT_EQ(confidence_at(masks().at(0).mask, row_of(target.voxel), target.voxel.sample), 0);
  EXPECT_LT(masks().at(0).mask.voxels(), painted.voxels());
  EXPECT_THAT(commands(), testing::ElementsAre("brush", "erase"));
}

TEST_F(Schools, EscapeDuringAStrokeLeavesNothing) {
  const Target target = look_at_school();
  const PixelPoint from = place_in("side_slice", target.voxel);
  key(Qt::Key_B);
  press_on(view("side_slice"), from);
  move("side_slice", {from.x, from.y + 10.0});
  EXPECT_TRUE(workspace().preview().mask) << "the stroke is seen while it is drawn";
  key(Qt::Key_Escape);
  release_on(view("side_slice"), {from.x, from.y + 10.0});
  EXPECT_THAT(commands(), testing::IsEmpty());
}

}  // namespace
}  // namespace sonar
