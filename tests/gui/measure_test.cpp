// SPDX-License-Identifier: Apache-2.0
// The measure tool under a real mouse.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QClipboard>
#include <QGuiApplication>
#include <QLineEdit>
#include <cmath>
#include <vector>

#include "session/volume/volume_model.h"
#include "window_at_work.h"

namespace sonar {
namespace {

class Measuring : public WindowAtWork {
 protected:
  void SetUp() override {
    WindowAtWork::SetUp();
    target_ = look_at_school();
    place_ = place_in("top_slice", target_.voxel);
    key(Qt::Key_G);
  }
  /// A dock as it is now, in the folder that SONAR_GUI_PICTURES names.
  void keep_dock(const std::string& dock, const std::string& name) {
    const QString folder = qEnvironmentVariable("SONAR_GUI_PICTURES");
    if (!folder.isEmpty()) view(dock)->grab().save(folder + "/" + QString::fromStdString(name) + ".png");
  }
  QString status() { return window_->findChild<QLineEdit*>("read_out")->text(); }

  Target target_;
  PixelPoint place_;
};

TEST_F(Measuring, ADragIsALineWithItsFiguresInTheStatusLine) {
  EXPECT_EQ(workspace().tool(), ToolName::measure);
  EXPECT_EQ(view("top_slice")->cursor().shape(), Qt::CrossCursor);
  const QImage before = view("top_slice")->grab().toImage();
  drag("top_slice", place_, {place_.x + 70.0, place_.y + 30.0});
  const auto& measured = workspace().measurement();
  ASSERT_TRUE(measured);
  EXPECT_FALSE(measured->drawing);
  EXPECT_NEAR(measured->line.slant_m, norm(*measured->ends->back().place - *measured->ends->front().place), 1e-9);
  EXPECT_TRUE(status().startsWith("line: ")) << status().toStdString();
  EXPECT_NE(view("top_slice")->grab().toImage(), before);
  keep_dock("top_slice", "measure-line");
  workspace().dark.set(true);
  settle();
  keep_dock("top_slice", "measure-line-dark");
  workspace().dark.set(false);
  key(Qt::Key_Escape);
  EXPECT_FALSE(workspace().measurement());
  EXPECT_FALSE(status().contains("line: "));
  EXPECT_TRUE(document().state().schools.empty());
  key(Qt::Key_S);
  EXPECT_EQ(view("top_slice")->cursor().shape(), Qt::ArrowCursor);
}

TEST_F(Measuring, ShiftIsABoxControlALassoAndCtrlCCopiesTheFigures) {
  drag("side_slice", place_in("side_slice", target_.voxel),
       {place_in("side_slice", target_.voxel).x + 60.0, place_in("side_slice", target_.voxel).y + 50.0},
       Qt::ShiftModifier);
  ASSERT_TRUE(workspace().measurement());
  EXPECT_EQ(workspace().measurement()->shape, Measurement::Shape::box);
  keep_dock("side_slice", "measure-box");
  QWidget* top = view("top_slice");
  press_on(top, {place_.x - 30.0, place_.y - 30.0}, Qt::ControlModifier);
  for (const auto& [x, y] : {std::pair(20.0, -36.0), {40.0, 0.0}, {15.0, 40.0}, {-25.0, 30.0}, {-45.0, 0.0}}) {
    move("top_slice", {place_.x + x, place_.y + y});
  }
  release_on(top, {place_.x - 45.0, place_.y}, Qt::ControlModifier);
  ASSERT_TRUE(workspace().measurement());
  EXPECT_EQ(workspace().measurement()->shape, Measurement::Shape::lasso);
  EXPECT_GT(workspace().measurement()->area.statistics.echo.heard, 10);
  keep_dock("top_slice", "measure-lasso");
  keep_picture("measure-window");
  workspace().dark.set(true);
  settle();
  keep_dock("top_slice", "measure-lasso-dark");
  keep_picture("measure-window-dark");
  top->setFocus();
  key(Qt::Key_C, Qt::ControlModifier);
  const QString copied = QGuiApplication::clipboard()->text();
  EXPECT_TRUE(copied.contains("sigma_bs total (m2)\t")) << copied.toStdString();
  EXPECT_EQ(copied.count('\n'), 2);
}

TEST_F(Measuring, OnTheMapsADragMeasuresAndDoesNotPan) {
  for (const char* map : {"observation_map", "survey_map"}) {
    raise(map);
    const QSize size = view(map)->size();
    drag(map, {0.35 * size.width(), 0.45 * size.height()}, {0.65 * size.width(), 0.6 * size.height()});
    ASSERT_TRUE(workspace().measurement()) << map;
    EXPECT_EQ(workspace().measurement()->on, Measurement::On::map);
    EXPECT_TRUE(status().contains("nmi")) << status().toStdString();
    keep_dock(map, std::string("measure-") + map);
  }
}

TEST_F(Measuring, InTheVolumeTwoClicksAreALine) {
  raise("volume");
  const auto& model = dynamic_cast<VolumeModel&>(*app_->picture("volume"));
  ASSERT_TRUE(model.shown());
  const PixelRect& plot = model.shown()->place;
  std::vector<PixelPoint> seen;  // far enough from each other to be no double click
  for (double y = plot.y + 4.0; y < plot.y + plot.height && seen.size() < 2; y += 6.0) {
    for (double x = plot.x + 4.0; x < plot.x + plot.width && seen.size() < 2; x += 6.0) {
      const PixelPoint at{std::floor(x), std::floor(y)};
      if (!model.shown()->picked_at(at)) continue;
      if (seen.empty() || std::hypot(at.x - seen[0].x, at.y - seen[0].y) > 20.0) seen.push_back(at);
    }
  }
  ASSERT_EQ(seen.size(), 2U);
  for (const PixelPoint& at : seen) click("volume", at);
  ASSERT_TRUE(workspace().measurement());
  EXPECT_EQ(workspace().measurement()->on, Measurement::On::volume);
  EXPECT_FALSE(workspace().measurement()->drawing);
  keep_dock("volume", "measure-volume");
}

}  // namespace
}  // namespace sonar
