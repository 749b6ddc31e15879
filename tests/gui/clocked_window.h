// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QEvent>

#include "gui/animation_timer.h"
#include "window_at_work.h"

namespace sonar {

/// The window on a clock that the test turns: its own timer is stopped.
class ClockedWindow : public WindowAtWork {
 protected:
  void SetUp() override {
    WindowAtWork::SetUp();
    QApplication::instance()->installEventFilter(&no_timer_);
  }
  void tick(double later_s) {
    now_s_ += later_s;
    app_->animations.tick(now_s_);
    settle_jobs();
  }
  void press(Qt::Key key, Qt::KeyboardModifiers with = {}) {
    QTest::keyClick(window_->windowHandle(), key, with);
    settle_jobs();
  }

 private:
  class NoTimer : public QObject {
   protected:
    bool eventFilter(QObject* watched, QEvent* event) override {
      return event->type() == QEvent::Timer && dynamic_cast<AnimationTimer*>(watched) != nullptr;
    }
  };
  NoTimer no_timer_;
  double now_s_ = 100.0;
};

}  // namespace sonar
