// SPDX-License-Identifier: Apache-2.0
// A recording that is followed, on a clock that the test turns.
#include <gtest/gtest.h>

#include <QLabel>
#include <QToolBar>

#include "gui/pulse_timer.h"
#include "session/live_watch.h"
#include "window_at_work.h"

namespace sonar {
namespace {

/// Stops the window's own timer: time passes when the test says so.
class NoTimer : public QObject {
 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    return event->type() == QEvent::Timer && dynamic_cast<PulseTimer*>(watched) != nullptr;
  }
};

class Live : public WindowAtWork {
 protected:
  void SetUp() override {
    WindowAtWork::SetUp();
    QApplication::instance()->installEventFilter(&no_timer_);
  }
  void press(Qt::Key key, Qt::KeyboardModifiers with = {}) {
    QTest::keyClick(window_->windowHandle(), key, with);
    settle_jobs();
  }
  void turns() {
    for (int i = 0; i < 6; ++i) {
      desk_->pulse.tick(now_s_ += 0.3);
      desk_->live->settle();
      settle_jobs();
    }
  }
  [[nodiscard]] QToolBar* strip() const { return window_->findChild<QToolBar*>("live"); }
  [[nodiscard]] QString text() const { return window_->findChild<QLabel*>("live_text")->text(); }

  NoTimer no_timer_;
  double now_s_ = 10.0;
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
