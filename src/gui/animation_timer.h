// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QTimer>

#include "session/animation_driver.h"

namespace sonar {

/// Ticks the animations while one runs, and rests otherwise.
class AnimationTimer : public QTimer {
 public:
  /// They outlive the timer.
  explicit AnimationTimer(AnimationDriver& animations);
  ~AnimationTimer() override;

 private:
  AnimationDriver& animations_;
  int listening_;
};

}  // namespace sonar
