// SPDX-License-Identifier: Apache-2.0
// What is asked for in the File menu and answered by hand: transects, a turntable, a recipe with its pictures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QTreeView>
#include <fstream>
#include <functional>

#include "base/time.h"
#include "gui/action_menus.h"
#include "render/draw_frame.h"
#include "session/recipes/recipe_preview.h"
#include "window_at_work.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

class Asked : public WindowAtWork {
 protected:
  /// What a menu's entry does, and hands upon the dialog that it opens.
  void trigger(const std::string& id, const std::function<void(QDialog&)>& answer = {}) {
    QAction* entry = find_action(*window_, id);
    answer ? with_dialog([entry] { entry->trigger(); }, answer) : entry->trigger();
    settle();
  }
  static void press_button(QDialog& dialog, QDialogButtonBox::StandardButton which) {
    QTest::mouseClick(dialog.findChild<QDialogButtonBox*>()->button(which), Qt::LeftButton);
  }
  const std::string& told() { return document().notices().back(); }
  static void type_number(QDialog& dialog, const char* name, const char* typed) {
    auto* box = dialog.findChild<QSpinBox*>(name);
    ASSERT_NE(box, nullptr) << name;
    box->setFocus();
    box->selectAll();
    QTest::keyClicks(box, typed);
    QTest::keyClick(box, Qt::Key_Tab);
  }
  /// What moves in a small movie of a volume, so many entries down the list; each picture is kept beside it.
  static void choose_motion(QDialog& dialog, int down) {
    type_number(dialog, "width_px", "400");
    type_number(dialog, "height_px", "300");
    auto* motion = dialog.findChild<QComboBox*>("movie.motion");
    ASSERT_NE(motion, nullptr);
    motion->setFocus();
    for (int i = 0; i < down; ++i) QTest::keyClick(motion, Qt::Key_Down);
    auto* each = dialog.findChild<QCheckBox*>("movie.each_picture");
    ASSERT_NE(each, nullptr);
    each->setFocus();
    QTest::keyClick(each, Qt::Key_Space);
  }
  fs::path out_ = TestSurvey::easy().fresh();
};

TEST_F(Asked, TransectsOfATableStandAmongTheMarksAndAClickGoesToOne) {
  const auto& pings = document().shown()->files().navigation;
  const fs::path file = out_ / "transects.csv";
  std::ofstream(file) << "name,stratum,type,start_utc,stop_utc\nT1,north,transect," << iso_time(pings[4].time) << ','
                      << iso_time(pings[8].time) << "\n";
  app_->dialogs.file_to_open = [&file](const auto&, const auto&) { return file.string(); };
  trigger("transects.open");
  raise("marks");
  QTreeView& list = *view("marks")->findChild<QTreeView*>("rows");
  ASSERT_EQ(list.model()->rowCount(), 1) << told();
  std::string row;
  for (int column = 0; column < list.model()->columnCount(); ++column)
    row += list.model()->index(0, column).data().toString().toStdString() + " ";
  EXPECT_THAT(row, testing::HasSubstr("T1 (stratum north)"));
  const QRect at = list.visualRect(list.model()->index(0, 0));
  click_on(list.viewport(), {at.x() + 12.0, static_cast<double>(at.center().y())});
  EXPECT_EQ(document().ping(), 4) << "where it begins";
}

TEST_F(Asked, ATurntableTurnsOnePing) {
  const Target target = look_at_school();
  raise("volume");
  app_->dialogs.folder_to_save = [this](const auto&, const auto&) { return out_.string(); };
  trigger("export.movie_volume", [](QDialog& dialog) {
    choose_motion(dialog, 1);
    type_number(dialog, "movie.turntable_pictures", "3");
    press_button(dialog, QDialogButtonBox::Ok);
  });
  EXPECT_EQ(workspace().picture_file.values().kind.movie.motion, MovieMotion::turntable);
  EXPECT_THAT(told(), testing::HasSubstr("written: 3 pictures")) << "of ping " << target.ping;
  const auto first = read_png(out_ / "movie-0000.png");
  const auto second = read_png(out_ / "movie-0001.png");
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->size.width, 400);
  EXPECT_NE(*first, *second) << "it turns";
}

// The camera stands still on the earth: the ship is elsewhere in each picture.
TEST_F(Asked, AMovieSailsAlongTheTrack) {
  raise("volume");
  app_->dialogs.folder_to_save = [this](const auto&, const auto&) { return out_.string(); };
  trigger("export.movie_volume", [](QDialog& dialog) {
    choose_motion(dialog, 2);
    type_number(dialog, "movie.first_ping", "2");
    type_number(dialog, "movie.last_ping", "4");
    press_button(dialog, QDialogButtonBox::Ok);
  });
  EXPECT_EQ(workspace().picture_file.values().kind.movie.motion, MovieMotion::along_track);
  EXPECT_THAT(told(), testing::HasSubstr("written: 3 pictures"));
  const auto first = read_png(out_ / "movie-0000.png");
  const auto last = read_png(out_ / "movie-0002.png");
  ASSERT_TRUE(first && last);
  EXPECT_NE(*first, *last);
}

TEST_F(Asked, ARecipeThatIsEditedShowsItsPictureBesideTheOneInForce) {
  look_at_school();
  RecipeComparison* both = nullptr;
  std::shared_ptr<ParameterSource> recipe;
  const auto real = app_->dialogs.recipe;
  app_->dialogs.recipe = [&both, &recipe, real](RecipeEditor& editor) {
    both = editor.comparison();
    recipe = editor.sections({}, false).front().source;
    return real(editor);
  };
  trigger("file.recipe", [&](QDialog& dialog) {
    const auto settle_pictures = [&] {
      do {
        QApplication::processEvents();
        both->in_force.wait();
        both->edited.wait();
      } while (pump_->queue().drain() > 0);
    };
    settle_pictures();
    auto* after = dialog.findChild<QWidget*>("preview_after");
    ASSERT_NE(after, nullptr);
    const Image in_force = both->in_force.image();
    const Image edited = both->edited.image();
    EXPECT_GT(edited.size.width, 0) << both->edited.problem();
    const QImage seen = after->grab().toImage();
    QTest::keyClicks(dialog.findChild<QLineEdit*>("words"), "median.enabled");
    auto* box = dialog.findChild<QCheckBox*>("median.enabled");
    EXPECT_NE(box, nullptr);
    if (box != nullptr) {
      box->setFocus();
      QTest::keyClick(box, Qt::Key_Space);
    }
    settle_pictures();
    EXPECT_NE(both->edited.image(), edited) << "unfiltered";
    EXPECT_EQ(both->in_force.image(), in_force);
    EXPECT_NE(after->grab().toImage(), seen) << "and seen";
    auto* before_found = dialog.findChild<QLabel*>("preview_before_schools");
    auto* after_found = dialog.findChild<QLabel*>("preview_after_schools");
    ASSERT_TRUE(before_found != nullptr && after_found != nullptr);
    EXPECT_THAT(before_found->text().toStdString(), testing::HasSubstr("in this ping, "));
    ASSERT_TRUE(recipe->set("detect.min_beams", 1000));
    settle_pictures();
    EXPECT_EQ(after_found->text(), "no school in this ping");
    EXPECT_EQ(both->edited.schools_text(), "no school in this ping");
    EXPECT_THAT(before_found->text().toStdString(), testing::HasSubstr("in this ping, "));
    press_button(dialog, QDialogButtonBox::Cancel);
  });
  EXPECT_TRUE(document().recipe().median.enabled) << "declined";
}

}  // namespace
}  // namespace sonar
