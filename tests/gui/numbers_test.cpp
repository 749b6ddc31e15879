// SPDX-License-Identifier: Apache-2.0
// Echo integration and biomass in their windows, by mouse and keys.
#include <gtest/gtest.h>

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QTabWidget>
#include <fstream>

#include "gui/biomass_window.h"
#include "gui/integration_window.h"
#include "window_at_work.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

class NumbersInWindow : public WindowAtWork {
 protected:
  template <class Window>
  Window* open_by(Qt::Key which, Qt::KeyboardModifiers keys) {
    window_->activateWindow();
    EXPECT_TRUE(QTest::qWaitForWindowActive(window_.get()));
    key(which, keys);
    for (QWidget* widget : QApplication::topLevelWidgets()) {
      auto* found = dynamic_cast<Window*>(widget);
      if (found == nullptr || !found->isVisible()) continue;
      EXPECT_TRUE(QTest::qWaitForWindowActive(found));
      return found;
    }
    return nullptr;
  }
  void press(QWidget& page, const char* button) {
    auto* pressed = page.findChild<QPushButton*>(button);
    ASSERT_NE(pressed, nullptr) << button;
    EXPECT_TRUE(pressed->isEnabled()) << button;
    QTest::mouseClick(pressed, Qt::LeftButton);
    settle();
  }
  static void type_into(QWidget& page, const char* box, const char* number) {
    auto* into = page.findChild<QDoubleSpinBox*>(box);
    ASSERT_NE(into, nullptr) << box;
    into->setFocus();
    QTest::keyClick(into, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(into, number);
    QTest::keyClick(into, Qt::Key_Return);
    QApplication::processEvents();
  }
  void keep(QWidget& page, const char* name) {
    const QString folder = qEnvironmentVariable("SONAR_GUI_PICTURES");
    if (!folder.isEmpty()) page.grab().save(folder + "/numbers-" + name + ".png");
  }
};

TEST_F(NumbersInWindow, WaterIsIntegratedAndAClickGoesToAPing) {
  auto* page = open_by<IntegrationWindow>(Qt::Key_I, Qt::ControlModifier);
  ASSERT_NE(page, nullptr);
  EXPECT_FALSE(page->findChild<QPushButton*>("write")->isEnabled());
  type_into(*page, "edsu_nmi.box", "0.01");
  settle();
  EXPECT_DOUBLE_EQ(app_->integration->params.values().edsu_nmi, 0.01);
  press(*page, "start");
  app_->integration->settle();
  settle();
  ASSERT_TRUE(app_->integration->result()) << app_->integration->told();
  EXPECT_GT(page->findChild<QComboBox*>("range_bin")->count(), 1);
  auto* tabs = page->findChild<QTabWidget*>("results");
  tabs->setCurrentIndex(1);
  auto* view = page->findChild<PictureView*>("sv_section");
  ASSERT_NE(view, nullptr);
  auto& section = dynamic_cast<EffortPicture&>(view->picture());
  const auto drawn = [&] { return section.chart() != nullptr && section.chart()->frame.size == section.size(); };
  ASSERT_TRUE(QTest::qWaitFor(drawn, 30'000)) << section.problem();
  keep(*page, "section");
  // The end of what was sailed: the last observation's.
  const PixelRect plot = section.chart()->plot.place;
  const double scale = section.scale();
  QTest::mouseClick(view, Qt::LeftButton, {},
                    QPoint(static_cast<int>((plot.x + 0.98 * plot.width) / scale),
                           static_cast<int>((plot.y + 0.5 * plot.height) / scale)));
  settle();
  EXPECT_EQ(document().shown()->index(), 1U);
  const fs::path out = TestSurvey::easy().fresh();
  app_->dialogs.folder_to_save = [out](const std::string&, const std::string&) { return out.string(); };
  press(*page, "write");
  for (const char* table : {"effort.csv", "nasc.csv", "strata.csv"}) EXPECT_TRUE(fs::exists(out / table)) << table;
}

TEST_F(NumbersInWindow, FishAreCountedAndWritten) {
  document().detect({0});
  settle();
  auto* page = open_by<BiomassWindow>(Qt::Key_B, Qt::ControlModifier | Qt::ShiftModifier);
  ASSERT_NE(page, nullptr);
  app_->fish->settle();
  settle();
  ASSERT_TRUE(app_->fish->result()) << app_->fish->told();
  const double before = app_->fish->result()->strata.back().numbers_seen;
  type_into(*page, "mean_length_cm.box", "40");
  app_->fish->settle();
  settle();
  ASSERT_TRUE(app_->fish->result());
  EXPECT_LT(app_->fish->result()->strata.back().numbers_seen, before) << "longer fish are louder, so fewer";
  EXPECT_TRUE(page->findChild<QLabel*>("relation_text")->text().contains("Pedersen"));
  page->findChild<QTabWidget*>("results")->setCurrentIndex(2);
  auto* view = page->findChild<PictureView*>("causes");
  ASSERT_NE(view, nullptr);
  ASSERT_TRUE(QTest::qWaitFor([&] { return view->picture().image().size.width > 0; }, 30'000))
      << view->picture().problem();
  keep(*page, "causes");
  const fs::path relations = TestSurvey::easy().fresh() / "ts.csv";
  std::ofstream(relations) << "name,species,frequency_from_khz,frequency_to_khz,aspect,m_db,b_db,d_db,line_share,"
                              "any_aspect_share,heading_sd_deg,tilt_sd_deg,recalled,source\n"
                              "own,herring,70,120,side,20,-70,0,,,,,no,tank of today\n";
  app_->dialogs.file_to_open = [relations](const auto&, const auto&) { return relations.string(); };
  press(*page, "open_relations");
  EXPECT_TRUE(page->findChild<QLabel*>("relation_text")->text().contains("tank of today"));
  EXPECT_EQ(page->findChild<QListWidget*>("relations")->count(), 1);
  auto* choice = page->findChild<QComboBox*>("relation");
  ASSERT_NE(choice, nullptr);
  EXPECT_EQ(choice->count(), 1);
  EXPECT_EQ(choice->currentText(), "own");
  app_->fish->settle();
  press(*page, "incidence");
  EXPECT_TRUE(workspace().views.values().chart);
  const fs::path out = TestSurvey::easy().fresh();
  app_->dialogs.folder_to_save = [out](const std::string&, const std::string&) { return out.string(); };
  press(*page, "write");
  EXPECT_TRUE(fs::exists(out / "biomass.csv"));
  EXPECT_TRUE(fs::exists(out / "biomass_strata.csv"));
}

}  // namespace
}  // namespace sonar
