// SPDX-License-Identifier: Apache-2.0
// Docks: floating and coming back, views that are switched off, sizes.
#include <gtest/gtest.h>

#include <QScreen>
#include <QtEndian>
#include <map>
#include <set>
#include <utility>

#include "session/slices/slice_places.h"
#include "window_at_work.h"

namespace sonar {
namespace {

class Docks : public WindowAtWork {
 protected:
  /// A double-click on a dock's title, which makes it float or come back.
  void double_click_title(QDockWidget& dock) {
    QWidget* top = dock.window();
    const QPoint in_dock(60, dock.widget()->y() / 2);
    QTest::mouseDClick(top->windowHandle(), Qt::LeftButton, {}, dock.mapTo(top, in_dock));
    settle();
  }
  std::map<std::string, std::int64_t> pictures() {
    std::map<std::string, std::int64_t> all;
    for (const PictureDock& one : app_->pictures) all[one.id] = one.picture->pictures();
    return all;
  }
};

TEST_F(Docks, TheVolumeIsTheSameAfterItsDockFloatedAndCameBack) {
  QDockWidget* volume = dock("volume");
  const std::string layout = window_->layout();
  const Image before = app_->picture("volume")->image();
  const QSize size = view("volume")->size();
  ASSERT_GT(before.size.width, 0);
  const QImage seen = view("volume")->grab().toImage();
  double_click_title(*volume);
  ASSERT_TRUE(volume->isFloating());
  volume->resize(500, 420);
  settle();
  EXPECT_EQ(app_->picture("volume")->image().size.width, view("volume")->width());
  EXPECT_NE(app_->picture("volume")->image().size, before.size) << "drawn for the floating dock";
  double_click_title(*volume);
  ASSERT_FALSE(volume->isFloating());
  EXPECT_GT(app_->picture("volume")->image().size.width, 0);
  window_->take_layout(layout);  // docks share their room a little differently each time
  settle();
  ASSERT_EQ(view("volume")->size(), size);
  EXPECT_EQ(app_->picture("volume")->image(), before);
  EXPECT_EQ(view("volume")->grab().toImage(), seen);
}

// A laptop's arrangement is not a large screen's.
TEST_F(Docks, ALayoutOfAScreenOfAnotherSizeIsNotTaken) {
  dock("top_slice")->close();
  const std::string closed = window_->layout();
  const auto taken_of_a_screen = [&](int half_screens) {
    dock("top_slice")->show();
    settle();
    QByteArray geometry = QByteArray::fromBase64(QByteArray::fromStdString(closed).split(' ').at(0));
    // QWidget::saveGeometry(): two numbers of format and version, two rectangles, screen, two flags, width of the screen.
    constexpr qsizetype kWidthAt = 8 + 32 + 4 + 2;
    const auto width = qFromBigEndian<qint32>(geometry.constData() + kWidthAt);
    EXPECT_EQ(width, window_->screen()->geometry().width());
    qToBigEndian<qint32>(width * half_screens / 2, geometry.data() + kWidthAt);
    window_->take_layout((geometry.toBase64() + " ").toStdString() + closed.substr(closed.find(' ') + 1));
    settle();
    return dock("top_slice")->isHidden();
  };
  EXPECT_FALSE(taken_of_a_screen(1));
  EXPECT_TRUE(taken_of_a_screen(2));
  EXPECT_FALSE(taken_of_a_screen(4));
}

TEST_F(Docks, EveryViewThatIsOffComputesNothing) {
  const Target target = look_at_school();
  click("top_slice", place_in("top_slice", target.voxel));  // without a school there is nothing to chart
  std::set<std::string> switches;
  for (const PictureDock& one : app_->pictures) switches.insert(one.view_switch);
  switches.erase("");
  ASSERT_EQ(switches.size(), 15U);
  for (const std::string& name : switches) ASSERT_TRUE(!!workspace().views.set(name, false));
  settle();
  for (const PictureDock& one : app_->pictures) {
    if (one.view_switch.empty()) continue;
    EXPECT_FALSE(dock(one.id)->isVisible()) << one.id;
    EXPECT_FALSE(one.picture->seen()) << one.id;
  }
  const auto before = pictures();
  key(Qt::Key_Right);
  document().look_at(target.ping);
  workspace().dark.set(true);
  workspace().dark.set(false);
  settle();
  EXPECT_EQ(pictures(), before);
  for (const std::string& name : switches) ASSERT_TRUE(!!workspace().views.set(name, true));
  settle();
  app_->dialogs.reset_layout();  // where all were away, Qt gives them what room it likes
  settle();
  for (const PictureDock& one : app_->pictures) {
    if (one.view_switch.empty()) continue;
    EXPECT_FALSE(dock(one.id)->isHidden()) << one.id;
    raise(one.id);
    EXPECT_GT(one.picture->pictures(), before.at(one.id)) << one.id;
    EXPECT_EQ(one.picture->problem(), "") << one.id;
  }
}

TEST_F(Docks, KeysSwitchViewsOffAndOn) {
  const std::map<Qt::Key, std::string> keys{{Qt::Key_1, "top_slice"},       {Qt::Key_2, "side_slice"},
                                            {Qt::Key_3, "volume"},          {Qt::Key_4, "observation_map"},
                                            {Qt::Key_5, "propagation"},     {Qt::Key_6, "survey_map"},
                                            {Qt::Key_7, "survey_timeline"}, {Qt::Key_8, "echogram"}};
  const std::map<Qt::Key, std::string> off_at_first{{Qt::Key_9, "range_slice"}, {Qt::Key_0, "plane_slice"}};
  for (const auto& [digit, id] : keys) {
    key(digit, Qt::AltModifier);
    EXPECT_FALSE(dock(id)->isVisible()) << id;
    key(digit, Qt::AltModifier);
    EXPECT_TRUE(dock(id)->isVisible()) << id;
  }
  for (const auto& [digit, id] : off_at_first) {
    key(digit, Qt::AltModifier);
    EXPECT_TRUE(dock(id)->isVisible()) << id;
    key(digit, Qt::AltModifier);
    EXPECT_FALSE(dock(id)->isVisible()) << id;
  }
}

TEST_F(Docks, ClosingADockIsSwitchingItsViewOff) {
  dock("side_slice")->toggleViewAction()->trigger();
  settle();
  EXPECT_FALSE(workspace().views.values().side_slice);
  dock("side_slice")->toggleViewAction()->trigger();
  settle();
  EXPECT_TRUE(workspace().views.values().side_slice);
  EXPECT_TRUE(app_->picture("side_slice")->seen());
}

TEST_F(Docks, ASmallScreenHasRoomForEveryView) {
  const Target target = look_at_school();
  click("top_slice", place_in("top_slice", target.voxel));  // without a school there is nothing to chart
  for (const SliceKind kind : kSliceKinds) switch_on(workspace(), kind);
  for (const char* view : {"noise_steps", "frequency", "lineage", "curves"})
    ASSERT_TRUE(!!workspace().views.set(view, true));
  settle();
  for (const QSize size : {QSize(1280, 800), QSize(1366, 768)}) {
    window_->resize(size);
    settle();
    app_->dialogs.reset_layout();
    settle();
    ASSERT_EQ(window_->size(), size) << "no dock asks for more";
    for (const PictureDock& one : app_->pictures) {
      raise(one.id);
      EXPECT_EQ(one.picture->problem(), "") << one.id << " at " << size.width();
      EXPECT_EQ(one.picture->image().size.width, view(one.id)->width()) << one.id;
    }
  }
}

TEST_F(Docks, AtItsFirstStartTheWindowFitsItsScreen) {
  const auto begun = [](std::optional<QSize> at_first) {
    ChangeQueue queue;
    AppModel app(queue, {});
    const MainWindow window(app, at_first);
    return std::pair(window.size(), first_size(window.screen()->availableSize()));
  };
  EXPECT_EQ(begun(first_size({1280, 800})).first, QSize(1280, 800)) << "all views have room in it, and in no less";
  EXPECT_EQ(begun(first_size({3840, 2160})).first, QSize(3456, 1944)) << "nine tenths";
  EXPECT_EQ(first_size({1024, 700}), QSize(1024, 700)) << "nothing lies beyond the screen";
  EXPECT_EQ(first_size({7680, 4320}), QSize(3840, 2160));
  const auto [size, fitting] = begun({});
  EXPECT_EQ(size, fitting);
}

TEST_F(Docks, TheRoomOfAWideWindowGoesToItsViews) {
  std::vector<int> beside_views;
  for (const QSize size : {QSize(1920, 1080), QSize(3456, 1944)}) {
    window_->resize(size);
    settle();
    app_->dialogs.reset_layout();
    settle();
    ASSERT_EQ(window_->size(), size);
    beside_views.push_back(size.width() - view("top_slice")->width() - view("side_slice")->width());
  }
  EXPECT_NEAR(beside_views[1], beside_views[0], 40) << "tree and controls are as wide as their words";
}

TEST_F(Docks, ASmallScreensViewsHaveRoomForTheirTitles) {
  window_->resize(1280, 800);
  settle();
  app_->dialogs.reset_layout();
  settle();
  for (const char* name : {"top_slice", "side_slice", "observation_map", "volume"}) {
    EXPECT_GE(view(name)->width(), 400) << name;
  }
  EXPECT_TRUE(dock("controls")->isVisible());
  EXPECT_TRUE(dock("survey_tree")->isVisible());
}

TEST_F(Docks, ResizingKeepsEveryPictureAsLargeAsItsView) {
  window_->resize(1400, 900);
  settle();
  for (const PictureDock& one : app_->pictures) {
    if (!one.picture->seen()) continue;
    EXPECT_EQ(one.picture->image().size.width, view(one.id)->width()) << one.id;
    EXPECT_EQ(one.picture->image().size.height, view(one.id)->height()) << one.id;
  }
}

}  // namespace
}  // namespace sonar
