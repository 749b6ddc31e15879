// SPDX-License-Identifier: Apache-2.0
// Schools by mouse and keys: more and less of them, holes, spikes, parts and wholes, and a disk that is full.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QAction>
#include <QMenu>
#include <QProcess>
#include <QTreeView>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/test_full_disk.h"
#include "gui/action_menus.h"
#include "school/grow/mask_edit.h"
#include "window_at_work.h"

namespace sonar {
namespace {

class Hands : public WindowAtWork {
 protected:
  std::vector<std::string> commands() {
    std::vector<std::string> all;
    for (const JournalLine& line : *document().choices().lines) all.push_back(line.command);
    return all;
  }
  int row_of(const Voxel& voxel) { return voxel.fan * document().shown()->sector().beams() + voxel.beam; }
  const std::vector<std::shared_ptr<const StateSchool>>& schools() { return document().state().schools; }
  /// Of the first school in the ping on show.
  PingMask mask_here() {
    const auto* there = in_ping(schools().at(0)->masks, document().ping());
    return there == nullptr ? PingMask{} : there->mask;
  }
  View3<const SampleFlags> flags_here() { return document().staged()->filtered->flags.view(); }
  /// The slider stands there; no school grows anew: none is selected, and something else was done last.
  void set_tolerance(double db) {
    key(Qt::Key_Z, Qt::ControlModifier);
    key(Qt::Key_Y, Qt::ControlModifier);
    key(Qt::Key_Escape);
    ASSERT_TRUE(workspace().select.set("tolerance_db", db));
    settle();
  }
  static std::vector<std::int64_t> pings_of(const StateSchool& school) {
    std::vector<std::int64_t> pings;
    for (const auto& there : school.masks.pings) pings.push_back(there.ping_index);
    return pings;
  }
};

TEST_F(Hands, CtrlClickTakesAwayAndShiftClickAdds) {
  const Target target = look_at_school();
  const PixelPoint place = place_in("top_slice", target.voxel);
  click("top_slice", place);
  const PingMask whole = mask_here();
  set_tolerance(4.0);
  click("top_slice", place, Qt::AltModifier);
  ASSERT_TRUE(workspace().school());
  click("top_slice", place, Qt::ControlModifier);
  ASSERT_EQ(schools().size(), 1U);
  const PingMask rest = mask_here();
  EXPECT_LT(rest.voxels(), whole.voxels());
  EXPECT_EQ(overlap(rest, whole), rest.voxels()) << "nothing is added";
  EXPECT_EQ(confidence_at(rest, row_of(target.voxel), target.voxel.sample), 0);
  click("top_slice", place, Qt::ShiftModifier);
  EXPECT_EQ(mask_here().runs, whole.runs) << "what the same click took away is back";
  EXPECT_EQ(schools().size(), 1U);
  EXPECT_THAT(commands(), testing::ElementsAre("grow", "undo", "redo", "grow", "grow"));
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(mask_here(), rest);
}

TEST_F(Hands, HFillsAHoleAndCtrlHTakesSpikesOff) {
  const Target target = look_at_school();
  click("top_slice", place_in("top_slice", target.voxel));
  workspace().brush_px.set(2);
  key(Qt::Key_E);
  const PixelPoint place = place_in("top_slice", target.voxel);
  drag("top_slice", place, {place.x + 1.0, place.y});
  const PingMask holed = mask_here();
  ASSERT_EQ(confidence_at(holed, row_of(target.voxel), target.voxel.sample), 0);
  key(Qt::Key_S);
  key(Qt::Key_H);
  EXPECT_EQ(mask_here(), fill_holes(holed, flags_here()));
  EXPECT_THAT(commands(), testing::ElementsAre("grow", "erase", "fill_holes"));
  EXPECT_EQ(document().choices().undo_text, "Undo fill holes of school 1");
  const PingMask before = mask_here();
  key(Qt::Key_H, Qt::ControlModifier);
  EXPECT_EQ(mask_here(), smoothed(before, flags_here()));
  EXPECT_NE(mask_here(), before);
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(mask_here(), before);
}

TEST_F(Hands, KPartsASchoolInTimeAndJMakesItOneAgain) {
  const Target target = look_at_school();
  double_click("top_slice", place_in("top_slice", target.voxel));
  const auto all = pings_of(*schools().at(0));
  ASSERT_GT(all.size(), 3U);
  key(Qt::Key_Left);
  key(Qt::Key_Right);
  ASSERT_GT(document().ping(), all.front());
  key(Qt::Key_K);
  ASSERT_EQ(schools().size(), 2U);
  EXPECT_EQ(pings_of(*schools()[0]).back(), document().ping() - 1);
  EXPECT_EQ(pings_of(*schools()[1]).front(), document().ping());
  key(Qt::Key_Left);
  const PixelPoint earlier = place_in("top_slice", target.voxel);
  click("top_slice", earlier);
  key(Qt::Key_Right);
  ASSERT_EQ(workspace().school(), (SchoolName{0, 1}));
  key(Qt::Key_J);
  click("top_slice", place_in("top_slice", target.voxel));
  ASSERT_EQ(schools().size(), 1U);
  EXPECT_EQ(pings_of(*schools()[0]), all);
  EXPECT_THAT(commands(), testing::ElementsAre("grow", "propagate", "split", "merge"));
  key(Qt::Key_Z, Qt::ControlModifier);
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(pings_of(*schools().at(0)), all);
}

TEST_F(Hands, AFullDiskIsToldAndNothingThatIsShownIsLost) {
  const Target target = look_at_school();
  const PixelPoint place = place_in("top_slice", target.voxel);
  click("top_slice", place);
  const auto before = pings_of(*schools().at(0));
  {
    const FullDisk disk(std::filesystem::file_size(document().journal_path()) + 10);
    double_click("top_slice", place);
    EXPECT_THAT(document().notices().back(), testing::HasSubstr("could not be written"));
    EXPECT_EQ(pings_of(*schools().at(0)), before) << "what is not in the journal is not on the screen";
  }
  double_click("top_slice", place);
  EXPECT_GT(pings_of(*schools().at(0)).size(), before.size()) << "when there is room, work goes on";
  const auto now = pings_of(*schools()[0]);
  close();
  open();
  ASSERT_EQ(schools().size(), 1U);
  EXPECT_EQ(pings_of(*schools()[0]), now);
}

TEST_F(Hands, WhatIsUndoneElsewhereIsSeenInTheTreeAndEscapeLeavesNoRowMarked) {
  key(Qt::Key_D, Qt::ControlModifier);
  auto* tree = view("survey_tree")->findChild<QTreeView*>("rows");
  const auto counted = [&](int observation) {
    return tree->model()->index(observation, 3).data().toString().toStdString();
  };
  ASSERT_FALSE(document().state(1).schools.empty());
  EXPECT_EQ(counted(1), std::to_string(document().state(1).schools.size()));
  raise("schools");
  auto* list = view("schools")->findChild<QTreeView*>("rows");
  click_on(list->viewport(), {40.0, 8.0});
  ASSERT_TRUE(workspace().school());
  EXPECT_TRUE(list->selectionModel()->hasSelection());
  view("top_slice")->setFocus();
  key(Qt::Key_Escape);
  EXPECT_FALSE(workspace().school());
  EXPECT_FALSE(list->selectionModel()->hasSelection());
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(counted(0), "0");
  EXPECT_EQ(counted(1), "0");
  key(Qt::Key_Y, Qt::ControlModifier);
  EXPECT_EQ(counted(1), std::to_string(document().state(1).schools.size()));
  EXPECT_NE(counted(1), "0");
}

TEST_F(Hands, BesideEverySchoolAMenuOffersNoActOnTheSelectedOne) {
  const Target target = look_at_school();
  const PixelPoint place = place_in("top_slice", target.voxel);
  click("top_slice", place);
  ASSERT_TRUE(workspace().school());
  const auto offered = [&](PixelPoint at, const char* id) {
    QTest::mouseClick(window_->windowHandle(), Qt::RightButton, {}, in_window(view("top_slice"), at));
    settle();
    auto* menu = window_->findChild<QMenu*>("top_slice.menu");
    const bool enabled = find_action(*window_, id)->isEnabled();
    QTest::keyClick(menu, Qt::Key_Escape);
    settle();
    return enabled;
  };
  const PixelPoint water = place_in("top_slice", {target.voxel.fan, target.voxel.beam, 3});
  for (const char* id : {"school.delete", "review.accept", "school.rename", "school.propagate"}) {
    EXPECT_FALSE(offered(water, id)) << id;
    EXPECT_TRUE(offered(place, id)) << id;
  }
  EXPECT_TRUE(offered(water, "tool.brush"));
  key(Qt::Key_Delete);
  EXPECT_TRUE(schools().empty()) << "its key is about the selected school, wherever the pointer is";
}

TEST_F(Hands, TheSliderGrowsADoubleClickedSchoolAnewThroughAllItsPings) {
  const Target target = look_at_school();
  double_click("top_slice", place_in("top_slice", target.voxel));
  ASSERT_EQ(schools().size(), 1U);
  std::size_t voxels = 0;
  for (const auto& there : masks()) voxels += there.mask.voxels();
  const auto before = masks();
  auto* slider = window_->findChild<QWidget*>("tolerance_db.slider");
  slider->setFocus(Qt::TabFocusReason);
  for (int i = 0; i < 3; ++i) QTest::keyClick(window_->windowHandle(), Qt::Key_Left);
  settle();
  std::size_t fewer = 0;
  for (const auto& there : masks()) fewer += there.mask.voxels();
  EXPECT_LT(fewer, voxels);
  ASSERT_EQ(schools().size(), 1U);
  EXPECT_EQ(document().choices().undo_text, "Undo grow school 1 anew");
  key(Qt::Key_Z, Qt::ControlModifier);
  ASSERT_EQ(masks().size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(masks()[i].mask, before[i].mask);
}

TEST(Program, TellsItsOptionsAndItsVersionWhereThereIsNoDisplay) {
  const char* program = std::getenv("SONAR_EXPLORER");
  if (program == nullptr) GTEST_SKIP() << "SONAR_EXPLORER, the program with the window, is not given";
  for (const auto& [option, told] :
       {std::pair("--help", "--demo"), {"--version", "sonar-explorer"}, {"-h", "--dark"}}) {
    QProcess process;
    QProcessEnvironment nowhere = QProcessEnvironment::systemEnvironment();
    for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"}) nowhere.remove(name);
    process.setProcessEnvironment(nowhere);
    process.start(program, {option});
    ASSERT_TRUE(process.waitForFinished(-1));
    EXPECT_EQ(process.exitStatus(), QProcess::NormalExit) << option;
    EXPECT_EQ(process.exitCode(), 0) << option;
    EXPECT_THAT(process.readAllStandardOutput().toStdString(), testing::HasSubstr(told));
  }
}

/// Whether a program has a handler of its own for SIGTERM, as the system says.
bool hears_term(qint64 process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("SigCgt:")) return (std::stoull(line.substr(7), nullptr, 16) >> (SIGTERM - 1) & 1U) != 0;
  }
  return false;
}

TEST(Program, ThatIsAskedToEndClosesAsAUserWould) {
  const char* program = std::getenv("SONAR_EXPLORER");
  if (program == nullptr) GTEST_SKIP() << "SONAR_EXPLORER, the program with the window, is not given";
  const auto home = TestSurvey::easy().fresh();
  QProcess process;
  QProcessEnvironment own = QProcessEnvironment::systemEnvironment();
  for (const char* name : {"XDG_CONFIG_HOME", "XDG_CACHE_HOME"})
    own.insert(name, QString::fromStdString(home.string()));
  process.setProcessEnvironment(own);
  process.start(program, QStringList{});
  ASSERT_TRUE(process.waitForStarted(-1));
  while (process.state() == QProcess::Running && !hears_term(process.processId())) process.waitForFinished(20);
  process.terminate();
  ASSERT_TRUE(process.waitForFinished(-1));
  EXPECT_EQ(process.exitStatus(), QProcess::NormalExit);
  EXPECT_EQ(process.exitCode(), 0);
  EXPECT_TRUE(std::filesystem::exists(home / "sonar-explorer" / "preferences.json")) << "the layout is kept";
}

}  // namespace
}  // namespace sonar
