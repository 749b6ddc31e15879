// SPDX-License-Identifier: Apache-2.0
// Makes the pictures of docs/guide.md, by the hands of a user:
//   SONAR_GUIDE_SURVEY=<demo survey> SONAR_GUIDE_OUT=docs/pictures sonar_gui_test --gtest_filter='Guide.*'
#include <gtest/gtest.h>

#include <QDialog>
#include <QLabel>
#include <QTest>
#include <algorithm>
#include <cstdlib>

#include "window_at_work.h"

namespace sonar {
namespace {

class Guide : public WindowAtWork {
 protected:
  void SetUp() override {
    const char* survey = std::getenv("SONAR_GUIDE_SURVEY");
    const char* out = std::getenv("SONAR_GUIDE_OUT");
    if (survey == nullptr || out == nullptr) GTEST_SKIP() << "SONAR_GUIDE_SURVEY and SONAR_GUIDE_OUT are not given";
    survey_ = survey;
    out_ = out;
    open();
    workspace().volume.assign(VolumeParams{});
    window_->resize(1760, 1100);
    settle();
  }
  void TearDown() override {
    if (window_) WindowAtWork::TearDown();
  }

  void keep(const char* name) {
    settle();
    EXPECT_TRUE(window_->grab().save(QString::fromStdString((out_ / name).string())));
  }
  void raise(const char* dock) {
    window_->findChild<QDockWidget*>(dock)->raise();
    settle();
  }

  void keep_dock(const char* dock, const char* name) {
    raise(dock);
    EXPECT_TRUE(window_->findChild<QDockWidget*>(dock)->grab().save(QString::fromStdString((out_ / name).string())));
  }

  std::filesystem::path out_;
};

TEST_F(Guide, Pictures) {
  const Target target = look_at_school();
  keep("guide-opened.png");
  const PixelPoint place = place_in("top_slice", target.voxel);
  move("top_slice", place);
  keep("guide-hover.png");
  double_click("top_slice", place);
  raise("propagation");
  keep("guide-propagated.png");
  app_->actions.find("schools.detect_all")->run();
  settle();
  raise("review");
  raise("observation_timeline");
  key(Qt::Key_Escape);  // with nothing selected the review begins with what scatters most
  app_->actions.find("review.next")->run();
  keep("guide-review.png");
  keep_dock("chart", "guide-chart.png");
  with_dialog([this] { app_->actions.find("file.recipe")->run(); },
              [this](QDialog& dialog) {
                const auto told = [&dialog] {
                  const auto labels = dialog.findChildren<QLabel*>();
                  return std::ranges::count_if(
                             labels, [](QLabel* label) { return label->text().contains("in this ping"); }) == 2;
                };
                EXPECT_TRUE(QTest::qWaitFor(told, 60'000));
                settle();
                EXPECT_TRUE(dialog.grab().save(QString::fromStdString((out_ / "guide-recipe.png").string())));
                dialog.reject();
              });
  window_->activateWindow();
  window_->setFocus();
  settle();
  workspace().depth_raster.set(survey_ / "truth" / "depth.tif");
  raise("survey_map");
  raise("survey_timeline");
  keep("guide-survey.png");
  app_->workspace.dark.set(true);
  raise("observation_map");
  keep("guide-dark.png");
  key(Qt::Key_F1);
  auto* sheet = window_->findChild<QWidget*>("key_sheet");
  ASSERT_NE(sheet, nullptr);
  EXPECT_TRUE(sheet->grab().save(QString::fromStdString((out_ / "guide-keys.png").string())));
  app_->workspace.dark.set(false);
  settle();
}

}  // namespace
}  // namespace sonar
