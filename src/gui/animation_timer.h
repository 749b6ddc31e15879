// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QTimer>

#include "session/listening.h"
#include "session/playing/animation_driver.h"

namespace sonar {

/// Ticks the animations while one runs, and rests otherwise.
class AnimationTimer : public QTimer {
 public:
  /// They outlive the timer.
  explicit AnimationTimer(AnimationDriver& animations);

 private:
  AnimationDriver& animations_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
