// SPDX-License-Identifier: Apache-2.0
// The echogram by mouse: going to a ping, the linked cursor, zooming.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QComboBox>
#include <QMenu>
#include <cmath>

#include "gui/action_menus.h"
#include "session/echograms/echogram_model.h"
#include "session/echograms/test_with_ek60.h"
#include "window_at_work.h"

namespace sonar {
namespace {

class EchogramDock : public WindowAtWork {
 protected:
  static constexpr const char* kDock = "echogram";
  EchogramModel& echogram() { return dynamic_cast<EchogramModel&>(*app_->picture(kDock)); }
  /// Where a ping shows a sample of the beam that the echogram is of.
  PixelPoint place_of(std::int64_t ping, int sample) {
    const OpenObservation& shown = *document().shown();
    const EchogramPlot& plot = echogram().places()->above;
    const EchogramRow row = echogram_rows(shown.sector(), shown.placement(ping), plot.of.name.of).front();
    const TimeNs time = shown.files().navigation[static_cast<std::size_t>(ping)].time;
    return {plot.places.x_of(time) + 2.0, plot.places.plot.at(0.0, row.height_m(sample)).y};
  }
  /// By a right click and a click on the entry.
  void choose_from_menu(PixelPoint at, const std::string& id) {
    QTest::mouseClick(window_->windowHandle(), Qt::RightButton, {}, in_window(view(kDock), at));
    settle();
    auto* menu = window_->findChild<QMenu*>(QString(kDock) + ".menu");
    ASSERT_TRUE(menu != nullptr && menu->isVisible());
    QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(find_action(*window_, id)).center());
    settle();
  }
};

TEST_F(EchogramDock, AClickGoesToItsPingAndTheSlicesShowWhatIsPointedAt) {
  raise(kDock);
  workspace().slices.set({8, 10});
  settle();
  ASSERT_TRUE(echogram().places());
  click(kDock, place_of(6, 500));
  EXPECT_EQ(document().ping(), 6);
  move(kDock, place_of(6, 500));
  ASSERT_TRUE(workspace().cursor());
  EXPECT_EQ(workspace().cursor()->fan, 8);
  EXPECT_EQ(workspace().cursor()->beam, 10);
  // A pixel of a dock is some samples high.
  EXPECT_NEAR(workspace().cursor()->sample, 500, 12);
  EXPECT_FALSE(app_->picture("top_slice")->overlays().empty());
  move(kDock, place_of(3, 500));
  EXPECT_FALSE(workspace().cursor()) << "another ping";
}

TEST_F(EchogramDock, TheWheelZoomsTimeAndWithCtrlRangeAMiddleDragMovesADoubleClickShowsAll) {
  raise(kDock);
  const auto plot = [this]() -> const PlotFrame& { return echogram().places()->above.places.plot; };
  const PixelPoint at = place_of(6, 500);
  const double whole_m = plot().y.last - plot().y.first;
  wheel(kDock, at, 2);
  EXPECT_NEAR(place_of(6, 500).x, at.x, 2.0);
  wheel(kDock, at, 3, Qt::ControlModifier);
  EXPECT_NEAR(place_of(6, 500).y, at.y, 1.0);
  EXPECT_LT(std::abs(plot().y.last - plot().y.first), 0.6 * std::abs(whole_m));
  middle_drag(kDock, at, {at.x, at.y + 9.0});
  EXPECT_NEAR(place_of(6, 500).y, at.y + 9.0, 1.0);
  EXPECT_EQ(document().ping(), 0) << "moving it looks at no other ping";
  double_click(kDock, at);
  EXPECT_FALSE(echogram().zoomed());
  EXPECT_NEAR(place_of(6, 500).y, at.y, 1.0);
}

TEST_F(EchogramDock, SchoolsAndMarksLieOverItAndNoiseIsShownWhereThatIsAsked) {
  const Target target = look_at_school();
  raise(kDock);
  const Image bare = echogram().image();
  double_click("top_slice", place_in("top_slice", target.voxel));
  const Image outlined = echogram().image();
  EXPECT_NE(outlined, bare) << "the school's outline in the beam of the slices";
  app_->dialogs.text = [](const auto&, const auto&, const auto&) { return std::string("haul 3"); };
  key(Qt::Key_T);
  EXPECT_NE(echogram().image(), outlined) << "the mark";
  const Image marked = echogram().image();
  QTest::keyClick(&control<QComboBox>("More of noise", "removed"), Qt::Key_Home);
  settle();
  ASSERT_EQ(workspace().display.values().removed, NoiseLook::shown);
  EXPECT_NE(echogram().image(), marked) << "what noise removal took out";
}

TEST_F(EchogramDock, ItIsSwitchedToTheFanAndToDepth) {
  raise(kDock);
  settle();
  const Image before = echogram().image();
  for (const char* act : {"echogram.fan", "echogram.depth"}) choose_from_menu({60.0, 60.0}, act);
  EXPECT_EQ(echogram().problem(), "");
  EXPECT_NE(echogram().image(), before);
  EXPECT_EQ(echogram().places()->above.places.plot.y.label, "depth (m)");
}

class EchogramOfTwoSounders : public EchogramDock {
 protected:
  void SetUp() override {
    survey_ = with_ek60(true);
    EchogramDock::SetUp();
  }
};

TEST_F(EchogramOfTwoSounders, AnEk60LiesBelowUnderTheSameTimeAndAMenuShowsItsNextFrequency) {
  raise(kDock);
  window_->resizeDocks({dock(kDock)}, {500}, Qt::Vertical);  // in a low one there is no room for two
  settle();
  ASSERT_TRUE(echogram().places() && echogram().places()->below);
  const auto places = echogram().places();
  const TimeNs time = document().shown()->files().navigation[4].time;
  EXPECT_NEAR(places->above.places.x_of(time), places->below->places.x_of(time), 1e-6);
  const PixelRect& plot = places->below->places.plot.place;
  const PixelPoint there{places->below->places.x_of(time) + 2.0, plot.y + 0.5 * plot.height};
  EXPECT_THAT(echogram().hint(there), testing::HasSubstr("38 kHz"));
  click(kDock, there);
  EXPECT_EQ(document().ping(), 4);
  keep_picture("echogram-ek60");
  choose_from_menu(there, "echogram.channel");
  EXPECT_THAT(echogram().hint(there), testing::HasSubstr("120 kHz"));
}

}  // namespace
}  // namespace sonar
