// SPDX-License-Identifier: Apache-2.0
// A recording that is followed, on a clock that the test turns.
#include <gtest/gtest.h>

#include <QLabel>
#include <QToolBar>

#include "clocked_window.h"
#include "session/live/live_watch.h"

namespace sonar {
namespace {

class Live : public ClockedWindow {
 protected:
  void turns() {
    for (int i = 0; i < 6; ++i) {
      tick(0.3);
      app_->live->settle();
      settle_jobs();
    }
  }
  [[nodiscard]] QToolBar* strip() const { return window_->findChild<QToolBar*>("live"); }
  [[nodiscard]] QString text() const { return window_->findChild<QLabel*>("live_text")->text(); }
};

TEST_F(Live, CtrlLFollowsAndLGoesBackToTheNewestPing) {
  EXPECT_FALSE(strip()->isVisible());
  press(Qt::Key_L, Qt::ControlModifier);
  turns();
  EXPECT_TRUE(strip()->isVisible());
  EXPECT_TRUE(text().startsWith("<b>LIVE</b>")) << text().toStdString();
  EXPECT_TRUE(text().contains("a minute")) << text().toStdString();
  EXPECT_EQ(document().shown()->name(), "obs-0002");
  press(Qt::Key_Home);
  turns();
  EXPECT_EQ(document().ping(), 0);
  EXPECT_TRUE(text().contains("looking back")) << text().toStdString();
  press(Qt::Key_L);
  turns();
  EXPECT_EQ(document().ping() + 1, document().shown()->pings());
  keep_picture("live");
  press(Qt::Key_L, Qt::ControlModifier);
  EXPECT_FALSE(strip()->isVisible());
}

}  // namespace
}  // namespace sonar
