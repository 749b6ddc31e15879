// SPDX-License-Identifier: Apache-2.0
// What a scientist does with the window, by mouse and keys.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QAction>
#include <QDoubleSpinBox>
#include <QKeySequence>
#include <QLineEdit>
#include <QTextBrowser>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "gui/action_menus.h"
#include "window_at_work.h"

namespace sonar {
namespace {

class Desktop : public WindowAtWork {};

std::set<QRgb> colours_of(const QImage& image) {
  std::set<QRgb> colours;
  for (int y = 0; y < image.height(); y += 2) {
    for (int x = 0; x < image.width(); x += 2) colours.insert(image.pixel(x, y));
  }
  return colours;
}

TEST_F(Desktop, EveryPictureIsFilledAfterOpening) {
  ASSERT_TRUE(document().staged());
  for (const PictureDock& dock : app_->pictures) {
    if (!dock.picture->seen()) continue;  // a tab behind another
    EXPECT_TRUE(dock.picture->problem().empty()) << dock.id << ": " << dock.picture->problem();
    EXPECT_GT(colours_of(view(dock.id)->grab().toImage()).size(), 8U) << dock.id << " is empty";
  }
  EXPECT_THAT(window_->windowTitle().toStdString(), testing::HasSubstr("obs-0001"));
}

TEST_F(Desktop, ArrowsStepThroughPings) {
  key(Qt::Key_Right);
  key(Qt::Key_Right);
  EXPECT_EQ(document().ping(), 2);
  EXPECT_EQ(document().staged()->ping_index, 2);
  key(Qt::Key_Left);
  EXPECT_EQ(document().ping(), 1);
  key(Qt::Key_End);
  EXPECT_EQ(document().ping(), TestSurvey::kPings - 1);
  key(Qt::Key_Right);
  EXPECT_EQ(document().ping(), TestSurvey::kPings - 1);
  key(Qt::Key_Home);
  EXPECT_EQ(document().ping(), 0);
}

TEST_F(Desktop, HoverShowsWhatAClickThenSelects) {
  const Target target = look_at_school();
  const PixelPoint place = place_in("top_slice", target.voxel);
  const QRect before = view("top_slice")->geometry();
  move("top_slice", place);
  EXPECT_EQ(view("top_slice")->width(), before.width());
  EXPECT_EQ(view("top_slice")->height(), before.height());
  const Preview hovered = app_->workspace.preview();
  ASSERT_TRUE(hovered.mask) << hovered.text;
  ASSERT_TRUE(app_->workspace.cursor());
  EXPECT_THAT(window_->findChild<QLineEdit*>("read_out")->text().toStdString(), testing::HasSubstr("Sv "));
  const Voxel pointed_at = *app_->workspace.cursor();
  EXPECT_EQ(place_in("top_slice", target.voxel), place) << "hovering must not move the picture";
  click("top_slice", place);
  EXPECT_EQ(pointed_at, *app_->workspace.cursor());
  ASSERT_EQ(document().state().schools.size(), 1U);
  EXPECT_EQ((*document().choices().lines->back().args)["seeds"][0]["sample"], app_->workspace.cursor()->sample);
  const PingMask& clicked = document().state().schools[0]->masks.pings[0].mask;
  EXPECT_EQ(clicked.voxels(), hovered.mask->voxels());
  EXPECT_EQ(clicked, *hovered.mask);
}

TEST_F(Desktop, ADoubleClickGrowsAndPropagatesAsOneSchool) {
  const Target target = look_at_school();
  double_click("side_slice", place_in("side_slice", target.voxel));
  ASSERT_EQ(document().state().schools.size(), 1U);
  EXPECT_GT(document().state().schools[0]->masks.pings.size(), 2U);
}

TEST_F(Desktop, UndoAndRedoByKeysSayWhatTheyDo) {
  const Target target = look_at_school();
  click("top_slice", place_in("top_slice", target.voxel));
  EXPECT_EQ(document().choices().undo_text, "Undo grow school 1");
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(document().state().schools.empty());
  key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(document().state().schools.size(), 1U);
}

TEST_F(Desktop, TheToleranceInThePanelGrowsTheSchoolAnew) {
  const Target target = look_at_school();
  click("top_slice", place_in("top_slice", target.voxel));
  const std::size_t before = document().state().schools.at(0)->masks.pings.at(0).mask.voxels();
  auto* box = window_->findChild<QDoubleSpinBox*>("tolerance_db.box");
  ASSERT_NE(box, nullptr);
  box->setValue(5.0);
  settle();
  EXPECT_EQ(app_->workspace.select.values().tolerance_db, 5.0);
  std::string all;
  for (const JournalLine& line : *document().choices().lines) all += journal_text(line) + "\n";
  EXPECT_EQ(document().choices().lines->size(), 3U) << all << "grow, undo, grow; " << app_->workspace.preview().text;
  ASSERT_EQ(document().state().schools.size(), 1U);
  EXPECT_LT(document().state().schools[0]->masks.pings[0].mask.voxels(), before);
}

TEST_F(Desktop, NoTwoActionsShareAKeyAndTheSheetShowsThemAll) {
  EXPECT_THAT(app_->actions.clashes(), testing::IsEmpty());
  // One key may have two names: Esc and Escape.
  std::map<QString, std::string> of_key;
  for (const Action& action : app_->actions.list()) {
    for (const QKeySequence& keys : find_action(*window_, action.id)->shortcuts()) {
      EXPECT_FALSE(keys.isEmpty()) << action.id << " has a key that is none";
      const auto [known, fresh] = of_key.emplace(keys.toString(), action.id);
      EXPECT_TRUE(fresh) << keys.toString().toStdString() << ": " << known->second << " and " << action.id;
    }
  }
  key(Qt::Key_F1);
  auto* sheet = window_->findChild<QTextBrowser*>();
  ASSERT_NE(sheet, nullptr);
  const std::string text = sheet->toPlainText().toStdString();
  for (const Action& action : app_->actions.list()) {
    if (action.keys.empty()) continue;
    EXPECT_THAT(text, testing::HasSubstr(action.text));
  }
}

TEST_F(Desktop, DarkIsDark) {
  key(Qt::Key_F9);
  const QImage window = window_->grab().toImage();
  double light = 0.0;
  int counted = 0;
  for (int y = 0; y < window.height(); y += 8) {
    for (int x = 0; x < window.width(); x += 8, ++counted) light += qGray(window.pixel(x, y));
  }
  EXPECT_LT(light / counted, 90.0);
  key(Qt::Key_F9);
}

}  // namespace
}  // namespace sonar
