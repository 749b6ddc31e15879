// SPDX-License-Identifier: Apache-2.0
// What a right click offers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QAction>
#include <QClipboard>
#include <QDockWidget>
#include <QMenu>
#include <QToolBar>
#include <QTreeView>

#include "gui/action_menus.h"
#include "session/timelines/timeline_model.h"
#include "window_at_work.h"

namespace sonar {
namespace {

class Menus : public WindowAtWork {
 protected:
  /// The menu that a right click upon a widget of a dock opens.
  QMenu* right_click(const std::string& dock, QWidget* widget, PixelPoint at) {
    QTest::mouseClick(window_->windowHandle(), Qt::RightButton, {}, in_window(widget, at));
    settle();
    auto* menu = window_->findChild<QMenu*>(QString::fromStdString(dock + ".menu"));
    EXPECT_TRUE(menu != nullptr && menu->isVisible()) << dock;
    return menu;
  }
  QMenu* right_click(const std::string& dock, PixelPoint at) { return right_click(dock, view(dock), at); }
  bool offers(const QMenu& menu, const std::string& id) {
    QAction* action = find_action(*window_, id);
    EXPECT_TRUE(menu.actions().contains(action)) << id;
    return action->isEnabled();
  }
  void choose(QMenu& menu, const std::string& id) {
    QTest::mouseClick(&menu, Qt::LeftButton, {}, menu.actionGeometry(find_action(*window_, id)).center());
    settle();
  }
  void close(QMenu& menu) {
    QTest::keyClick(&menu, Qt::Key_Escape);
    settle();
    EXPECT_FALSE(menu.isVisible());
  }
};

TEST_F(Menus, ButtonsThatCannotActAreGreyAndTheirKeysLive) {
  const auto* bar = window_->findChild<QToolBar*>("tools");
  ASSERT_NE(bar, nullptr);
  const auto can = [&](const char* id) { return bar->widgetForAction(find_action(*window_, id))->isEnabled(); };
  EXPECT_FALSE(can("edit.undo"));
  EXPECT_FALSE(can("ping.previous"));
  EXPECT_FALSE(can("review.accept"));
  EXPECT_FALSE(can("review.next")) << "no school is known";
  EXPECT_TRUE(can("ping.next"));
  EXPECT_TRUE(can("schools.detect"));
  key(Qt::Key_Right);
  EXPECT_TRUE(can("ping.previous"));
  const Target target = look_at_school();
  click("top_slice", place_in("top_slice", target.voxel));
  for (const char* id : {"edit.undo", "review.accept", "review.next", "school.propagate"}) EXPECT_TRUE(can(id)) << id;
  EXPECT_FALSE(can("edit.redo"));
  EXPECT_TRUE(find_action(*window_, "edit.redo")->isEnabled()) << "a greyed action's key would be dead";
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_FALSE(can("edit.undo"));
  EXPECT_TRUE(can("edit.redo"));
  key(Qt::Key_Y, Qt::ControlModifier);
  EXPECT_EQ(document().state().schools.size(), 1U);
}

TEST_F(Menus, EveryDockThatWasClosedCanBeHadBackFromTheMenuBar) {
  auto* panels = window_->findChild<QMenu*>("panels");
  ASSERT_NE(panels, nullptr);
  for (auto* dock : window_->findChildren<QDockWidget*>()) {
    QAction* shows = dock->toggleViewAction();
    EXPECT_TRUE(panels->actions().contains(shows)) << dock->objectName().toStdString();
    if (!dock->isHidden()) shows->trigger();  // some are off at first
    settle();
    EXPECT_TRUE(dock->isHidden()) << dock->objectName().toStdString();
    shows->trigger();
    settle();
    // The two timelines come and go together, and one of them is behind the other.
    if (dock->objectName().endsWith("timeline")) continue;
    EXPECT_FALSE(dock->visibleRegion().isEmpty())
        << dock->objectName().toStdString() << " is in front of its tab mates";
  }
}

TEST_F(Menus, ASchoolUnderARightClickIsWhatTheMenuIsAbout) {
  const Target target = look_at_school();
  const PixelPoint place = place_in("top_slice", target.voxel);
  click("top_slice", place);
  key(Qt::Key_Escape);
  ASSERT_FALSE(workspace().school());
  QMenu* menu = right_click("top_slice", place);
  ASSERT_TRUE(workspace().school());
  EXPECT_TRUE(workspace().cursor()) << "still pointed at, though the pointer is over the menu";
  EXPECT_TRUE(offers(*menu, "review.accept"));
  EXPECT_TRUE(offers(*menu, "cursor.copy"));
  const QString folder = qEnvironmentVariable("SONAR_GUI_PICTURES");
  if (!folder.isEmpty()) menu->grab().save(folder + "/context-menu.png");
  choose(*menu, "review.accept");
  EXPECT_EQ(document().state().schools.at(0)->masks.decided.status, "accepted");
  menu = right_click("top_slice", place);
  choose(*menu, "school.delete");
  EXPECT_TRUE(document().state().schools.empty());
}

TEST_F(Menus, EntriesAreGreyedAsInTheMenuBar) {
  const Target target = look_at_school();
  QMenu* menu = right_click("top_slice", place_in("top_slice", target.voxel));
  EXPECT_FALSE(offers(*menu, "school.delete")) << "no school is selected";
  EXPECT_FALSE(offers(*menu, "school.stop")) << "nothing runs";
  EXPECT_TRUE(offers(*menu, "tool.brush"));
  int greyed = 0;
  for (const QAction* entry : menu->actions()) {
    if (entry->isSeparator()) continue;
    const Action* action = app_->actions.find(entry->objectName().toStdString());
    ASSERT_NE(action, nullptr) << entry->text().toStdString() << " stands in no other menu";
    EXPECT_EQ(entry->isEnabled(), !action->enabled || action->enabled()) << action->id;
    greyed += entry->isEnabled() ? 0 : 1;
  }
  EXPECT_GT(greyed, 5);
  close(*menu);
  EXPECT_TRUE(find_action(*window_, "school.delete")->isEnabled()) << "its key may live again at any time";
}

TEST_F(Menus, ARightClickOnTheTimelineIsAboutItsPing) {
  app_->dialogs.text = [](const std::string&, const std::string&, const std::string&) { return std::string("haul"); };
  const auto& timeline = dynamic_cast<TimelineModel&>(*app_->picture("observation_timeline"));
  const PixelRect& plot = timeline.places()->plot.place;
  const TimeNs time = document().shown()->files().navigation[6].time;
  QMenu* menu = right_click("observation_timeline", {timeline.places()->x_of(time), plot.y + 0.5 * plot.height});
  EXPECT_EQ(document().ping(), 6);
  choose(*menu, "event.trawl");
  ASSERT_EQ(document().state().events.size(), 1U);
  EXPECT_EQ(document().state().events[0].time, document().shown()->context().times[6]);
}

TEST_F(Menus, RowsAndTheTreeHaveMenusToo) {
  auto* tree = view("survey_tree")->findChild<QTreeView*>("rows");
  QMenu* menu = right_click("survey_tree", tree->viewport(), {30.0, 8.0});
  EXPECT_TRUE(offers(*menu, "export.results"));
  choose(*menu, "schools.detect");
  ASSERT_GE(app_->rows("schools")->rows(), 1U);
  raise("schools");
  auto* list = view("schools")->findChild<QTreeView*>("rows");
  menu = right_click("schools", list->viewport(), {30.0, 8.0});
  ASSERT_TRUE(workspace().school());
  EXPECT_TRUE(offers(*menu, "review.reject"));
  choose(*menu, "list.copy");
  EXPECT_EQ(QApplication::clipboard()->text().split('\n', Qt::SkipEmptyParts).size(), 2);
  menu = right_click("schools", list->viewport(), {30.0, 8.0});
  choose(*menu, "review.reject");
  EXPECT_EQ(document().state().schools.at(0)->masks.decided.status, "rejected");
}

TEST_F(Menus, EveryViewAndListHasAMenu) {
  for (const PictureDock& one : app_->pictures) {
    if (!one.view_switch.empty()) (void)workspace().views.set(one.view_switch, true);
  }
  settle();
  for (const PictureDock& one : app_->pictures) {
    raise(one.id);
    close(*right_click(one.id, {20.0, 20.0}));
  }
  for (const RowsDock& one : app_->lists) {
    raise(one.id);
    close(*right_click(one.id, view(one.id)->findChild<QTreeView*>("rows")->viewport(), {20.0, 8.0}));
  }
}

}  // namespace
}  // namespace sonar
